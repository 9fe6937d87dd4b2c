#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>

#include "eval/planes/association.h"
#include "eval/planes/map_score.h"
#include "eval/trajectory/score_trajectory.h"

namespace eval {

nlohmann::ordered_json ToJson(double value);
nlohmann::ordered_json ToJson(const Spread& spread);
nlohmann::ordered_json ToJson(const Statistics& errors_m);
nlohmann::ordered_json ToJson(const RelativeScore& errors);
nlohmann::ordered_json ToJson(const ClaimScore& claims);
nlohmann::ordered_json ToJson(const PlaneClaims& claims);

/// One group of figures. A figure that is not defined is null, and the reason stands in `reasons`
/// under "group/figure".
class FigureGroup {
 public:
  using Json = nlohmann::ordered_json;

  FigureGroup(std::string name, Json& reasons) : name_(std::move(name)), reasons_(reasons) {}

  /// @param key  of the group, or of an object in it ("decision/recall")
  template <typename Value>
  void Put(const std::string& key, const Value& value) {
    json_[Json::json_pointer("/" + key)] = value;
  }
  /// By a name that may hold anything, of the group itself.
  void PutNamed(const std::string& name, Json value) { json_[name] = std::move(value); }
  template <typename Value>
  void Put(const std::string& key, const std::optional<Value>& value,
           const std::string& reason) {
    if (!value) return Undefined(key, reason);
    Put(key, ToJson(*value));
  }
  void Undefined(const std::string& key, const std::string& reason);
  void PutShare(const std::string& key, double value, bool defined, const std::string& reason);
  /// Precision, recall and f1 of what was found among what is there.
  void PutShares(const std::string& key, const PrecisionRecall& shares,
                 const std::string& no_found, const std::string& no_truth);
  const Json& json() const { return json_; }

 private:
  std::string name_;
  Json json_ = Json::object();
  Json& reasons_;
};

}  // namespace eval
