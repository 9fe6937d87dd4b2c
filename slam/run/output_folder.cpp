#include "slam/run/output_folder.h"

#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <fstream>

#include "slam/base/require.h"

namespace slam {
namespace {

namespace fs = std::filesystem;

std::string Suffixed(const fs::path& folder, const char* word) {
  return folder.string() + word + std::to_string(::getpid());
}

/// Removes what killed processes left: FOLDER.partial-PID with no such process.
void RemoveLeftovers(const fs::path& folder) {
  const std::string prefix = folder.filename().string() + ".partial-";
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder.parent_path(), error)) {
    const std::string name = entry.path().filename().string();
    if (name.rfind(prefix, 0) != 0 || !entry.is_directory(error)) continue;
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

}  // namespace

OutputFolder::OutputFolder(const fs::path& folder, std::string marker, bool force)
    : marker_(std::move(marker)), force_(force) {
  if (folder.empty()) throw InputError("output folder", "expected the name of a new folder");
  fs::path name = fs::absolute(folder).lexically_normal();
  if (name.filename().empty()) name = name.parent_path();  // "run/" is "run"
  if (name.filename().empty())
    throw InputError("output folder `" + folder.string() + "`",
                     "expected the name of a new folder");
  final_ = name;
  partial_ = Suffixed(final_, ".partial-");
  RefuseWhatIsThere();
  std::error_code error;
  fs::create_directories(final_.parent_path(), error);
  RemoveLeftovers(final_);
  fs::create_directory(partial_, error);
  if (error) throw InputError(final_.string(), "cannot be created: " + error.message());
}

OutputFolder::~OutputFolder() {
  std::error_code ignored;
  if (!committed_) fs::remove_all(partial_, ignored);
}

void OutputFolder::RefuseWhatIsThere() const {
  std::error_code ignored;
  if (!fs::exists(fs::symlink_status(final_, ignored))) return;
  if (!force_)
    throw InputError(final_.string(), "exists already; choose another name or pass --force");
  const bool ours = fs::is_directory(final_, ignored) &&
                    (fs::exists(final_ / marker_, ignored) || fs::is_empty(final_, ignored));
  if (!ours)
    throw InputError(final_.string(),
                     "exists and holds no " + marker_ +
                         ", so even --force does not replace it; choose another "
                         "name or remove it yourself");
}

void OutputFolder::WriteFile(const std::string& name, const std::string& bytes) const {
  const fs::path file = partial_ / name, temporary = partial_ / (name + ".tmp");
  std::ofstream stream(temporary, std::ios::binary);
  stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  stream.close();
  std::error_code error;
  if (stream) fs::rename(temporary, file, error);
  if (!stream || error)
    throw std::runtime_error(file.string() + ": cannot be written; is the disk full?");
}

void OutputFolder::Commit() {
  Require(!committed_, "OutputFolder::Commit: done already");
  RefuseWhatIsThere();  // it may have appeared meanwhile
  std::error_code error;
  if (!fs::exists(final_, error)) {
    fs::rename(partial_, final_, error);
  } else if (::renameat2(AT_FDCWD, partial_.c_str(), AT_FDCWD, final_.c_str(),
                         RENAME_EXCHANGE) == 0) {
    fs::remove_all(partial_, error);  // now the old one
    error.clear();
  } else {  // a file system that cannot exchange: a moment without either
    const fs::path old = Suffixed(final_, ".old-");
    fs::rename(final_, old);
    fs::rename(partial_, final_, error);
    if (error) fs::rename(old, final_);  // as it was before
    std::error_code ignored;
    if (!error) fs::remove_all(old, ignored);
  }
  if (error)
    throw std::runtime_error(final_.string() + ": cannot be put in place: " + error.message());
  committed_ = true;
}

}  // namespace slam
