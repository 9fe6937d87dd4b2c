#include "io/output_folder.h"

#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <stdexcept>
#include <utility>

#include "io/atomic_file.h"
#include "io/input_error.h"
#include "io/path_type.h"

namespace io {
namespace {

namespace fs = std::filesystem;

/// The full name of a folder, "run/" being "run".
fs::path PlaceOf(const fs::path& folder) {
  fs::path place =
      folder.empty() ? folder : fs::absolute(folder / "").lexically_normal().parent_path();
  if (!place.filename().empty()) return place;
  throw InputError("output folder `" + folder.string() + "`",
                   "expected the name of a new folder");
}

std::string Suffixed(const fs::path& folder, const char* word) {
  return folder.string() + word + std::to_string(::getpid());
}

/// Removes what killed processes left: FOLDER.partial-PID with no such process.
void RemoveLeftovers(const fs::path& folder) {
  const std::string prefix = folder.filename().string() + ".partial-";
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder.parent_path(), error)) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with(prefix) || !entry.is_directory(error)) continue;
    const std::string digits = name.substr(prefix.size());
    const bool number =
        !digits.empty() && digits.size() < 10 &&
        std::all_of(digits.begin(), digits.end(), [](char c) { return c >= '0' && c <= '9'; });
    if (!number) continue;
    const auto pid = static_cast<pid_t>(std::strtol(digits.c_str(), nullptr, 10));
    const bool gone = ::kill(pid, 0) != 0 && errno == ESRCH;
    if (gone || pid == ::getpid()) fs::remove_all(entry.path(), error);
  }
}

/// Renames `partial` to `place` where an older folder stands, which is gone afterwards.
void Replace(const fs::path& partial, const fs::path& place, std::error_code& error) {
  std::error_code ignored;
  if (::renameat2(AT_FDCWD, partial.c_str(), AT_FDCWD, place.c_str(), RENAME_EXCHANGE) == 0) {
    fs::remove_all(partial, ignored);  // now the old one
    return;
  }
  // A file system that cannot exchange: a moment without either.
  const fs::path old = Suffixed(place, ".old-");
  fs::rename(place, old, error);
  if (error) return;
  fs::rename(partial, place, error);
  if (error) {
    fs::rename(old, place, ignored);  // as it was before
  } else {
    fs::remove_all(old, ignored);
  }
}

}  // namespace

OutputFolder::OutputFolder(const fs::path& folder, std::string marker, bool force)
    : final_(PlaceOf(folder)),
      partial_(Suffixed(final_, ".partial-")),
      marker_(std::move(marker)),
      force_(force) {
  RefuseWhatIsThere();
  for (fs::path above = final_.parent_path(); !Exists(above); above = above.parent_path()) {
    made_.push_back(above);
  }
  std::error_code error;
  fs::create_directories(final_.parent_path(), error);
  RemoveLeftovers(final_);
  if (!error) fs::create_directory(partial_, error);
  if (!error) return;
  GiveUp();
  FailToWrite(final_, error);
}

OutputFolder::~OutputFolder() {
  if (!partial_.empty()) GiveUp();
}

void OutputFolder::GiveUp() const {
  std::error_code ignored;
  fs::remove_all(partial_, ignored);
  for (const fs::path& above : made_) fs::remove(above, ignored);  // if it is empty
}

void OutputFolder::RefuseWhatIsThere() const {
  std::error_code ignored;
  const fs::file_type type = fs::symlink_status(final_, ignored).type();
  if (type == fs::file_type::not_found) return;
  const bool folder = type == fs::file_type::directory;
  if (folder && fs::equivalent(final_, fs::current_path(ignored), ignored)) {
    throw InputError(final_.string(),
                     "is the folder you are in, which cannot be replaced; name a folder in it");
  }
  if (folder && fs::is_empty(final_, ignored)) return;  // nobody's work
  if (!force_) {
    throw InputError(final_.string(), "exists already; choose another name or pass --force");
  }
  if (!folder) {
    throw InputError(final_.string(), std::string("is ") + NameOf(type) +
                                          ", which even --force does not replace; choose "
                                          "another name or remove it yourself");
  }
  if (!fs::exists(final_ / marker_, ignored)) {
    throw InputError(final_.string(),
                     "exists and holds no " + marker_ +
                         ", so even --force does not replace it; choose another name or "
                         "remove it yourself");
  }
}

fs::path OutputFolder::Path(const fs::path& relative) const {
  if (partial_.empty()) throw std::invalid_argument("OutputFolder: it is in its place already");
  fs::path file = partial_ / relative;
  std::error_code error;
  fs::create_directories(file.parent_path(), error);
  if (error) FailToWrite(final_ / relative, error);
  return file;
}

void OutputFolder::Write(const fs::path& relative, std::string_view bytes) const {
  WriteFile(Path(relative), bytes);
}

void OutputFolder::Commit() {
  RefuseWhatIsThere();  // it may have appeared meanwhile
  std::error_code error;
  if (fs::exists(final_, error)) {
    Replace(partial_, final_, error);
  } else {
    fs::rename(partial_, final_, error);
  }
  if (error) FailToWrite(final_, error);
  partial_.clear();
}

void MakeFolder(const fs::path& folder) {
  const fs::file_type type = TypeAt(folder);
  if (type != fs::file_type::directory && type != fs::file_type::not_found) {
    throw InputError(folder.string(), std::string("is ") + NameOf(type) + "; name a folder");
  }
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) {
    throw InputError(folder.string(), "this folder cannot be made: " + error.message() +
                                          "; choose another output folder");
  }
}

}  // namespace io
