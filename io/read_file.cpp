#include "io/read_file.h"

#include <cerrno>
#include <system_error>

#include "io/input_error.h"
#include "io/path_type.h"

namespace io {
namespace {

[[noreturn]] void FailToRead(const std::filesystem::path& file, const std::string& what,
                             const std::string& mend) {
  throw InputError(file.string(), what + (mend.empty() ? "" : "; " + mend));
}

}  // namespace

std::ifstream OpenFile(const std::filesystem::path& file, const std::string& mend) {
  // Before it is opened: a pipe would wait for its writer, a device might never end.
  const auto type = TypeAt(file);
  if (type == std::filesystem::file_type::not_found) FailToRead(file, "no such file", mend);
  if (type != std::filesystem::file_type::regular) {
    FailToRead(file, std::string("is ") + NameOf(type) + ", expected a file", mend);
  }
  std::ifstream stream(file, std::ios::binary);
  if (!stream) {
    FailToRead(file, "cannot be read: " + std::generic_category().message(errno), mend);
  }
  return stream;
}

std::string ReadFile(const std::filesystem::path& file, const std::string& mend,
                     std::uintmax_t max_bytes) {
  std::ifstream stream = OpenFile(file, mend);
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  if (error) FailToRead(file, "cannot be read: " + error.message(), mend);
  if (size > max_bytes) {
    FailToRead(file, "is larger than " + std::to_string(max_bytes >> 20) + " MiB", mend);
  }
  std::string bytes(size, '\0');
  if (!stream.read(bytes.data(), static_cast<std::streamsize>(size))) {
    FailToRead(file, "cannot be read to its end", mend);
  }
  return bytes;
}

}  // namespace io
