#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace io {

/// One record of a text file: its fields and where it stands.
struct TextRecord {
  std::string where;  ///< "file:line"
  int line = 0;       ///< from 1
  std::vector<std::string> fields;

  /// The finite number that the field is. @throws InputError naming `meaning`
  double Number(std::size_t field, const std::string& meaning) const;
};

/// Records of a file with fields between blanks, such as TUM's lists; `#` lines and empty lines
/// are left out.
/// @param form  one word for each field of a record: "timestamp file"; empty: any number of
/// them
/// @param mend  what to do when the file cannot be read, see ReadFile
/// @throws InputError when it cannot be read, and with file:line for a record of another form
std::vector<TextRecord> ReadRecords(const std::filesystem::path& file,
                                    const std::string& form = "", const std::string& mend = "");

/// The same with fields between commas, any number of them. An empty field stays.
std::vector<TextRecord> ReadCommaRecords(const std::filesystem::path& file);

}  // namespace io
