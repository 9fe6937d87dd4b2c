#pragma once

#include <yaml-cpp/yaml.h>

#include <Eigen/Core>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <vector>

namespace sim {

/// A node of a YAML file that knows where it stands; every reading is strict.
/// All functions throw InputError with file:line.
class YamlValue {
 public:
  YamlValue(YAML::Node node, std::string file, std::string name, int line)
      : node_(std::move(node)), file_(std::move(file)), name_(std::move(name)), line_(line) {}

  std::string Where() const { return file_ + ":" + std::to_string(line_); }
  int Line() const { return line_; }
  [[noreturn]] void Fail(const std::string& what) const;

  /// A finite number in [low, high]; `unit` is for the message.
  double Number(double low, double high, const std::string& unit) const;
  /// A whole number in [low, high].
  std::uint64_t Whole(std::uint64_t low, std::uint64_t high) const;
  /// Letters, digits, space, '_', '-', '.', '/'; 1 to 64 of them, a letter or digit at both
  /// ends.
  std::string Word() const;
  /// The path of a file: letters, digits, space, '_', '-', '.', '/'; 1 to 256 of them.
  std::string Path() const;
  bool Flag() const;
  /// The place of the text among `choices`.
  std::size_t OneOf(const std::vector<std::string>& choices) const;
  /// A list of exactly `count` numbers.
  Eigen::VectorXd Numbers(int count, double low, double high, const std::string& unit) const;
  /// A list with at most `max_count` entries.
  std::vector<YamlValue> List(std::size_t max_count) const;

 private:
  friend class YamlMap;
  std::string Scalar(const std::string& expected) const;
  YAML::Node node_;
  std::string file_, name_;
  int line_;
};

/// A mapping with a known set of keys, each at most once.
class YamlMap {
 public:
  YamlMap(YamlValue value, std::vector<std::string> keys);
  bool Has(const std::string& key) const;
  /// @throws InputError when the key is missing.
  YamlValue At(const std::string& key) const;
  const YamlValue& Value() const { return value_; }

 private:
  YamlValue value_;
};

/// The root of one YAML document.
/// @throws InputError for bad syntax, more than one document, anchors, or nesting beyond
///   `max_depth`.
YamlValue ParseYaml(const std::string& text, const std::string& file, int max_depth);

}  // namespace sim
