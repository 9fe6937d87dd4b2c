#include "io/folder_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>

#include "io/input_error.h"
#include "io/output_folder.h"

namespace io {

FolderLock::FolderLock(const std::filesystem::path& folder) {
  MakeFolder(folder);
  folder_ = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (folder_ < 0) {
    throw InputError(folder.string(),
                     "cannot be read: " + std::generic_category().message(errno) +
                         "; mend its permissions or choose another output folder");
  }
  if (::flock(folder_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
    ::close(folder_);
    throw InputError(folder.string(),
                     "is being written by another process; wait for its end or name another "
                     "folder");
  }
}

FolderLock::~FolderLock() { ::close(folder_); }

bool FolderLock::IsHeld(const std::filesystem::path& folder) {
  const int opened = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  if (opened < 0) return false;
  const bool held = ::flock(opened, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  ::close(opened);
  return held;
}

}  // namespace io
