#include "eval/read/write_file.h"

#include <fstream>

#include "eval/read/input_error.h"

namespace eval {

void WriteFile(const std::filesystem::path& file, const std::string& text) {
  std::filesystem::path temporary = file;
  temporary += ".tmp";
  std::error_code error;
  {
    std::ofstream stream(temporary, std::ios::binary | std::ios::trunc);
    stream << text;
    stream.close();
    if (!stream) {
      std::filesystem::remove(temporary, error);
      throw InputError(file.string(), "cannot be written; is the folder there and writable?");
    }
  }
  std::filesystem::rename(temporary, file, error);
  if (error) {
    std::error_code ignored;
    std::filesystem::remove(temporary, ignored);
    throw InputError(file.string(), "cannot be written: " + error.message());
  }
}

}  // namespace eval
