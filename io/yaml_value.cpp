#include "io/yaml_value.h"

#include <algorithm>

#include "io/input_error.h"
#include "io/nearest_word.h"
#include "io/number_text.h"
#include "io/read_file.h"

namespace io {
namespace {

using Kind = YamlNode::Kind;

constexpr std::uintmax_t kMaxYamlBytes = 1 << 20;  // a scene of 1000 objects has a third of it

std::string Joined(const std::vector<std::string>& words) {
  std::string joined;
  for (const std::string& word : words) joined += (joined.empty() ? "" : ", ") + word;
  return joined;
}

bool IsLetterOrDigit(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
}

/// Of words and paths: what needs no quotes in YAML, in a shell or in a message.
bool IsPlain(const std::string& text) {
  return std::all_of(text.begin(), text.end(), [](char c) {
    return IsLetterOrDigit(c) || std::string_view(" _-./").find(c) != std::string_view::npos;
  });
}

/// What YAML takes for nothing unless it stands in quotes, which nothing here is written in.
bool IsNull(const std::string& text) {
  return text == "null" || text == "Null" || text == "NULL";
}

std::string InUnit(const std::string& unit) { return unit.empty() ? "" : " (" + unit + ")"; }

}  // namespace

void YamlValue::Fail(const std::string& what) const {
  throw InputError(Where(file_, node_->line), (name_.empty() ? "" : name_ + ": ") + what);
}

void YamlValue::Expected(const std::string& expected) const {
  if (node_->kind == Kind::kMissing) {
    throw InputError(Where(file_, node_->line),
                     "key `" + name_ + "` is missing; expected " + expected);
  }
  constexpr const char* kFound[] = {"", "nothing", "", "a list", "a mapping"};
  Fail("expected " + expected + ", found " +
       (node_->kind == Kind::kScalar ? Quoted(node_->text)
                                     : kFound[static_cast<std::size_t>(node_->kind)]) +
       (node_->quoted ? " in quotes" : ""));
}

const std::string& YamlValue::Scalar(const std::string& expected) const {
  if (node_->kind != Kind::kScalar) Expected(expected);
  return node_->text;
}

double YamlValue::Number(const Interval& domain, const std::string& unit) const {
  const std::string expected = "a number in " + domain.text() + InUnit(unit);
  const auto number = ParseNumber(Scalar(expected));
  if (!number || node_->quoted || !domain.Contains(*number)) Expected(expected);
  return *number;
}

int YamlValue::Whole(const Interval& domain) const {
  const std::string expected = "a whole number in " + domain.text();
  const auto number = ParseWhole<int>(Scalar(expected));
  if (!number || node_->quoted || !domain.Contains(*number)) Expected(expected);
  return *number;
}

std::uint64_t YamlValue::Seed() const {
  const std::string expected = "a whole number in [0, 18446744073709551615]";
  const auto number = ParseWhole<std::uint64_t>(Scalar(expected));
  if (!number || node_->quoted) Expected(expected);
  return *number;
}

bool YamlValue::Flag() const { return OneOf({"false", "true"}) == 1; }

std::size_t YamlValue::OneOf(const std::vector<std::string>& choices) const {
  const std::string expected = "one of: " + Joined(choices);
  const auto at = std::find(choices.begin(), choices.end(), Scalar(expected));
  if (at == choices.end()) Expected(expected);
  return static_cast<std::size_t>(at - choices.begin());
}

std::string YamlValue::Text() const {
  if (Scalar("a text").empty()) Expected("a text that is not empty");
  return node_->text;
}

std::string YamlValue::Word() const {
  constexpr std::size_t kMaxWord = 64;
  const std::string expected =
      "1 to 64 letters, digits, spaces or _-./ with a letter or digit at both ends";
  const std::string& text = Scalar(expected);
  if (text.empty() || text.size() > kMaxWord || !IsPlain(text) ||
      !IsLetterOrDigit(text.front()) || !IsLetterOrDigit(text.back()) || IsNull(text)) {
    Expected(expected);
  }
  return text;
}

std::string YamlValue::Path() const {
  constexpr std::size_t kMaxPath = 256;
  const std::string expected =
      "a path of letters, digits, spaces and _-./, at most 256 characters";
  const std::string& text = Scalar(expected);
  if (text.empty() || text.size() > kMaxPath || !IsPlain(text) || text.front() == ' ' ||
      text.back() == ' ' || IsNull(text)) {
    Expected(expected);
  }
  return text;
}

Eigen::VectorXd YamlValue::Numbers(int count, const Interval& domain,
                                   const std::string& unit) const {
  if (node_->kind != Kind::kList || node_->entries.size() != static_cast<std::size_t>(count)) {
    Expected("a list of " + std::to_string(count) + " numbers" + InUnit(unit));
  }
  Eigen::VectorXd numbers(count);
  int i = 0;
  for (const YamlValue& entry : List(node_->entries.size())) {
    numbers[i++] = entry.Number(domain, unit);
  }
  return numbers;
}

bool YamlValue::IsScalar() const { return node_->kind == Kind::kScalar; }

std::vector<YamlValue> YamlValue::List(std::size_t max_count) const {
  if (node_->kind != Kind::kList) Expected("a list, as in [a, b]");
  if (node_->entries.size() > max_count) {
    Fail("expected at most " + std::to_string(max_count) + " entries, found " +
         std::to_string(node_->entries.size()));
  }
  std::vector<YamlValue> list;
  for (const YamlNode& node : node_->entries) {
    list.push_back(Entry(node, name_ + "[" + std::to_string(list.size()) + "]"));
  }
  return list;
}

YamlValue YamlValue::Entry(const YamlNode& node, std::string name) const {
  return {std::shared_ptr<const YamlNode>(node_, &node), file_, std::move(name)};
}

YamlMap::YamlMap(YamlValue value) : value_(std::move(value)) {
  const Kind kind = value_.node_->kind;
  if (kind == Kind::kScalar || kind == Kind::kList) value_.Expected("`key: value` lines");
}

YamlMap::YamlMap(YamlValue value, const std::vector<std::string>& keys)
    : YamlMap(std::move(value)) {
  if (value_.node_->kind != Kind::kMapping) {
    const std::string lines = "`key: value` lines with keys of: " + Joined(keys);
    if (value_.name_.empty()) value_.Fail("the file is empty; expected " + lines);
    value_.Expected(lines);
  }
  RefuseOtherKeys(keys);
}

bool YamlMap::Has(const std::string& key) const {
  const auto& entries = value_.node_->entries;
  return std::any_of(entries.begin(), entries.end(),
                     [&](const YamlNode& entry) { return entry.key == key; });
}

YamlValue YamlMap::At(const std::string& key) const {
  const std::string name = value_.name_.empty() ? key : value_.name_ + "." + key;
  for (const YamlNode& entry : value_.node_->entries) {
    if (entry.key == key) return value_.Entry(entry, name);
  }
  YamlNode missing;
  missing.kind = Kind::kMissing;
  missing.line = value_.node_->line;
  return {std::make_shared<const YamlNode>(missing), value_.file_, name};
}

void YamlMap::RefuseOtherKeys(const std::vector<std::string>& legal) const {
  constexpr std::size_t kMaxKey = 64;  // letters that are compared; no legal key has more
  for (const YamlNode& entry : value_.node_->entries) {
    if (std::find(legal.begin(), legal.end(), entry.key) != legal.end()) continue;
    const std::string nearest = NearestWord(entry.key.substr(0, kMaxKey), legal);
    throw InputError(Where(value_.file_, entry.key_line),
                     (value_.name_.empty() ? "" : value_.name_ + ": ") + "unknown key " +
                         Quoted(entry.key) +
                         (nearest.empty() ? "; " : "; did you mean `" + nearest + "`? ") +
                         "keys here: " + Joined(legal));
  }
}

YamlValue ParseYaml(const std::string& text, const std::string& file) {
  return {std::make_shared<const YamlNode>(ParseYamlTree(text, file)), file};
}

YamlValue ReadYaml(const std::filesystem::path& file, const std::string& mend) {
  return ParseYaml(ReadFile(file, mend, kMaxYamlBytes), file.string());
}

}  // namespace io
