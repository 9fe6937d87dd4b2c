#include "sim/write/atomic_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "sim/scene/input_error.h"

namespace sim {
namespace {

[[noreturn]] void FailToWrite(const std::filesystem::path& path, int error) {
  throw InputError(path.string(), std::string("cannot be written: ") + std::strerror(error) +
                                      "; free some space, mend the permissions or choose "
                                      "another output folder");
}

/// 0, or the errno of what went wrong.
int WriteAll(int file, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(file, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return errno;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return 0;
}

std::filesystem::path Unfinished(const std::filesystem::path& path) {
  std::filesystem::path unfinished = path;
  unfinished += kUnfinishedSuffix;
  return unfinished;
}

int Open(const std::filesystem::path& unfinished) {
  return ::open(unfinished.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
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

AtomicFile::AtomicFile(std::filesystem::path path)
    : path_(std::move(path)), file_(Open(Unfinished(path_))) {
  if (file_ < 0) FailToWrite(path_, errno);
}

AtomicFile::~AtomicFile() {
  if (file_ >= 0) PutInPlace(file_, ECANCELED, path_);
}

void AtomicFile::Flush() {
  const int error = WriteAll(file_, pending_);
  pending_.clear();
  if (error != 0) FailToWrite(path_, error);
}

void AtomicFile::Add(std::string_view bytes) {
  constexpr std::size_t kBlock = 1 << 18;
  sum_.Add(bytes);
  pending_ += bytes;
  if (pending_.size() >= kBlock) Flush();
}

std::string AtomicFile::Finish() {
  Flush();
  const int error = PutInPlace(std::exchange(file_, -1), 0, path_);
  if (error != 0) FailToWrite(path_, error);
  return sum_.Hex();
}

void WriteFileAtomically(const std::filesystem::path& path, std::string_view bytes) {
  const int file = Open(Unfinished(path));
  if (file < 0) FailToWrite(path, errno);
  const int error = PutInPlace(file, WriteAll(file, bytes), path);
  if (error != 0) FailToWrite(path, error);
}

std::string ReadWholeFile(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw InputError(path.string(), "cannot be read; check the path and permissions");
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

}  // namespace sim
