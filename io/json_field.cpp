#include "io/json_field.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "io/input_error.h"
#include "io/read_file.h"
#include "io/text_lines.h"

namespace io {
namespace {

constexpr int kMaxJsonDepth = 32;  // our formats need 6; a line of brackets must not end us

/// What the parser found, without its own name and place: those of the file are told instead.
std::string Reason(const nlohmann::json::exception& error) {
  const std::string text = error.what();
  const auto at = text.find(": ");
  return at == std::string::npos ? text : text.substr(at + 2);
}

bool IsShallow(int depth, nlohmann::json::parse_event_t, nlohmann::json&) {
  if (depth > kMaxJsonDepth) throw InputError("nested deeper than any of our formats");
  return true;
}

}  // namespace

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

double JsonField::Number(const Interval& domain) const {
  if (!value_->is_number() || !domain.Contains(value_->get<double>())) {
    Fail("a number in " + domain.text());
  }
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

nlohmann::json ParseJson(const std::string& text, const std::filesystem::path& where,
                         int first_line) {
  try {
    return nlohmann::json::parse(text, IsShallow);
  } catch (const nlohmann::json::parse_error& error) {
    const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(
                                        error.byte > 0 ? error.byte - 1 : 0, text.size()));
    const auto line = first_line + static_cast<int>(std::count(text.begin(), end, '\n'));
    throw InputError(Where(where, line),
                     "not valid JSON (the file may be cut off): " + Reason(error));
  } catch (const nlohmann::json::out_of_range& error) {  // a number that no double holds
    throw InputError(Where(where, first_line), "not valid JSON: " + Reason(error));
  } catch (const InputError& deep) {
    throw InputError(Where(where, first_line), deep.what());
  }
}

nlohmann::json ReadJson(const std::filesystem::path& file, const std::string& mend) {
  return ParseJson(ReadFile(file, mend), file);
}

void ForEachJsonLine(const std::filesystem::path& file, const std::string& mend,
                     const std::function<void(const JsonField& document)>& visit) {
  TextLines lines(file, mend, kMaxJsonLine_bytes);
  for (std::string text; lines.Next(text);) {
    if (text.find_first_not_of(" \t\r") == std::string::npos) continue;
    const nlohmann::json document = ParseJson(text, file, lines.number());
    visit(JsonField(document, lines.where()));
  }
}

}  // namespace io
