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

AtomicFile::AtomicFile(std::filesystem::path path)
    : path_(std::move(path)),
      file_(::open(Unfinished(path_).c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666)) {
  if (file_ < 0) FailToWrite(path_, {errno, std::generic_category()});
}

AtomicFile::~AtomicFile() {
  if (file_ >= 0) PutInPlace(file_, ECANCELED, path_);
}

void AtomicFile::Write(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(file_, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) FailToWrite(path_, {errno, std::generic_category()});
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
}

void AtomicFile::Add(std::string_view bytes) {
  constexpr std::size_t kBlock_bytes = 1 << 18;  // few calls of the system, and little memory
  if (pending_.size() + bytes.size() < kBlock_bytes) {
    pending_ += bytes;
    return;
  }
  Write(std::exchange(pending_, {}));
  Write(bytes);
}

void AtomicFile::Finish() {
  Write(std::exchange(pending_, {}));
  const int error = PutInPlace(std::exchange(file_, -1), 0, path_);
  if (error != 0) FailToWrite(path_, {error, std::generic_category()});
}

void WriteFile(const std::filesystem::path& path, std::string_view bytes) {
  AtomicFile file(path);
  file.Add(bytes);
  file.Finish();
}

}  // namespace io
