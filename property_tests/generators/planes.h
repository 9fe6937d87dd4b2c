#pragma once

#include "property_tests/generators/poses.h"
#include "slam/geometry/plane.h"

namespace slam {

/// Any oriented plane; every tenth passes through the origin.
inline Plane AnyPlane(double half_m) {
  const Eigen::Vector3d n = AnyUnit();
  return {n, AnyInt(0, 9) == 0 ? AnyReal(-1e-9, 1e-9) : AnyReal(-half_m, half_m)};
}

/// A plane as a camera measures it: facing the camera, in front of it, and a point of it that
/// the camera sees.
struct SeenPlane {
  Plane pi_c;
  Eigen::Vector3d point_c;
};
inline SeenPlane AnySeenPlane() {
  const double z = AnyReal(0.4, 4);
  const Eigen::Vector3d x_c(AnyReal(-0.5, 0.5) * z, AnyReal(-0.4, 0.4) * z, z);
  Eigen::Vector3d n = AnyUnit();
  const Eigen::Vector3d ray = x_c.normalized();
  if (n.dot(ray) > 0) n = -n;
  if (n.dot(ray) > -0.1) n = (n - 0.5 * ray).normalized();  // not edge-on
  return {{n, -n.dot(x_c)}, x_c};
}

}  // namespace slam
