#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace eval {

/// One record of a text file: its fields and where it stands.
struct TextLine {
  int number = 0;  ///< from 1
  std::vector<std::string> fields;
};

/// Records of a file with fields between blanks, or between `separator` if it is not a blank;
/// `#` lines and empty lines are left out.
/// @throws InputError if the file cannot be read.
std::vector<TextLine> ReadTextTable(const std::filesystem::path& file, char separator = ' ');

/// The whole file. @throws InputError if it cannot be read; `needed_for` ends the message.
std::string ReadWholeFile(const std::filesystem::path& file,
                          const std::string& needed_for = "");

/// "file:line".
std::string Where(const std::filesystem::path& file, int line);

/// A finite number that fills the whole field, the decimal point being a point in any locale.
/// @throws InputError at file:line, naming `meaning`.
double ParseNumber(const std::string& field, const std::string& meaning,
                   const std::filesystem::path& file, int line);

/// The same without a file: false if the text is not one finite number.
bool ParseNumber(std::string_view text, double& value);

}  // namespace eval
