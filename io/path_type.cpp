#include "io/path_type.h"

#include "io/input_error.h"

namespace io {

namespace fs = std::filesystem;

fs::file_type TypeAt(const fs::path& path) {
  std::error_code error;
  const fs::file_type type = fs::status(path, error).type();
  // Nothing can have a name that is too long.
  if (error == std::errc::filename_too_long) return fs::file_type::not_found;
  if (type == fs::file_type::none) {
    throw InputError(path.string(), "cannot be read: " + error.message() +
                                        "; mend the path, or the permissions of it and of the "
                                        "folders above");
  }
  if (type == fs::file_type::not_found && fs::is_symlink(path, error)) {
    throw InputError(path.string(), "is a link to " + fs::read_symlink(path, error).string() +
                                        ", which is not there; remove or mend the link");
  }
  return type;
}

bool Exists(const fs::path& path) { return TypeAt(path) != fs::file_type::not_found; }

const char* NameOf(fs::file_type type) {
  switch (type) {
    case fs::file_type::regular:
      return "a file";
    case fs::file_type::directory:
      return "a folder";
    case fs::file_type::symlink:
      return "a link";
    case fs::file_type::fifo:
      return "a pipe";
    case fs::file_type::socket:
      return "a socket";
    case fs::file_type::character:
    case fs::file_type::block:
      return "a device";
    default:
      return "nothing that can be used";
  }
}

}  // namespace io
