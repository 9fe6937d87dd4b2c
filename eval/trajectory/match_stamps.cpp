#include "eval/trajectory/match_stamps.h"

#include <algorithm>
#include <cmath>

#include "eval/formats/stamped_files.h"

namespace eval {
namespace {

std::vector<double> Stamps(const Trajectory& trajectory) {
  std::vector<double> stamps_s;
  stamps_s.reserve(trajectory.size());
  for (const StampedPose& pose : trajectory) stamps_s.push_back(pose.stamp_s);
  return stamps_s;
}

/// First of the nearest entries; a list in any order, as imported files may be.
std::size_t NearestIndex(const std::vector<double>& stamps_s, double stamp_s) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < stamps_s.size(); ++i) {
    if (std::abs(stamps_s[i] - stamp_s) < std::abs(stamps_s[best] - stamp_s)) best = i;
  }
  return best;
}

}  // namespace

std::vector<StampMatch> MatchNearest(const Trajectory& truth, const Trajectory& estimate,
                                     double max_difference_s) {
  const bool truth_is_longer = truth.size() >= estimate.size();
  const std::vector<double> longer = Stamps(truth_is_longer ? truth : estimate);
  const std::vector<double> shorter = Stamps(truth_is_longer ? estimate : truth);
  std::vector<StampMatch> matches;
  for (std::size_t i = 0; i < shorter.size(); ++i) {
    const std::size_t j = NearestIndex(longer, shorter[i]);
    if (!(std::abs(longer[j] - shorter[i]) <= max_difference_s)) continue;
    matches.push_back(truth_is_longer ? StampMatch{j, i} : StampMatch{i, j});
  }
  return matches;
}

std::vector<StampMatch> MatchEqual(const Trajectory& truth, const Trajectory& estimate) {
  const std::vector<double> truth_s = Stamps(truth);
  std::vector<StampMatch> matches;
  for (std::size_t i = 0; i < estimate.size(); ++i) {
    if (const auto j = FindStamp(truth_s, estimate[i].stamp_s)) matches.push_back({*j, i});
  }
  return matches;
}

}  // namespace eval
