#include "io/atomic_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <utility>

#include "io/input_error.h"

namespace io {
namespace {

std::filesystem::path Unfinished(const std::filesystem::path& path) {
  return path.string() + kUnfinishedSuffix;
}

/// Whether a file may come to stand there: in the place of nothing or of a file, that is. (For a
/// folder the system says why not.)
bool MayBeReplaced(const std::filesystem::path& path) {
  using Type = std::filesystem::file_type;
  std::error_code ignored;
  const Type type = std::filesystem::symlink_status(path, ignored).type();
  return type == Type::not_found || type == Type::regular || type == Type::directory ||
         type == Type::none;
}

bool IsFileOfName(int file, const std::filesystem::path& path) {
  struct stat opened, named;
  return ::fstat(file, &opened) == 0 && ::stat(path.c_str(), &named) == 0 &&
         opened.st_dev == named.st_dev && opened.st_ino == named.st_ino;
}

/// Opens the unfinished file and locks it: what a killed process left has no lock, what another
/// one is at has. (Of a file system without locks none can be had, and none is asked.)
int OpenAlone(const std::filesystem::path& path) {
  const std::filesystem::path unfinished = Unfinished(path);
  for (;;) {
    const int file =
        ::open(unfinished.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
    if (file < 0) FailToWrite(path, {errno, std::generic_category()});
    if (::flock(file, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
      ::close(file);
      throw InputError(path.string(),
                       "is being written by another process; wait for its end or choose "
                       "another name");
    }
    // Another process may have put this file in its place before it was locked here.
    if (IsFileOfName(file, unfinished)) {
      if (::ftruncate(file, 0) == 0) return file;
      const int error = errno;
      ::close(file);
      FailToWrite(path, {error, std::generic_category()});
    }
    ::close(file);
  }
}

/// Closes it, and puts it in its place unless something went wrong before. @returns 0 or errno
int PutInPlace(int file, int error, const std::filesystem::path& path) {
  const std::filesystem::path unfinished = Unfinished(path);
  const int lock = ::dup(file);  // lasts until the file is in its place
  if (::close(file) != 0 && error == 0) error = errno;
  if (error == 0 && std::rename(unfinished.c_str(), path.c_str()) != 0) error = errno;
  if (error != 0) ::unlink(unfinished.c_str());
  if (lock >= 0) ::close(lock);
  return error;
}

}  // namespace

void FailToWrite(const std::filesystem::path& path, const std::error_code& error) {
  throw InputError(path.string(), "cannot be written: " + error.message() +
                                      "; free some space, mend the permissions or choose "
                                      "another place");
}

void WriteAll(int file, std::string_view bytes, const std::filesystem::path& path) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(file, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) FailToWrite(path, {errno, std::generic_category()});
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
}

AtomicFile::AtomicFile(std::filesystem::path path) : path_(std::move(path)) {
  if (!MayBeReplaced(path_)) {
    throw InputError(path_.string(),
                     "is a link or a device, which is never replaced; remove it or choose "
                     "another name");
  }
  file_ = OpenAlone(path_);
}

AtomicFile::~AtomicFile() {
  if (file_ >= 0) PutInPlace(file_, ECANCELED, path_);
}

void AtomicFile::Add(std::string_view bytes) {
  constexpr std::size_t kBlock_bytes = 1 << 18;  // few calls of the system, and little memory
  if (pending_.size() + bytes.size() < kBlock_bytes) {
    pending_ += bytes;
    return;
  }
  WriteAll(file_, std::exchange(pending_, {}), path_);
  WriteAll(file_, bytes, path_);
}

void AtomicFile::Finish() {
  WriteAll(file_, std::exchange(pending_, {}), path_);
  const int error = PutInPlace(std::exchange(file_, -1), 0, path_);
  if (error != 0) FailToWrite(path_, {error, std::generic_category()});
}

void WriteFile(const std::filesystem::path& path, std::string_view bytes) {
  AtomicFile file(path);
  file.Add(bytes);
  file.Finish();
}

}  // namespace io
