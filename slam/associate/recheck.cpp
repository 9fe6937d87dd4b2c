#include "slam/associate/recheck.h"

#include "slam/associate/plane_comparison.h"
#include "slam/associate/plane_overlap.h"
#include "slam/pose/pose_error.h"

namespace slam {

int TakeBackContradicted(Frame& frame, const Map& map, const Camera& camera,
                         const AssociationConfig& config) {
  // The paper's rule knows of no uncertainty.
  if (!config.recheck || config.rule != AssociationRule::kIntegrated) return 0;
  const UncertainPose pose{frame.T_cw, PoseErrorCovariance(frame)};
  const auto holds = [&](const FramePlane& seen, const MapPlane& landmark) {
    return ComparePlanes(seen, landmark, pose, config).chi2 < config.max_chi2 &&
           Overlap(ViewMapPlane(landmark, frame, frame.T_cw, camera), seen) >
               config.min_overlap;
  };
  int taken_back = 0;
  for (std::size_t f = 0; f < frame.planes.size(); ++f) {
    PlaneMatch& match = frame.plane_matches[f];
    if (match.decision != PlaneDecision::kMatched) continue;
    if (holds(frame.planes[f], map.planes.At(match.map_plane))) continue;
    match = {PlaneDecision::kUnmatched, kNone, MatchReason::kAmbiguous};
    ++taken_back;
  }
  return taken_back;
}

}  // namespace slam
