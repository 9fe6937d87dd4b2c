#pragma once

#include <cstddef>
#include <vector>

#include "eval/formats/pose/pose.h"
#include "eval/formats/sequence/sequence_agreement.h"

namespace eval {

/// Indices into the truth and the estimate that belong to one moment.
struct StampMatch {
  std::size_t truth = 0;
  std::size_t estimate = 0;
};

/// evo's rule, for recordings whose truth has its own clock: for each stamp of the shorter list
/// (the estimate, on equal lengths) the nearest of the longer one, the first on ties, kept if
/// |dt| <= max_difference_s. Not one-to-one. Both by rising stamp.
std::vector<StampMatch> MatchNearest(const Trajectory& truth, const Trajectory& estimate,
                                     double max_difference_s = kMaxStampDifference_s);

/// The rule for synthetic data: stamps are frame ids and must be equal (to kSameStamp_s).
/// Both by rising stamp; estimates without a truth are left out.
std::vector<StampMatch> MatchEqual(const Trajectory& truth, const Trajectory& estimate);

}  // namespace eval
