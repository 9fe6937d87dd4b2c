#include "eval/trajectory/match_stamps.h"

#include "eval/formats/stamps.h"

namespace eval {

std::vector<StampMatch> MatchNearest(const Trajectory& truth, const Trajectory& estimate,
                                     double max_difference_s) {
  const bool truth_is_longer = truth.size() >= estimate.size();
  const std::vector<double> longer = StampsOf(truth_is_longer ? truth : estimate);
  const std::vector<double> shorter = StampsOf(truth_is_longer ? estimate : truth);
  std::vector<StampMatch> matches;
  for (std::size_t i = 0; i < shorter.size(); ++i) {
    const auto j = NearestStamp(longer, shorter[i], max_difference_s);
    if (j) matches.push_back(truth_is_longer ? StampMatch{*j, i} : StampMatch{i, *j});
  }
  return matches;
}

std::vector<StampMatch> MatchEqual(const Trajectory& truth, const Trajectory& estimate) {
  const std::vector<double> truth_s = StampsOf(truth);
  std::vector<StampMatch> matches;
  for (std::size_t i = 0; i < estimate.size(); ++i) {
    if (const auto j = FindStamp(truth_s, estimate[i].stamp_s)) matches.push_back({*j, i});
  }
  return matches;
}

}  // namespace eval
