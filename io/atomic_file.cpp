#include "io/atomic_file.h"

#include <fcntl.h>
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

/// Closes it, and puts it in its place unless something went wrong before. @returns 0 or errno
int PutInPlace(int file, int error, const std::filesystem::path& path) {
  const std::filesystem::path unfinished = Unfinished(path);
  if (::close(file) != 0 && error == 0) error = errno;
  if (error == 0 && std::rename(unfinished.c_str(), path.c_str()) != 0) error = errno;
  if (error != 0) ::unlink(unfinished.c_str());
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
  file_ = ::open(Unfinished(path_).c_str(),
                 O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC | O_NOFOLLOW, 0666);
  if (file_ < 0) FailToWrite(path_, {errno, std::generic_category()});
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
