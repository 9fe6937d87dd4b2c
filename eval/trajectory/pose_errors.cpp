#include "eval/trajectory/pose_errors.h"

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace eval {
namespace {

double Measure(const Pose& error, Relation relation) {
  switch (relation) {
    case Relation::kTranslation:
      return error.t.norm();
    case Relation::kAngleDeg:
      return AngleOf(error.R) * 180.0 / std::numbers::pi;
    case Relation::kFull:
      break;
  }
  return std::sqrt((error.R - Eigen::Matrix3d::Identity()).squaredNorm() +
                   error.t.squaredNorm());
}

void RequireEqualCounts(const std::vector<Pose>& estimate, const std::vector<Pose>& truth) {
  if (estimate.size() != truth.size()) {
    throw std::invalid_argument("pose errors: the lists differ in length");
  }
}

}  // namespace

std::vector<double> AbsoluteErrors(const std::vector<Pose>& estimate,
                                   const std::vector<Pose>& truth, Relation relation) {
  RequireEqualCounts(estimate, truth);
  std::vector<double> errors;
  errors.reserve(truth.size());
  for (std::size_t i = 0; i < truth.size(); ++i) {
    // |t_E| is |p - q|; taken directly, it keeps its digits far from the origin.
    if (relation == Relation::kTranslation) {
      errors.push_back((estimate[i].t - truth[i].t).norm());
    } else {
      errors.push_back(Measure(Inverse(estimate[i]) * truth[i], relation));
    }
  }
  return errors;
}

std::vector<double> RelativeErrors(const std::vector<Pose>& estimate,
                                   const std::vector<Pose>& truth,
                                   const std::vector<PosePair>& pairs, Relation relation) {
  RequireEqualCounts(estimate, truth);
  const auto relative = [](const Pose& a, const Pose& b) {
    return Pose{a.R.transpose() * b.R, a.R.transpose() * (b.t - a.t)};
  };
  std::vector<double> errors;
  errors.reserve(pairs.size());
  for (const auto& [i, j] : pairs) {
    const Pose moved_truth = relative(truth[i], truth[j]);
    const Pose moved_estimate = relative(estimate[i], estimate[j]);
    errors.push_back(Measure(relative(moved_truth, moved_estimate), relation));
  }
  return errors;
}

}  // namespace eval
