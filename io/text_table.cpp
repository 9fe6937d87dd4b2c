#include "io/text_table.h"

#include <sstream>

#include "io/input_error.h"
#include "io/number_text.h"
#include "io/text_lines.h"

namespace io {
namespace {

constexpr std::size_t kMaxLine = 4096;  // bytes; longer ones are no text that anybody wrote
constexpr const char* kBlanks = " \t\r\v\f";

std::string Trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(kBlanks);
  if (first == std::string::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

std::vector<std::string> Words(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

std::vector<std::string> BetweenCommas(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> fields;
  for (std::string field; std::getline(stream, field, ',');) fields.push_back(Trimmed(field));
  if (text.ends_with(',')) fields.emplace_back();
  return fields;
}

template <typename Split>
std::vector<TextRecord> Records(const std::filesystem::path& file, const std::string& mend,
                                Split split) {
  TextLines lines(file, mend, kMaxLine);
  std::vector<TextRecord> records;
  for (std::string text; lines.Next(text);) {
    text = Trimmed(text);
    if (text.empty() || text.front() == '#') continue;
    records.push_back({lines.where(), lines.number(), split(text)});
  }
  return records;
}

}  // namespace

double TextRecord::Number(std::size_t field, const std::string& meaning) const {
  const auto number = ParseNumber(fields.at(field));
  if (!number) {
    throw InputError(
        where, "expected a finite number for " + meaning + ", found " + Quoted(fields[field]));
  }
  return *number;
}

std::vector<TextRecord> ReadRecords(const std::filesystem::path& file, const std::string& form,
                                    const std::string& mend) {
  const std::size_t count = Words(form).size();
  std::vector<TextRecord> records = Records(file, mend, Words);
  for (const TextRecord& record : records) {
    if (form.empty() || record.fields.size() == count) continue;
    throw InputError(record.where, "expected `" + form + "`, found " +
                                       std::to_string(record.fields.size()) + " words");
  }
  return records;
}

std::vector<TextRecord> ReadCommaRecords(const std::filesystem::path& file) {
  return Records(file, "", BetweenCommas);
}

}  // namespace io
