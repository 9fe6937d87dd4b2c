#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "io/interval.h"

namespace io {

/// A JSON value together with the place it came from, so that every fault can be named:
/// "file:line: planes[2].normal: expected 3 finite numbers". Unknown keys are ignored.
class JsonField {
 public:
  /// @param value  must outlive the field and those made from it
  JsonField(const nlohmann::json& value, std::string where, std::string path = "");

  /// The member `key`, which must be there. @throws InputError naming it.
  JsonField operator[](const std::string& key) const;
  /// The member, or nothing if it is missing or null.
  std::optional<JsonField> Find(const std::string& key) const;
  /// The elements of an array. @throws InputError if it is none.
  std::vector<JsonField> Elements() const;

  double Number() const;                        ///< finite
  double Number(const Interval& domain) const;  ///< in the domain
  int Integer() const;
  std::string Text() const;
  bool Boolean() const;
  Eigen::Vector3d Vector3() const;              ///< array of 3 finite numbers
  std::vector<double> Numbers() const;          ///< array of finite numbers
  std::vector<Eigen::Vector3d> Points() const;  ///< array of arrays of 3

  /// @throws InputError "where: path: expected ..., found ..."
  [[noreturn]] void Fail(const std::string& expected) const;

 private:
  const nlohmann::json* value_;
  std::string where_;
  std::string path_;
};

/// The document in a text. `where` (the file) is for messages.
/// @throws InputError with file:line, the text's first line being `first_line`, for what is not
///   JSON or is nested without reason
nlohmann::json ParseJson(const std::string& text, const std::filesystem::path& where,
                         int first_line = 1);

/// The document in a file. @param mend  see ReadFile
/// @throws InputError
nlohmann::json ReadJson(const std::filesystem::path& file, const std::string& mend = "");

/// Most bytes of a line that is one document; a frame of ours has some ten thousand.
inline constexpr std::size_t kMaxJsonLine_bytes = std::size_t{1} << 24;

/// Reads a file of one document a line; empty lines are left out. Holds one document at a time.
/// @throws InputError with file:line
void ForEachJsonLine(const std::filesystem::path& file, const std::string& mend,
                     const std::function<void(const JsonField& document)>& visit);

}  // namespace io
