#pragma once

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace eval {

/// A JSON value together with the place it came from, so that every fault can be named:
/// "file:line: planes[2].normal: expected 3 finite numbers". Unknown keys are ignored.
class JsonField {
 public:
  JsonField(const nlohmann::json& value, std::string where, std::string path = "");

  /// The member `key`, which must be there. @throws InputError naming it.
  JsonField operator[](const std::string& key) const;
  /// The member, or nothing if it is missing or null.
  std::optional<JsonField> Find(const std::string& key) const;
  /// The elements of an array. @throws InputError if it is none.
  std::vector<JsonField> Elements() const;

  double Number() const;  ///< finite
  int Integer() const;
  std::string Text() const;
  bool Boolean() const;
  Eigen::Vector3d Vector3() const;              ///< array of 3 finite numbers
  std::vector<double> Numbers() const;          ///< array of finite numbers
  std::vector<Eigen::Vector3d> Points() const;  ///< array of arrays of 3

  bool IsNull() const { return value_->is_null(); }
  [[noreturn]] void Fail(const std::string& expected) const;

 private:
  const nlohmann::json* value_;
  std::string where_;
  std::string path_;
};

/// Parses a text; syntax faults become InputError with `file` and the line (counted from
/// `first_line`).
nlohmann::json ParseJson(const std::string& text, const std::filesystem::path& file,
                         int first_line = 1);

/// One document of a JSON lines file.
struct JsonLine {
  int number = 0;  ///< from 1
  nlohmann::json value;
};

/// Every non-empty line as a JSON document. @throws InputError with file:line.
std::vector<JsonLine> ReadJsonLines(const std::filesystem::path& file);

}  // namespace eval
