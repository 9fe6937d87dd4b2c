#include "io/output_folder.h"

#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <sys/stat.h>
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

/// Calls `use` with each FOLDER.partial-PID that is there, and its PID.
template <typename Use>
void ForEachPartial(const fs::path& folder, const Use& use) {
  const std::string prefix = folder.filename().string() + ".partial-";
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder.parent_path(), error)) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with(prefix) || !entry.is_directory(error)) continue;
    const std::string digits = name.substr(prefix.size());
    const bool number =
        !digits.empty() && digits.size() < 10 &&
        std::all_of(digits.begin(), digits.end(), [](char c) { return c >= '0' && c <= '9'; });
    if (number) use(entry.path(), static_cast<pid_t>(std::strtol(digits.c_str(), nullptr, 10)));
  }
}

/// Removes what killed processes left: partial folders with no such process.
void RemoveLeftovers(const fs::path& folder) {
  ForEachPartial(folder, [](const fs::path& partial, pid_t pid) {
    std::error_code ignored;
    const bool gone = ::kill(pid, 0) != 0 && errno == ESRCH;
    if (gone || pid == ::getpid()) fs::remove_all(partial, ignored);
  });
}

[[noreturn]] void FailAsBeingWritten(const fs::path& folder) {
  throw InputError(folder.string(),
                   "is being written by another process; wait for its end or name another "
                   "folder");
}

/// @param own  the partial folder of this process
void RefuseOtherWriters(const fs::path& folder, const fs::path& own = {}) {
  ForEachPartial(folder, [&](const fs::path& partial, pid_t) {
    if (partial != own && FolderLock::IsHeld(partial)) FailAsBeingWritten(folder);
  });
}

/// Whether a file system begins there: nothing can be renamed to such a place.
bool IsMountPoint(const fs::path& folder) {
  struct statx found {};
  return ::statx(AT_FDCWD, folder.c_str(), AT_SYMLINK_NOFOLLOW, 0, &found) == 0 &&
         (found.stx_attributes & STATX_ATTR_MOUNT_ROOT) != 0;
}

/// Refuses a folder that is there and cannot be renamed, whatever is in it.
void RequireMovable(const fs::path& folder) {
  const auto refuse = [&](const std::string& why) {
    throw InputError(folder.string(),
                     why + ", so it cannot be replaced; name a folder in it, such as " +
                         (folder / "out").string());
  };
  std::error_code ignored;
  if (fs::equivalent(folder, fs::current_path(ignored), ignored)) {
    refuse("is the folder you are in");
  }
  if (IsMountPoint(folder)) refuse("is a mount point");
  const fs::path above = folder.parent_path();
  if (::euidaccess(above.c_str(), W_OK | X_OK) != 0) {
    refuse("is in " + above.string() + ", which you may not write to");
  }
}

void RefuseWhatIsThere(const fs::path& folder, const std::string& marker, bool force) {
  std::error_code ignored;
  const fs::file_type type = fs::symlink_status(folder, ignored).type();
  if (type == fs::file_type::not_found) return;
  const bool is_folder = type == fs::file_type::directory;
  if (is_folder) RequireMovable(folder);
  if (is_folder && fs::is_empty(folder, ignored)) return;  // nobody's work
  if (!force) {
    throw InputError(folder.string(), "exists already; choose another name or pass --force");
  }
  if (!is_folder) {
    throw InputError(folder.string(), std::string("is ") + NameOf(type) +
                                          ", which even --force does not replace; choose "
                                          "another name or remove it yourself");
  }
  if (!fs::exists(folder / marker, ignored)) {
    throw InputError(folder.string(),
                     "exists and holds no " + marker +
                         ", so even --force does not replace it; choose another name or "
                         "remove it yourself");
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

void OutputFolder::RequirePlace(const fs::path& folder, const std::string& marker, bool force) {
  const fs::path place = PlaceOf(folder);
  RefuseWhatIsThere(place, marker, force);
  fs::path above = place.parent_path();
  while (!Exists(above)) above = above.parent_path();
  if (const fs::file_type type = TypeAt(above); type != fs::file_type::directory) {
    throw InputError(place.string(), "cannot be made: " + above.string() + " is " +
                                         NameOf(type) + ", no folder; choose another place");
  }
  RefuseOtherWriters(place);
}

OutputFolder::OutputFolder(const fs::path& folder, std::string marker, bool force)
    : final_(PlaceOf(folder)),
      partial_(Suffixed(final_, ".partial-")),
      marker_(std::move(marker)),
      force_(force) {
  RequirePlace(final_, marker_, force_);
  for (fs::path above = final_.parent_path(); !Exists(above); above = above.parent_path()) {
    made_.push_back(above);
  }
  std::error_code error;
  fs::create_directories(final_.parent_path(), error);
  RemoveLeftovers(final_);
  if (!error && !fs::create_directory(partial_, error) && !error) FailAsBeingWritten(final_);
  try {
    if (error) FailToWrite(final_, error);
    lock_.emplace(partial_);
    RefuseOtherWriters(final_, partial_);  // one may have begun meanwhile
  } catch (const InputError&) {
    GiveUp();
    throw;
  }
}

OutputFolder::~OutputFolder() {
  if (!partial_.empty()) GiveUp();
}

void OutputFolder::GiveUp() const {
  std::error_code ignored;
  fs::remove_all(partial_, ignored);
  for (const fs::path& above : made_) fs::remove(above, ignored);  // if it is empty
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
  RefuseWhatIsThere(final_, marker_, force_);  // it may have appeared meanwhile
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
