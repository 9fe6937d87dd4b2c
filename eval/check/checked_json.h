#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "eval/check/fault.h"

namespace eval {

/// A JSON value together with the place it came from. Reading a member that is missing or of
/// the wrong type reports a fault at its pointer and gives nothing.
class CheckedJson {
 public:
  CheckedJson(FolderCheck& check, std::string file, int line, const nlohmann::json& value,
              std::string pointer = "");

  /// Reports a fault at this value, or at a member of it.
  void Report(std::string what, std::string mend) const;
  void ReportAt(const std::string& key, std::string what, std::string mend) const;

  bool Has(const std::string& key) const;       ///< present and not null
  bool Contains(const std::string& key) const;  ///< present, perhaps null

  std::optional<double> Number(const std::string& key) const;  ///< finite
  std::optional<long> Integer(const std::string& key) const;
  std::optional<std::string> Text(const std::string& key) const;
  std::optional<bool> Flag(const std::string& key) const;
  /// Exactly `count` finite numbers.
  std::optional<std::vector<double>> Numbers(const std::string& key, std::size_t count) const;
  /// The same for this value itself.
  std::optional<std::vector<double>> AsNumbers(std::size_t count) const;
  /// Members of an array, or none (a fault) when it is no array.
  std::vector<CheckedJson> Items(const std::string& key) const;
  std::vector<CheckedJson> AsItems() const;

  const nlohmann::json& value() const { return *value_; }

 private:
  const nlohmann::json* Find(const std::string& key, const char* expected) const;
  CheckedJson Child(const std::string& key, const nlohmann::json& value) const;

  FolderCheck* check_;
  std::string file_;
  int line_;
  const nlohmann::json* value_;
  std::string pointer_;
};

/// Parses a JSON document and hands its root, an object, to `visit`; a syntax error is a fault.
void VisitJson(FolderCheck& check, const std::string& file,
               const std::function<void(const CheckedJson&)>& visit);

/// The same for each line of a JSON-lines file; blank lines are faults. The visitor gets the
/// line.
void VisitJsonLines(FolderCheck& check, const std::string& file,
                    const std::function<void(const CheckedJson&, int line)>& visit);

}  // namespace eval
