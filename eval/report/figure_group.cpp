#include "eval/report/figure_group.h"

namespace eval {

using OrderedJson = nlohmann::ordered_json;

namespace {

OrderedJson NeesJson(const Nees& nees) {
  return {{"mean", nees.mean},
          {"median", nees.median},
          {"inside", nees.inside},
          {"above", nees.above}};
}

}  // namespace

OrderedJson ToJson(double value) { return value; }

OrderedJson ToJson(const Spread& spread) {
  return {{"median", spread.median}, {"p95", spread.p95}};
}

OrderedJson ToJson(const Statistics& errors_m) {
  return {{"rmse_m", errors_m.rmse},
          {"mean_m", errors_m.mean},
          {"median_m", errors_m.median},
          {"std_m", errors_m.std_dev},
          {"max_m", errors_m.max}};
}

OrderedJson ToJson(const RelativeScore& errors) {
  return {{"trans_rmse_m", errors.trans_rmse_m},
          {"rot_rmse_deg", errors.rot_rmse_deg},
          {"pairs", errors.pairs}};
}

OrderedJson ToJson(const ClaimScore& claims) {
  return {{"count", claims.count},
          {"position_nees", NeesJson(claims.position)},
          {"rotation_nees", NeesJson(claims.rotation)},
          {"pose_nees", NeesJson(claims.pose)},
          {"silent", claims.silent}};
}

OrderedJson ToJson(const PlaneClaims& claims) {
  return {{"count", claims.count}, {"nees", NeesJson(claims.nees)}, {"silent", claims.silent}};
}

void FigureGroup::Undefined(const std::string& key, const std::string& reason) {
  Put(key, nullptr);
  reasons_[name_ + "/" + key] = reason;
}

void FigureGroup::PutShare(const std::string& key, double value, bool defined,
                           const std::string& reason) {
  if (!defined) return Undefined(key, reason);
  Put(key, value);
}

void FigureGroup::PutShares(const std::string& key, const PrecisionRecall& shares,
                            const std::string& no_found, const std::string& no_truth) {
  PutShare(key + "/precision", shares.precision, no_found.empty(), no_found);
  PutShare(key + "/recall", shares.recall, no_truth.empty(), no_truth);
  PutShare(key + "/f1", shares.f1, no_found.empty() || no_truth.empty(), no_found);
}

}  // namespace eval
