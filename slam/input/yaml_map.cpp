#include "slam/input/yaml_map.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <sstream>

namespace slam {
namespace {

constexpr std::uintmax_t kMaxFileBytes = 1 << 20;

/// The whole of `text` as a finite number.
bool ParseNumber(std::string_view text, double& value) {
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() && std::isfinite(value);
}

double ParseBound(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  if (text == "inf") return std::numeric_limits<double>::infinity();
  if (text == "-inf") return -std::numeric_limits<double>::infinity();
  double value = 0;
  Require(ParseNumber(text, value), "ParseInterval: a bound is not a number");
  return value;
}

std::string Joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

}  // namespace

bool Interval::Contains(double x) const {
  if (!std::isfinite(x)) return false;
  return (closed_min ? x >= min : x > min) && (closed_max ? x <= max : x < max);
}

Interval ParseInterval(std::string_view text) {
  const std::size_t comma = text.find(',');
  Require(text.size() >= 5 && comma != std::string_view::npos, "ParseInterval: no interval");
  const char first = text.front(), last = text.back();
  Require((first == '(' || first == '[') && (last == ')' || last == ']'),
          "ParseInterval: an interval starts with ( or [ and ends with ) or ]");
  return {ParseBound(text.substr(1, comma - 1)),
          ParseBound(text.substr(comma + 1, text.size() - comma - 2)), first == '[',
          last == ']', std::string(text)};
}

YamlMap YamlMap::Load(const std::filesystem::path& file) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored))
    throw InputError(file.string(), "no such file");
  if (std::filesystem::file_size(file, ignored) > kMaxFileBytes)
    throw InputError(file.string(), "larger than 1 MiB: this is not a settings file");
  std::ifstream stream(file, std::ios::binary);
  std::stringstream text;
  text << stream.rdbuf();
  if (!stream) throw InputError(file.string(), "cannot be read; check its permissions");
  try {
    return {YAML::Load(text.str()), file.string(), ""};
  } catch (const YAML::Exception& e) {
    const int line = e.mark.is_null() ? 1 : e.mark.line + 1;
    throw InputError(file.string() + ":" + std::to_string(line),
                     "not YAML: " + e.msg + "; expected `key: value` lines");
  }
}

YamlMap::YamlMap(const YAML::Node& node, std::string file, std::string name)
    : node_(node), file_(std::move(file)), name_(std::move(name)) {
  if (!node_ || node_.IsNull()) return;
  const std::string what = name_.empty() ? "the file" : "`" + name_ + "`";
  if (!node_.IsMap()) throw InputError(Where(node_), what + " must be `key: value` lines");
  std::set<std::string> seen;
  for (const auto& entry : node_) {
    if (!entry.first.IsScalar())
      throw InputError(Where(entry.first), "a key of " + what + " is not a plain text");
    if (!seen.insert(entry.first.Scalar()).second)
      throw InputError(Where(entry.first),
                       "key `" + entry.first.Scalar() + "` is given twice; keep one");
  }
}

std::string YamlMap::Where(const YAML::Node& node) const {
  const YAML::Mark mark = node ? node.Mark() : YAML::Mark::null_mark();
  return mark.is_null() ? file_ : file_ + ":" + std::to_string(mark.line + 1);
}

YAML::Node YamlMap::Find(const std::string& key) {
  if (std::find(asked_.begin(), asked_.end(), key) == asked_.end()) asked_.push_back(key);
  if (node_ && node_.IsMap())
    for (const auto& entry : node_)
      if (entry.first.Scalar() == key) return entry.second;
  return YAML::Node(YAML::NodeType::Undefined);
}

void YamlMap::Fail(const std::string& key, const std::string& what) const {
  if (node_ && node_.IsMap())
    for (const auto& entry : node_)
      if (entry.first.Scalar() == key) throw InputError(Where(entry.first), what);
  throw InputError(Where(node_), what);
}

std::string YamlMap::Scalar(const YAML::Node& node, const std::string& key,
                            const std::string& expected) const {
  if (!node.IsScalar()) Fail(key, "`" + key + "` must be " + expected);
  return node.Scalar();
}

bool YamlMap::Has(const std::string& key) { return Find(key).IsDefined(); }

double YamlMap::Number(const std::string& key, const Interval& domain) {
  const YAML::Node node = Find(key);
  const std::string expected = "a number in " + domain.text;
  if (!node.IsDefined()) Fail(key, "key `" + key + "` is missing; expected " + expected);
  const std::string text = Scalar(node, key, expected);
  double value = 0;
  if (!ParseNumber(text, value) || !domain.Contains(value))
    Fail(key, "`" + key + ": " + text + "` must be " + expected);
  return value;
}

double YamlMap::Number(const std::string& key, const Interval& domain, double fallback) {
  return Has(key) ? Number(key, domain) : fallback;
}

std::int64_t YamlMap::Integer(const std::string& key, const Interval& domain) {
  const YAML::Node node = Find(key);
  const std::string expected = "a whole number in " + domain.text;
  if (!node.IsDefined()) Fail(key, "key `" + key + "` is missing; expected " + expected);
  const std::string text = Scalar(node, key, expected);
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() ||
      !domain.Contains(static_cast<double>(value)))
    Fail(key, "`" + key + ": " + text + "` must be " + expected);
  return value;
}

std::int64_t YamlMap::Integer(const std::string& key, const Interval& domain,
                              std::int64_t fallback) {
  return Has(key) ? Integer(key, domain) : fallback;
}

bool YamlMap::Flag(const std::string& key, bool fallback) {
  const YAML::Node node = Find(key);
  if (!node.IsDefined()) return fallback;
  const std::string text = Scalar(node, key, "true or false");
  if (text == "true") return true;
  if (text != "false") Fail(key, "`" + key + ": " + text + "` must be true or false");
  return false;
}

std::string YamlMap::Choice(const std::string& key, const std::vector<std::string>& choices,
                            const std::string& fallback) {
  const YAML::Node node = Find(key);
  if (!node.IsDefined()) return fallback;
  const std::string expected = "one of " + Joined(choices);
  const std::string text = Scalar(node, key, expected);
  if (std::find(choices.begin(), choices.end(), text) == choices.end())
    Fail(key, "`" + key + ": " + text + "` must be " + expected);
  return text;
}

std::vector<std::string> YamlMap::Texts(const std::string& key) {
  const YAML::Node node = Find(key);
  std::vector<std::string> texts;
  if (!node.IsDefined()) return texts;
  if (!node.IsSequence()) Fail(key, "`" + key + "` must be a list, e.g. [book, keyboard]");
  for (const YAML::Node& item : node) {
    if (!item.IsScalar() || item.Scalar().empty())
      throw InputError(Where(item), "an entry of `" + key + "` must be a non-empty text");
    texts.push_back(item.Scalar());
  }
  return texts;
}

YamlMap YamlMap::Section(const std::string& key) { return {Find(key), file_, key}; }

void YamlMap::Finish() const {
  if (!node_ || !node_.IsMap()) return;
  for (const auto& entry : node_) {
    const std::string key = entry.first.Scalar();
    if (std::find(asked_.begin(), asked_.end(), key) != asked_.end()) continue;
    const std::string where = name_.empty() ? "" : " in `" + name_ + "`";
    throw InputError(Where(entry.first),
                     "unknown key `" + key + "`" + where + "; legal keys: " + Joined(asked_));
  }
}

}  // namespace slam
