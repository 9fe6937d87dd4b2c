#include "slam/associate/nearest_rules.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "slam/associate/plane_gates.h"

namespace slam {
namespace {

struct PeerBounds {
  double min_cosine;
  bool is_signed;  ///< else a surface may be seen from behind
  double max_distance_m;
};

PeerBounds BoundsOf(AssociationRule rule) {
  switch (rule) {
    case AssociationRule::kManhattanSlam:
      return {0.985, true, 0.05};
    case AssociationRule::kPlanarSlam:
      return {0.86, false, 0.1};
    default:  // kSpSlam
      return {0.8, false, 0.2};
  }
}

double LeastDistance(const Plane& pi_w, const std::vector<Eigen::Vector3d>& points_w) {
  double least_m = std::numeric_limits<double>::infinity();
  for (const Eigen::Vector3d& p_w : points_w) {
    least_m = std::min(least_m, std::abs(SignedDistance(pi_w, p_w)));
  }
  return least_m;
}

/// Of the outline's corners and all between them.
double LeastDistanceOfOutline(const Plane& pi_w, const std::vector<Eigen::Vector3d>& hull_w) {
  const auto in_front = [&](const Eigen::Vector3d& p_w) {
    return SignedDistance(pi_w, p_w) > 0;
  };
  const auto front = std::count_if(hull_w.begin(), hull_w.end(), in_front);
  const bool crosses = front > 0 && front < std::ssize(hull_w);
  return crosses ? 0.0 : LeastDistance(pi_w, hull_w);
}

Result<double, PairRefusal> TestPeerBounds(const FramePlane& plane, const MapPlane& m,
                                           const Pose& T_cw, AssociationRule rule) {
  const PeerBounds bounds = BoundsOf(rule);
  const Plane pi_w = Transform(Inverse(T_cw), plane.pi_c);
  const double cosine = pi_w.n.dot(m.pi_w.n);
  if (!((bounds.is_signed ? cosine : std::abs(cosine)) > bounds.min_cosine))
    return PairRefusal::kNormalAngle;
  const double distance_m = rule == AssociationRule::kSpSlam
                                ? LeastDistanceOfOutline(pi_w, m.hull_w)
                                : LeastDistance(pi_w, m.points_w);
  if (!(distance_m < bounds.max_distance_m)) return PairRefusal::kNearestPoint;
  return distance_m;
}

}  // namespace

Result<double, PairRefusal> TestNearness(const FramePlane& plane, const MapPlane& m,
                                         const Pose& T_cw, AssociationRule rule,
                                         const PlaneGateConfig& gates) {
  if (rule != AssociationRule::kParameters) return TestPeerBounds(plane, m, T_cw, rule);
  std::vector<Eigen::Vector3d> edge_points_c;
  for (const EdgePoint& edge : plane.edge_points) edge_points_c.push_back(edge.p_c);
  return TestPlaneGates(plane.pi_c, plane.centroid_c, edge_points_c, m.pi_w, T_cw, gates);
}

}  // namespace slam
