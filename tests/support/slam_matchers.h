#pragma once

#include <gmock/gmock.h>

#include "slam/geometry/plane.h"
#include "slam/geometry/pose.h"

namespace slam {

/// Matches a pose within an angle and a distance; a failure prints both poses and both errors.
MATCHER_P3(PoseNear, expected, tolerance_rad, tolerance_m, "") {
  const Pose& actual = arg;
  const double angle_rad = RotationAngle(expected, actual);
  const double distance_m = (expected.t - actual.t).norm();
  *result_listener << "rotated by " << angle_rad << " rad (at most " << tolerance_rad
                   << "), moved by " << distance_m << " m (at most " << tolerance_m
                   << ")\nactual R\n"
                   << actual.R << "\nt " << actual.t.transpose() << "\nexpected R\n"
                   << expected.R << "\nt " << expected.t.transpose();
  return angle_rad <= tolerance_rad && distance_m <= tolerance_m;
}

/// Matches an oriented plane within an angle and an offset; a failure prints both.
MATCHER_P3(PlaneNear, expected, tolerance_rad, tolerance_m, "") {
  const Plane& actual = arg;
  const double angle_rad = Angle(expected.n, actual.n);
  const double offset_m = std::abs(expected.d - actual.d);
  *result_listener << "turned by " << angle_rad << " rad (at most " << tolerance_rad
                   << "), offset by " << offset_m << " m (at most " << tolerance_m
                   << ")\nactual n " << actual.n.transpose() << " d " << actual.d
                   << "\nexpected n " << expected.n.transpose() << " d " << expected.d;
  return angle_rad <= tolerance_rad && offset_m <= tolerance_m;
}

/// Matches a vector within a distance; a failure prints both.
MATCHER_P2(VectorNear, expected, tolerance, "") {
  const double distance = (arg - expected).norm();
  *result_listener << "at distance " << distance << " (at most " << tolerance << ")\nactual "
                   << arg.transpose() << "\nexpected " << expected.transpose();
  return distance <= tolerance;
}

}  // namespace slam
