#pragma once

#include "slam/model/frame_plane.h"
#include "slam/model/plane_estimate.h"

namespace slam {

/// Number of frames that see a surface through the same bends, at an ordinary speed: they know no
/// more than the first of them.
inline constexpr double kFramesOfOneBend = 10.0;

/// Adds a frame's plane to what is known of a surface, by its fit and what the sensor bends.
/// @param T_ac  from the frame's camera into the frame of the estimate
/// @param keep  as of AddObservation
void AddEvidence(PlaneEstimate& estimate_a, const FramePlane& plane, const Pose& T_ac,
                 double keep);

/// An estimate as one observation, at the place where its height is known best.
struct PlaneEvidence {
  Plane pi;
  Eigen::Vector3d centroid;
  double angle_sigma_rad, offset_sigma_m;
};
/// @pre not empty
PlaneEvidence BestKnown(const PlaneEstimate& estimate);

}  // namespace slam
