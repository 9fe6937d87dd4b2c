#include "slam/mapping/plane_motion.h"

namespace slam {
namespace {

void MoveAll(std::vector<Eigen::Vector3d>& points_w, const Pose& T_new_old) {
  for (Eigen::Vector3d& p_w : points_w) p_w = T_new_old * p_w;
}

void MoveEstimate(PlaneEstimate& estimate, const Pose& T_new_old) {
  estimate.origin_w = T_new_old * estimate.origin_w;
  estimate.normal_w = (T_new_old.R * estimate.normal_w).normalized();
  estimate.axes = T_new_old.R * estimate.axes;
}

}  // namespace

void MovePlane(MapPlane& plane, const Pose& T_new_old) {
  // Transform takes planes as T_cw does: from the world into the frame on its left.
  plane.pi_w = Transform(T_new_old, plane.pi_w);
  plane.centroid_w = T_new_old * plane.centroid_w;
  MoveEstimate(plane.estimate, T_new_old);
  MoveAll(plane.points_w, T_new_old);
  MoveAll(plane.vertices_w, T_new_old);
  MoveAll(plane.hull_w, T_new_old);
  for (SupposedPlane& supposed : plane.supposed) MoveSupposed(supposed, T_new_old);
  for (PlanePart& part : plane.parts) {
    MovePlane(part.surface, T_new_old);
    MovePlane(part.rest, T_new_old);
  }
}

void MoveSupposed(SupposedPlane& plane, const Pose& T_new_old) {
  plane.pi_w = Transform(T_new_old, plane.pi_w);
  MoveEstimate(plane.estimate, T_new_old);
}

Pose MotionBetween(const Plane& from_w, const Plane& to_w, const Eigen::Vector3d& x_w) {
  const Eigen::Matrix3d R = RotationBetween(from_w.n, to_w.n);
  return {R, ProjectOnto(to_w, x_w) - R * ProjectOnto(from_w, x_w)};
}

}  // namespace slam
