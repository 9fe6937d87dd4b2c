#include "eval/export/dataset_folder.h"

#include <fmt/format.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "eval/read/input_error.h"
#include "eval/read/write_file.h"

namespace eval {
namespace {

namespace fs = std::filesystem;

constexpr const char* kMarker = "export.json";

[[noreturn]] void CannotWrite(const fs::path& what, const std::error_code& error) {
  throw InputError(what.string(),
                   "cannot be written (" + error.message() + "); choose another folder");
}

}  // namespace

DatasetFolder::DatasetFolder(const fs::path& folder, std::string kind, bool force)
    : final_(fs::absolute(folder / "").parent_path()), kind_(std::move(kind)) {
  if (fs::exists(final_)) {
    if (!force) {
      throw InputError(folder.string(), "exists; name another folder or pass --force");
    }
    const bool ours = fs::is_directory(final_) && fs::exists(final_ / kMarker);
    if (!ours && !(fs::is_directory(final_) && fs::is_empty(final_))) {
      throw InputError(folder.string(),
                       "is no earlier export (it has no export.json), so even "
                       "--force does not replace it; name another folder");
    }
  }
  partial_ = final_.parent_path() /
             fmt::format(".{}.partial.{}", final_.filename().string(), getpid());
  std::error_code error;
  fs::remove_all(partial_, error);
  fs::create_directories(partial_, error);
  if (error) CannotWrite(folder, error);
}

DatasetFolder::~DatasetFolder() {
  std::error_code ignored;
  fs::remove_all(partial_, ignored);
}

fs::path DatasetFolder::File(const fs::path& relative) const {
  const fs::path file = partial_ / relative;
  std::error_code error;
  fs::create_directories(file.parent_path(), error);
  if (error) CannotWrite(final_ / relative, error);
  return file;
}

void DatasetFolder::Write(const fs::path& relative, const std::string& text) const {
  WriteFile(File(relative), text);
}

void DatasetFolder::Copy(const fs::path& from, const fs::path& relative) const {
  if (!fs::is_regular_file(from)) throw InputError(from.string(), "there is no such file");
  std::error_code error;
  fs::copy_file(from, File(relative), error);
  if (error) CannotWrite(final_ / relative, error);
}

void DatasetFolder::Finish() {
  const nlohmann::json marker{{"format", "pas-export/1"}, {"kind", kind_}};
  Write(kMarker, marker.dump(1) + "\n");
  std::error_code error;
  if (fs::exists(final_)) {
    const fs::path old = partial_.string() + ".old";
    fs::rename(final_, old, error);
    if (error) CannotWrite(final_, error);
    fs::rename(partial_, final_, error);
    if (error) {
      std::error_code ignored;
      fs::rename(old, final_, ignored);  // as it was before
      CannotWrite(final_, error);
    }
    fs::remove_all(old, error);
    return;
  }
  fs::rename(partial_, final_, error);
  if (error) CannotWrite(final_, error);
}

}  // namespace eval
