#pragma once

#include <Eigen/Core>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "eval/formats/folder.h"
#include "io/interval.h"

namespace eval {

/// A JSON value together with the place it came from. Reading a member that is missing or of
/// the wrong type tells a fault at its pointer and gives nothing.
class JsonRecord {
 public:
  JsonRecord(Folder& folder, std::string file, int line, const nlohmann::json& value,
             std::string pointer = "");

  /// The same value, members of which may be missing or null.
  JsonRecord Optional() const { return WithNeed(Need::kOptional); }
  /// The same value, members of which should be there, but nobody needs them: that one is
  /// missing or null is a flaw.
  JsonRecord Expected() const { return WithNeed(Need::kExpected); }
  /// The same value, members of which the format does not ask for: they may be missing or null, and
  /// what another program means by them is passed over with a warning.
  JsonRecord Extra() const;

  /// Tells a fault at this value, or at a member of it.
  void Tell(std::string what, std::string mend, Severity severity = Severity::kFatal) const;
  void TellAt(const std::string& key, std::string what, std::string mend,
              Severity severity = Severity::kFatal) const;

  bool Has(const std::string& key) const;       ///< present and not null
  bool Contains(const std::string& key) const;  ///< present, perhaps null

  std::optional<double> Number(const std::string& key) const;  ///< finite
  std::optional<double> Number(const std::string& key, const io::Interval& domain) const;
  std::optional<double> Whole(const std::string& key) const;  ///< a number of any size
  std::optional<int> Integer(const std::string& key, int min = std::numeric_limits<int>::min(),
                             int max = std::numeric_limits<int>::max()) const;
  /// That it is empty is a flaw.
  std::optional<std::string> Text(const std::string& key) const;
  std::optional<bool> Flag(const std::string& key) const;
  /// Tells when the text, which names the format of the file, is another one.
  void Format(const std::string& expected) const;

  /// Exactly `count` finite numbers; those of this value itself.
  std::optional<std::vector<double>> Numbers(const std::string& key, std::size_t count) const;
  std::optional<std::vector<double>> AsNumbers(std::size_t count) const;
  /// Three numbers, none of them beyond kMaxCoordinate_m.
  std::optional<Eigen::Vector3d> Vector3(const std::string& key) const;
  std::optional<Eigen::Vector3d> AsVector3() const;
  /// Vectors of a list; none when one of them is at fault.
  std::vector<Eigen::Vector3d> Points(const std::string& key) const;
  std::vector<Eigen::Vector3d> AsPoints() const;
  std::optional<JsonRecord> Object(const std::string& key) const;
  /// Members of an array, or none (a fault) when it is no array.
  std::vector<JsonRecord> Items(const std::string& key) const;
  std::vector<JsonRecord> AsItems() const;

  const nlohmann::json& value() const { return *value_; }
  int line() const { return line_; }

 private:
  enum class Need { kRequired, kExpected, kOptional };
  JsonRecord WithNeed(Need need) const;
  /// The member; nothing when it is missing, which is a fault if it is needed.
  std::optional<JsonRecord> Find(const std::string& key, const char* expected) const;
  void TellExpected(const std::string& expected) const;
  /// Something within this value.
  JsonRecord Inner(const nlohmann::json& value, const std::string& key) const;

  Folder* folder_;
  std::string file_;
  int line_;
  const nlohmann::json* value_;
  std::string pointer_;
  Need need_ = Need::kRequired;
  Severity wrong_ = Severity::kFatal;  ///< that a member is of another kind than expected
};

/// Parses a JSON document and hands its root, an object, to `visit`.
void VisitJson(Folder& folder, const std::string& file,
               const std::function<void(const JsonRecord&)>& visit);

/// The same for each line of a JSON-lines file. A blank line is a flaw.
void VisitJsonLines(Folder& folder, const std::string& file,
                    const std::function<void(const JsonRecord&)>& visit);

}  // namespace eval
