#pragma once

#include <map>
#include <set>
#include <vector>

#include "slam/model/frame.h"
#include "slam/model/map.h"

namespace slam {

/// Decisions of association against truth, counted as the evaluation does: a landmark belongs
/// to the truth of the frame plane that made it.
struct DecisionScore {
  int true_positives = 0, false_positives = 0, false_negatives = 0, right_new = 0,
      undecided = 0;

  double Precision() const {
    return static_cast<double>(true_positives) / std::max(1, true_positives + false_positives);
  }
  double Recall() const {
    return static_cast<double>(true_positives) / std::max(1, true_positives + false_negatives);
  }

  /// Call once a frame, after its planes entered the map.
  void Count(const Frame& frame, const std::vector<int>& truth) {
    const std::set<int> had_owner = owned_;
    for (std::size_t f = 0; f < truth.size(); ++f) {
      const PlaneMatch& match = frame.plane_matches[f];
      if (match.decision == PlaneDecision::kMatched) {
        const bool right = owner_.at(match.map_plane) == truth[f];
        ++(right ? true_positives : false_positives);
        if (!right && had_owner.contains(truth[f])) ++false_negatives;
      } else if (match.decision == PlaneDecision::kNew) {
        owner_[match.map_plane] = truth[f];
        owned_.insert(truth[f]);
        ++(had_owner.contains(truth[f]) ? false_negatives : right_new);
      } else {
        ++undecided;
      }
    }
  }

 private:
  std::map<int, int> owner_;
  std::set<int> owned_;
};

}  // namespace slam
