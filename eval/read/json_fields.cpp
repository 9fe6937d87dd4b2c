#include "eval/read/json_fields.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "eval/read/input_error.h"
#include "eval/read/text_table.h"

namespace eval {

JsonField::JsonField(const nlohmann::json& value, std::string where, std::string path)
    : value_(&value), where_(std::move(where)), path_(std::move(path)) {}

void JsonField::Fail(const std::string& expected) const {
  std::string found = value_->dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  if (found.size() > 60) found = found.substr(0, 57) + "...";
  throw InputError(where_, (path_.empty() ? "" : path_ + ": ") + "expected " + expected +
                               ", found " + found);
}

JsonField JsonField::operator[](const std::string& key) const {
  if (!value_->is_object()) Fail("an object with the key \"" + key + "\"");
  const auto member = value_->find(key);
  const std::string path = path_.empty() ? key : path_ + "." + key;
  if (member == value_->end()) throw InputError(where_, "the key \"" + path + "\" is missing");
  return {*member, where_, path};
}

std::optional<JsonField> JsonField::Find(const std::string& key) const {
  if (!value_->is_object()) Fail("an object");
  const auto member = value_->find(key);
  if (member == value_->end() || member->is_null()) return std::nullopt;
  return JsonField(*member, where_, path_.empty() ? key : path_ + "." + key);
}

std::vector<JsonField> JsonField::Elements() const {
  if (!value_->is_array()) Fail("an array");
  std::vector<JsonField> elements;
  elements.reserve(value_->size());
  for (std::size_t i = 0; i < value_->size(); ++i) {
    elements.emplace_back((*value_)[i], where_, path_ + "[" + std::to_string(i) + "]");
  }
  return elements;
}

double JsonField::Number() const {
  if (!value_->is_number() || !std::isfinite(value_->get<double>())) Fail("a finite number");
  return value_->get<double>();
}

int JsonField::Integer() const {
  const double number = value_->is_number() ? value_->get<double>() : 0.5;
  const bool fits = std::abs(number) <= std::numeric_limits<int>::max();
  if (!fits || number != std::floor(number)) Fail("a whole number");
  return static_cast<int>(number);
}

std::string JsonField::Text() const {
  if (!value_->is_string()) Fail("a text");
  return value_->get<std::string>();
}

bool JsonField::Boolean() const {
  if (!value_->is_boolean()) Fail("true or false");
  return value_->get<bool>();
}

std::vector<double> JsonField::Numbers() const {
  std::vector<double> numbers;
  for (const JsonField& element : Elements()) numbers.push_back(element.Number());
  return numbers;
}

Eigen::Vector3d JsonField::Vector3() const {
  if (!value_->is_array() || value_->size() != 3) Fail("3 numbers [x, y, z]");
  const std::vector<double> xyz = Numbers();
  return {xyz[0], xyz[1], xyz[2]};
}

std::vector<Eigen::Vector3d> JsonField::Points() const {
  std::vector<Eigen::Vector3d> points;
  for (const JsonField& element : Elements()) points.push_back(element.Vector3());
  return points;
}

nlohmann::json ParseJson(const std::string& text, const std::filesystem::path& file,
                         int first_line) {
  try {
    return nlohmann::json::parse(text);
  } catch (const nlohmann::json::parse_error& error) {
    const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(
                                        error.byte > 0 ? error.byte - 1 : 0, text.size()));
    const auto line = first_line + static_cast<int>(std::count(text.begin(), end, '\n'));
    throw InputError(Where(file, line),
                     "not valid JSON (the file may be cut off): " + std::string(error.what()));
  }
}

std::vector<JsonLine> ReadJsonLines(const std::filesystem::path& file) {
  std::istringstream stream(ReadWholeFile(file));
  std::vector<JsonLine> lines;
  std::string text;
  for (int number = 1; std::getline(stream, text); ++number) {
    if (text.find_first_not_of(" \t\r") == std::string::npos) continue;
    lines.push_back({number, ParseJson(text, file, number)});
  }
  return lines;
}

}  // namespace eval
