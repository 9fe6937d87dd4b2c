#pragma once

#include <yaml-cpp/yaml.h>

#include <cstdint>
#include <filesystem>
#include <limits>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "slam/base/require.h"

namespace slam {

/// A set of allowed numbers, written as in mathematics: "(0, inf)", "[0, 1]", "[1, 10)".
struct Interval {
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  bool closed_min = false, closed_max = false;
  std::string text = "(-inf, inf)";

  /// NaN and infinity are in no interval.
  bool Contains(double x) const;
};

/// @throws std::invalid_argument for text that is no interval (a mistake of the programmer).
Interval ParseInterval(std::string_view text);

/// One mapping of a YAML file, read strictly: a wrong type, a value outside its domain, a
/// repeated key, a missing required key and, at Finish, a key that nobody asked for are all
/// InputErrors that name file:line. The legal keys are those that were asked for.
class YamlMap {
 public:
  /// Reads a whole file, at most 1 MiB. An empty file is an empty mapping.
  /// @throws InputError when it cannot be read, is not YAML or its top is not a mapping.
  static YamlMap Load(const std::filesystem::path& file);

  /// A mapping inside another; `name` is for messages.
  YamlMap(const YAML::Node& node, std::string file, std::string name);

  bool Has(const std::string& key);
  /// The value of `key`; `fallback` (when there is one) if the key is absent.
  double Number(const std::string& key, const Interval& domain);
  double Number(const std::string& key, const Interval& domain, double fallback);
  std::int64_t Integer(const std::string& key, const Interval& domain);
  std::int64_t Integer(const std::string& key, const Interval& domain, std::int64_t fallback);
  bool Flag(const std::string& key, bool fallback);
  /// One of `choices`.
  std::string Choice(const std::string& key, const std::vector<std::string>& choices,
                     const std::string& fallback);
  /// A sequence of non-empty texts; empty when the key is absent.
  std::vector<std::string> Texts(const std::string& key);
  /// The mapping below `key`; empty when absent.
  YamlMap Section(const std::string& key);

  /// Refuses keys that were never asked for.
  void Finish() const;

  /// An error at the line of `key` (or of the mapping when it is absent).
  [[noreturn]] void Fail(const std::string& key, const std::string& what) const;

 private:
  YAML::Node Find(const std::string& key);
  std::string Where(const YAML::Node& node) const;
  std::string Scalar(const YAML::Node& node, const std::string& key,
                     const std::string& expected) const;

  YAML::Node node_;
  std::string file_, name_;
  std::vector<std::string> asked_;  ///< in the order of asking: the order of the legal keys
};

}  // namespace slam
