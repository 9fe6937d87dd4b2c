#pragma once

#include "slam/model/frame.h"
#include "slam/model/plane_estimate.h"

namespace slam {

/// How far a view moves (turn, and way over distance) until it sees a surface through other bends.
/// Measured: docs/back_end.md, "What a plane is weighed by".
inline constexpr double kViewOfOneBend_rad = 0.2;

/// Frames from one place see a surface through the same bends: together they know no more than the
/// first of them. The factor on the bend's variance with which a frame after the first adds what is
/// new in it, by how far the camera moved since the frame before.
double SharedBend(const FramePlane& plane, const Frame& frame);

/// Adds a frame's plane to what is known of a surface, by its fit and what the sensor bends.
/// @param T_ac  from the frame's camera into the frame of the estimate
/// @param keep, world_variance_m2  as of AddObservation
void AddEvidence(PlaneEstimate& estimate_a, const FramePlane& plane, const Frame& frame,
                 const Pose& T_ac, double keep, double world_variance_m2 = 0.0);

/// An estimate as one observation, at the place where its height is known best.
struct PlaneEvidence {
  Plane pi;
  Eigen::Vector3d centroid;
  double angle_sigma_rad, offset_sigma_m;
};
/// @pre not empty
PlaneEvidence BestKnown(const PlaneEstimate& estimate);

}  // namespace slam
