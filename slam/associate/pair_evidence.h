#pragma once

#include <vector>

#include "slam/associate/association_config.h"
#include "slam/associate/plane_comparison.h"
#include "slam/associate/refusals.h"
#include "slam/model/frame.h"
#include "slam/model/map.h"

namespace slam {

/// Whether a frame plane can show a map plane.
enum class PairVerdict {
  kRefused,
  kDoubtful,  ///< not good enough for a match, too good for a new surface
  kPossible
};

/// What speaks for and against one frame plane showing one map plane. Costs are -2 log
/// likelihood: less is better, and they add up.
struct PairEvidence {
  int map_plane = kNone;  ///< id
  bool on_trial = false;  ///< the map plane is a candidate
  int links = 0;          ///< keyframes since the map plane was last seen
  PairVerdict verdict = PairVerdict::kRefused;
  PairRefusal refusal = PairRefusal::kCost;  ///< why the pair is not possible
  double parameter_cost = 0.0;               ///< chi-square of offset and slopes
  /// What is known less well fits more: the likelihood is divided among all of that. A new
  /// landmark is known less well than an old one, and so is one that has drifted.
  double spread_cost = 0.0;
  double overlap_cost = 0.0, class_cost = 0.0, box_cost = 0.0;
  double share_cost = 0.0;  ///< others of the map show more of themselves on the frame plane
  double overlap = 0.0;     ///< share of the smaller footprint, [0, 1]
  int landed = 0;           ///< points of the map plane that land on the frame plane's pixels
  double landed_m2 = 0.0;   ///< the area that these stand for
  bool was_seen = false;    ///< points of the map plane cover most of the frame plane

  double Cost() const {
    return parameter_cost + spread_cost + overlap_cost + class_cost + box_cost + share_cost;
  }
};

/// A segment that holds so many times less of a landmark than can be seen of it is a fragment.
double FragmentRatio(const AssociationConfig& config);

/// By frame plane: the map planes that came into question, in the order of their ids.
using PairTable = std::vector<std::vector<PairEvidence>>;

/// Weighs every frame plane that can be matched against every surface of the map that its
/// parameters do not rule out at once; those are counted in `refused`.
/// @param predicted  the pose before it was corrected: what a keyframe's drift is like
PairTable WeighPairs(const Frame& frame, const Map& map, const UncertainPose& pose,
                     const UncertainPose& predicted, const Camera& camera,
                     const AssociationConfig& config, PairRefusals& refused);

/// The rank test (eq9 to eq12) puts in doubt the possible pairs of little overlap whose points
/// are distributed otherwise. A pair with too few points is not tested.
void TestRanks(const Frame& frame, const Map& map, const Pose& T_cw, const Camera& camera,
               const AssociationConfig& config, PairTable& pairs);

/// (frame plane, landmark) that fit, overlap by half, and have no competitor on the frame
/// plane's side: the landmarks by which a predicted pose can be corrected. One that was last seen
/// some keyframes ago shows the drift since then, and no error of the pose.
std::vector<std::pair<int, int>> PairsBeyondDoubt(const Frame& frame, const PairTable& pairs);

}  // namespace slam
