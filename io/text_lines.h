#pragma once

#include <filesystem>
#include <fstream>
#include <string>

namespace io {

/// The lines of a text file, one after the other. A byte order mark at its beginning, as some
/// editors write it, is left out.
class TextLines {
 public:
  /// @param max_line_bytes  a longer line is no text of our formats
  /// @throws InputError, see OpenFile
  TextLines(const std::filesystem::path& file, const std::string& mend,
            std::size_t max_line_bytes);

  /// Puts the next line, without its end, into `text`. @returns false when there is none
  /// @throws InputError for a line that is too long, and when the file cannot be read further
  bool Next(std::string& text);

  int number() const { return number_; }  ///< of the line that was read last, from 1
  std::string where() const;              ///< "file:line" of that one

 private:
  std::filesystem::path file_;
  std::ifstream stream_;
  std::size_t max_line_bytes_;
  int number_ = 0;
};

}  // namespace io
