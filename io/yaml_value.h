#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "io/interval.h"
#include "io/yaml_tree.h"

namespace io {

/// A value of a YAML file that knows where it stands and what it is called:
/// "desk.yaml:12: objects[2].size_m: expected ...". Every reading is strict, and throws
/// InputError for what is missing, of another kind, or not allowed.
class YamlValue {
 public:
  YamlValue(std::shared_ptr<const YamlNode> node, std::string file, std::string name = "")
      : node_(std::move(node)), file_(std::move(file)), name_(std::move(name)) {}

  /// @throws InputError "file:line: name: what"
  [[noreturn]] void Fail(const std::string& what) const;

  /// A finite number of the domain; `unit` is for the message.
  double Number(const Interval& domain, const std::string& unit = "") const;
  int Whole(const Interval& domain) const;
  /// Any whole number from 0 to 2^64 - 1.
  std::uint64_t Seed() const;
  bool Flag() const;
  /// The place of the text among `choices`.
  std::size_t OneOf(const std::vector<std::string>& choices) const;
  /// Any text but an empty one.
  std::string Text() const;
  /// 1 to 64 letters, digits, spaces, '_', '-', '.', '/'; a letter or digit at both ends.
  std::string Word() const;
  /// The path of a file: 1 to 256 of the same characters; no space at either end.
  std::string Path() const;
  /// A list of exactly `count` numbers.
  Eigen::VectorXd Numbers(int count, const Interval& domain,
                          const std::string& unit = "") const;
  /// Neither a list nor a mapping, for keys that allow a word or more.
  bool IsScalar() const;
  /// A list with at most `max_count` entries.
  std::vector<YamlValue> List(std::size_t max_count = std::size_t{1} << 20) const;

 private:
  friend class YamlMap;
  /// @throws InputError when it is no scalar
  const std::string& Scalar(const std::string& expected) const;
  [[noreturn]] void Expected(const std::string& expected) const;
  YamlValue Entry(const YamlNode& node, std::string name) const;

  std::shared_ptr<const YamlNode> node_;
  std::string file_, name_;
};

/// A mapping whose legal keys the caller knows: beforehand, or once all were asked for.
class YamlMap {
 public:
  /// Any keys may be there, also none: an empty or missing value is a mapping without keys.
  explicit YamlMap(YamlValue value);
  /// @throws InputError for an empty or missing value, and for a key that is not among `keys`
  YamlMap(YamlValue value, const std::vector<std::string>& keys);

  bool Has(const std::string& key) const;
  /// The value of `key`. Reading it throws when the key is missing, and tells what was
  /// expected.
  YamlValue At(const std::string& key) const;
  const YamlValue& value() const { return value_; }

  /// @throws InputError for a key that is not among `legal`: lists them, and names the one that
  ///   is spelt nearly so
  void RefuseOtherKeys(const std::vector<std::string>& legal) const;

 private:
  YamlValue value_;
};

/// The root of a text or of a file, which may have 1 MiB.
/// @throws InputError with file:line, see ParseYamlTree and ReadFile
YamlValue ParseYaml(const std::string& text, const std::string& file);
YamlValue ReadYaml(const std::filesystem::path& file, const std::string& mend = "");

}  // namespace io
