#include "eval/read/text_table.h"

#include <charconv>
#include <cmath>
#include <fstream>
#include <sstream>

#include "eval/read/input_error.h"

namespace eval {
namespace {

constexpr std::string_view kBlanks = " \t\r\v\f";

std::string Trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(kBlanks);
  if (first == std::string::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

std::vector<std::string> Split(const std::string& text, char separator) {
  std::vector<std::string> fields;
  std::istringstream stream(text);
  std::string field;
  if (separator == ' ') {
    while (stream >> field) fields.push_back(field);
    return fields;
  }
  while (std::getline(stream, field, separator)) fields.push_back(Trimmed(field));
  if (!text.empty() && text.back() == separator) fields.emplace_back();
  return fields;
}

}  // namespace

std::string Where(const std::filesystem::path& file, int line) {
  return file.string() + ":" + std::to_string(line);
}

std::string ReadWholeFile(const std::filesystem::path& file, const std::string& needed_for) {
  std::error_code ignored;
  std::ifstream stream(file, std::ios::binary);
  if (!stream || !std::filesystem::is_regular_file(file, ignored)) {
    throw InputError(
        file.string(),
        "cannot be read" + (needed_for.empty() ? "" : "; it is needed " + needed_for));
  }
  std::ostringstream text;
  text << stream.rdbuf();
  return std::move(text).str();
}

std::vector<TextLine> ReadTextTable(const std::filesystem::path& file, char separator) {
  std::istringstream stream(ReadWholeFile(file));
  std::vector<TextLine> lines;
  std::string text;
  for (int number = 1; std::getline(stream, text); ++number) {
    text = Trimmed(text);
    if (text.empty() || text.front() == '#') continue;
    lines.push_back({number, Split(text, separator)});
  }
  return lines;
}

bool ParseNumber(std::string_view text, double& value) {
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() && std::isfinite(value);
}

double ParseNumber(const std::string& field, const std::string& meaning,
                   const std::filesystem::path& file, int line) {
  double value = 0.0;
  if (!ParseNumber(field, value)) {
    throw InputError(Where(file, line),
                     "expected a finite number for " + meaning + ", found \"" + field + "\"");
  }
  return value;
}

}  // namespace eval
