#include "sim/scene/yaml_value.h"

#include <yaml-cpp/eventhandler.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>
#include <sstream>
#include <string_view>

#include "sim/scene/input_error.h"
#include "sim/scene/number_text.h"

namespace sim {
namespace {

constexpr std::size_t kMaxWord = 64;
constexpr std::size_t kMaxShown = 40;  // characters of the file quoted in a message

std::string Shown(const std::string& text) {
  std::string shown;
  for (const char c : text.substr(0, kMaxShown)) shown += c >= ' ' && c != 127 ? c : '?';
  return "'" + shown + (text.size() > kMaxShown ? "...'" : "'");
}

std::string Joined(const std::vector<std::string>& words) {
  std::string joined;
  for (const std::string& word : words) joined += (joined.empty() ? "" : ", ") + word;
  return joined;
}

bool IsLetterOrDigit(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
}

/// Walks the document before it is built, so that a hostile one costs nothing.
class DepthGuard : public YAML::EventHandler {
 public:
  DepthGuard(std::string file, int max_depth) : file_(std::move(file)), max_depth_(max_depth) {}
  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override { Refuse(mark, anchor); }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override { Refuse(mark, 1); }
  void OnScalar(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor,
                const std::string&) override {
    Refuse(mark, anchor);
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    Enter(mark, anchor);
  }
  void OnSequenceEnd() override { --depth_; }
  void OnMapStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    Enter(mark, anchor);
  }
  void OnMapEnd() override { --depth_; }

 private:
  std::string At(const YAML::Mark& mark) const {
    return file_ + ":" + std::to_string(mark.line + 1);
  }
  void Refuse(const YAML::Mark& mark, YAML::anchor_t anchor) const {
    if (anchor == 0) return;
    throw InputError(At(mark),
                     "anchors and aliases are not part of the format; write the value "
                     "out");
  }
  void Enter(const YAML::Mark& mark, YAML::anchor_t anchor) {
    Refuse(mark, anchor);
    if (++depth_ > max_depth_) {
      throw InputError(At(mark), "nested deeper than " + std::to_string(max_depth_) +
                                     " levels; a scene needs fewer");
    }
  }
  std::string file_;
  int max_depth_;
  int depth_ = 0;
};

/// The part of a key before its unit: "size_m" and "size_mm" share "size".
std::string Stem(const std::string& key) { return key.substr(0, key.rfind('_')); }

}  // namespace

void YamlValue::Fail(const std::string& what) const {
  throw InputError(Where(), name_ + ": " + what);
}

std::string YamlValue::Scalar(const std::string& expected) const {
  if (!node_.IsScalar()) {
    Fail("expected " + expected + ", found " +
         (node_.IsMap()        ? "a mapping"
          : node_.IsSequence() ? "a list"
                               : "nothing"));
  }
  return node_.Scalar();
}

double YamlValue::Number(double low, double high, const std::string& unit) const {
  const std::string expected = "a number" + (unit.empty() ? "" : " in " + unit);
  const std::string text = Scalar(expected);
  const char* const first = text.data() + (text.starts_with('+') ? 1 : 0);
  double number = 0;
  const auto [end, error] = std::from_chars(first, text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size() || node_.Tag() == "!") {
    Fail("expected " + expected + " without quotes or unit, found " + Shown(text));
  }
  if (!std::isfinite(number)) Fail("expected " + expected + ", found " + Shown(text));
  if (!(number >= low && number <= high)) {
    Fail("expected " + expected + " from " + NumberText(low) + " to " + NumberText(high) +
         ", found " + Shown(text));
  }
  return number;
}

std::uint64_t YamlValue::Whole(std::uint64_t low, std::uint64_t high) const {
  const std::string expected =
      "a whole number from " + std::to_string(low) + " to " + std::to_string(high);
  const std::string text = Scalar(expected);
  std::uint64_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool whole =
      error == std::errc() && end == text.data() + text.size() && node_.Tag() != "!";
  if (!whole || number < low || number > high) {
    Fail("expected " + expected + ", found " + Shown(text));
  }
  return number;
}

std::string YamlValue::Word() const {
  const std::string expected =
      "1 to 64 letters, digits, spaces or _-./ with a letter or digit at both ends";
  const std::string text = Scalar(expected);
  const bool fits = !text.empty() && text.size() <= kMaxWord && IsLetterOrDigit(text.front()) &&
                    IsLetterOrDigit(text.back()) &&
                    std::all_of(text.begin(), text.end(), [](char c) {
                      return IsLetterOrDigit(c) || std::string(" _-./").find(c) < 5;
                    });
  if (!fits) Fail("expected " + expected + ", found " + Shown(text));
  return text;
}

std::string YamlValue::Path() const {
  constexpr std::size_t kMaxPath = 256;
  const std::string expected =
      "a path of letters, digits, spaces and _-./, at most 256 characters";
  const std::string text = Scalar(expected);
  const bool good = std::all_of(text.begin(), text.end(), [](char c) {
    return IsLetterOrDigit(c) || std::string_view(" _-./").find(c) != std::string_view::npos;
  });
  if (text.empty() || text.size() > kMaxPath || !good || text.front() == ' ' ||
      text.back() == ' ') {
    Fail("expected " + expected + ", found " + Shown(text));
  }
  return text;
}

bool YamlValue::Flag() const { return OneOf({"false", "true"}) == 1; }

std::size_t YamlValue::OneOf(const std::vector<std::string>& choices) const {
  const std::string text = Scalar("one of: " + Joined(choices));
  const auto at = std::find(choices.begin(), choices.end(), text);
  if (at == choices.end()) {
    Fail("expected one of: " + Joined(choices) + "; found " + Shown(text));
  }
  return static_cast<std::size_t>(at - choices.begin());
}

Eigen::VectorXd YamlValue::Numbers(int count, double low, double high,
                                   const std::string& unit) const {
  const std::string expected =
      "a list of " + std::to_string(count) + " numbers" + (unit.empty() ? "" : " in " + unit);
  if (!node_.IsSequence() || node_.size() != static_cast<std::size_t>(count)) {
    Fail("expected " + expected);
  }
  Eigen::VectorXd numbers(count);
  int i = 0;
  for (const YamlValue& entry : List(node_.size()))
    numbers[i++] = entry.Number(low, high, unit);
  return numbers;
}

std::vector<YamlValue> YamlValue::List(std::size_t max_count) const {
  if (!node_.IsSequence()) Fail("expected a list");
  if (node_.size() > max_count) {
    Fail("expected at most " + std::to_string(max_count) + " entries, found " +
         std::to_string(node_.size()));
  }
  std::vector<YamlValue> list;
  for (const YAML::Node& node : node_) {
    const int line = node.Mark().line >= 0 ? node.Mark().line + 1 : line_;
    list.emplace_back(node, file_, name_ + "[" + std::to_string(list.size()) + "]", line);
  }
  return list;
}

YamlMap::YamlMap(YamlValue value, std::vector<std::string> keys) : value_(std::move(value)) {
  if (!value_.node_.IsMap()) value_.Fail("expected a mapping with keys: " + Joined(keys));
  std::set<std::string> seen;
  for (const auto& entry : value_.node_) {
    const YamlValue key(entry.first, value_.file_, value_.name_, entry.first.Mark().line + 1);
    const std::string text = key.Scalar("a key");
    if (std::find(keys.begin(), keys.end(), text) == keys.end()) {
      std::string hint;
      for (const std::string& known : keys) {
        if (Stem(known) == Stem(text)) hint = "; did you mean " + known + "?";
      }
      key.Fail("unknown key " + Shown(text) + hint + " Keys here: " + Joined(keys) +
               " (lengths in metres, angles in degrees)");
    }
    if (!seen.insert(text).second) key.Fail("key " + Shown(text) + " stands twice; keep one");
  }
}

bool YamlMap::Has(const std::string& key) const {
  const YAML::Node& node = value_.node_;
  return static_cast<bool>(node[key]);
}

YamlValue YamlMap::At(const std::string& key) const {
  const YAML::Node& map = value_.node_;
  const YAML::Node node = map[key];
  if (!node) value_.Fail("key '" + key + "' is missing; add it");
  const int line = node.Mark().line >= 0 ? node.Mark().line + 1 : value_.line_;
  return {node, value_.file_, value_.name_.empty() ? key : value_.name_ + "." + key, line};
}

YamlValue ParseYaml(const std::string& text, const std::string& file, int max_depth) {
  try {
    std::istringstream stream(text);
    YAML::Parser parser(stream);
    DepthGuard guard(file, max_depth);
    if (!parser.HandleNextDocument(guard)) {
      throw InputError(file + ":1", "the file is empty; expected a YAML mapping");
    }
    if (parser.HandleNextDocument(guard)) {
      throw InputError(file, "holds more than one YAML document; keep one");
    }
    const YAML::Node root = YAML::Load(text);
    return {root, file, "scene", root.Mark().line + 1};
  } catch (const YAML::Exception& error) {
    const int line = std::max(error.mark.line, 0) + 1;
    throw InputError(file + ":" + std::to_string(line), "not valid YAML: " + error.msg);
  }
}

}  // namespace sim
