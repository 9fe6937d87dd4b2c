#include "eval/formats/text_records.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace eval {

std::vector<io::TextRecord> ReadTextRecords(Folder& folder, const std::string& file,
                                            Severity severity) {
  std::vector<io::TextRecord> records;
  folder.Try(
      file, [&] { records = io::ReadRecords(folder.Open(file)); }, severity);
  return records;
}

std::vector<io::TextRecord> ReadCommaRecords(Folder& folder, const std::string& file) {
  std::vector<io::TextRecord> records;
  folder.Try(file, [&] { records = io::ReadCommaRecords(folder.Open(file)); });
  return records;
}

std::string TextOf(const io::TextRecord& record) {
  return io::Quoted(fmt::format("{}", fmt::join(record.fields, " ")));
}

}  // namespace eval
