#include "slam/faces/move_planes.h"

namespace slam {

void MovePlanes(const Pose& T_to_from, std::vector<FramePlane>& planes) {
  const Eigen::Matrix3d& R = T_to_from.R;
  for (FramePlane& plane : planes) {
    Plane moved = Transform(T_to_from, plane.pi_c);
    moved.n.normalize();
    if (!(moved.d > 0)) continue;  // seen from its edge, and from there not at all
    plane.pi_c = moved;
    plane.centroid_c = T_to_from * plane.centroid_c;
    plane.inverse_depth_covariance = R * plane.inverse_depth_covariance * R.transpose();
    for (Eigen::Vector3d& p_c : plane.points_c) p_c = T_to_from * p_c;
    for (EdgePoint& edge : plane.edge_points) edge.p_c = T_to_from * edge.p_c;
    for (Line& line : plane.lines_c) line = {T_to_from * line.P, R * line.V};
    for (Vertex& vertex : plane.vertices_c) {
      vertex.p_c = T_to_from * vertex.p_c;
      vertex.covariance_c = R * vertex.covariance_c * R.transpose();
    }
  }
}

}  // namespace slam
