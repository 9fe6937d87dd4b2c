#include "slam/pose/plane_constraints.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "slam/base/index.h"
#include "slam/model/map_queries.h"

namespace slam {
namespace {

/// A side tells where the top face ends only if the face's own pixels reach it, the image goes
/// on behind it, and most boundary points there are ends of the surface.
std::array<bool, 4> InformativeSides(const Frame& frame, const FramePlane& plane,
                                     std::size_t detection, const Camera& camera,
                                     double max_gap_px) {
  constexpr double kImageMargin_px = 4.0;  // as inexact as a detection box is
  const Box& box = frame.detections[detection].box_px;
  const Box& own = plane.box_px;
  const Box image = camera.ImageBox();
  // The face's own pixels reach the side, and the image goes on behind it.
  std::array<bool, 4> use{std::abs(box.min.x() - own.min.x()) < max_gap_px &&
                              box.min.x() > image.min.x() + kImageMargin_px,
                          std::abs(box.min.y() - own.min.y()) < max_gap_px &&
                              box.min.y() > image.min.y() + kImageMargin_px,
                          std::abs(box.max.x() - own.max.x()) < max_gap_px &&
                              box.max.x() < image.max.x() - kImageMargin_px,
                          std::abs(box.max.y() - own.max.y()) < max_gap_px &&
                              box.max.y() < image.max.y() - kImageMargin_px};
  // Where most boundary points at a side are no end of the surface, it goes on beneath
  // something nearer.
  std::array<int, 4> at_side{}, hidden{};
  for (const EdgePoint& edge : plane.edge_points) {
    const std::array<double, 4> gap{edge.u_px.x() - own.min.x(), edge.u_px.y() - own.min.y(),
                                    own.max.x() - edge.u_px.x(), own.max.y() - edge.u_px.y()};
    for (std::size_t side = 0; side < 4; ++side) {
      if (!(gap[side] < kImageMargin_px)) continue;
      ++at_side[side];
      hidden[side] += edge.kind == EdgeKind::kSurface ? 0 : 1;
    }
  }
  for (std::size_t side = 0; side < 4; ++side) {
    use[side] = use[side] && at_side[side] > 0 && 2 * hidden[side] < at_side[side];
  }
  return use;
}

/// The box of the matched corners against the detection's, eq17.
void AddBox(const Frame& frame, const FramePlane& plane, const MapPlane& map_plane,
            const Camera& camera, const PlaneConstraintConfig& config, PoseProblem& problem) {
  if (!plane.detection || map_plane.vertices_w.size() != 4) return;
  const auto d = static_cast<std::size_t>(*plane.detection);
  if (d >= frame.detections.size() || frame.detections[d].compensated) return;
  BoxConstraint c;
  c.use = InformativeSides(frame, plane, d, camera, config.max_box_gap_px);
  if (std::none_of(c.use.begin(), c.use.end(), [](bool side) { return side; })) return;
  // A thick object's box shows its sides too: the less the face explains, the less it says.
  const double explained = Iou(plane.box_px, frame.detections[d].box_px);
  constexpr double kMinExplained = 0.25;  // below, sigma would be more than fourfold
  if (!(explained > kMinExplained)) return;
  c.corners_w = map_plane.vertices_w;
  c.box_obs_px = frame.detections[d].box_px;
  c.sigma_px = config.box_sigma_px / explained;
  problem.boxes.push_back(std::move(c));
}

/// Corners that the frame saw, each against the landmark's nearest.
void AddVertices(const Pose& T_cw, const FramePlane& plane, const MapPlane& map_plane,
                 PoseProblem& problem) {
  const Pose T_wc = Inverse(T_cw);
  for (const Vertex& vertex : plane.vertices_c) {
    if (vertex.extrapolated || !vertex.p_c.allFinite()) continue;
    const auto at = NearestVertex(map_plane, T_wc * vertex.p_c, kMaxVertexJump_m);
    if (!at || *at >= map_plane.vertex_weights.size()) continue;
    const double weight = map_plane.vertex_weights[*at];  // 1: one view, exact but for the rest
    if (!(weight > 0)) continue;
    problem.vertices.push_back(
        MakeVertexConstraint(vertex, plane.pi_c, kOtherVertexVariance_m2 / weight));
    problem.vertices.back().p_w = map_plane.vertices_w[*at];
  }
}

/// Matched points on the frame's planes, eq18; those that a pose threw out have no map point any more.
void AddPointPlanes(const Frame& frame, const Map& map, const PlaneConstraintConfig& config,
                    PoseProblem& problem) {
  const auto point_of = [&](const PointPlaneMatch& m) {
    return CurrentPoint(map, frame.map_points[Index(m.feature)]);
  };
  std::vector<double> count(frame.planes.size(), 0.0);
  for (const PointPlaneMatch& m : frame.point_planes) {
    if (point_of(m) != kNone) count[Index(m.frame_plane)] += 1;
  }
  for (const PointPlaneMatch& m : frame.point_planes) {
    const int id = point_of(m);
    if (id == kNone) continue;
    const std::size_t f = Index(m.frame_plane);
    // All points of a plane share its error: together they weigh no more than a few.
    const double share = std::max(1.0, count[f] / config.points_per_plane);
    problem.point_planes.push_back({map.points[Index(id)].p_w, frame.planes[f].pi_c,
                                    config.point_plane_sigma_m * std::sqrt(share)});
  }
}

}  // namespace

VertexConstraint MakeVertexConstraint(const Vertex& seen, const Plane& pi_c,
                                      double known_variance_m2) {
  const Eigen::Matrix<double, 2, 3> along = TangentBasis(pi_c.n).transpose();
  const Eigen::Matrix2d covariance =
      along * seen.covariance_c * along.transpose() +
      (kOtherVertexVariance_m2 + known_variance_m2) * Eigen::Matrix2d::Identity();
  VertexConstraint c;
  c.p_c = seen.p_c;
  c.sqrt_information = covariance.llt().matrixL().solve(along);
  return c;
}

PlaneConstraint MakePlaneConstraint(const FramePlane& f, const MapPlane& m, const Pose& T_cw,
                                    double offset_sigma_m, double angle_sigma_rad) {
  PlaneConstraint c{m.pi_w, f.pi_c, f.centroid_c, angle_sigma_rad, offset_sigma_m};
  // Some peers' rules match a surface with what was seen of it from behind.
  if (f.pi_c.n.dot(T_cw.R * c.pi_w.n) < 0) c.pi_w = {-c.pi_w.n, -c.pi_w.d};
  if (!m.estimate.empty())
    AddUncertainty(m.estimate, T_cw.R.transpose() * (f.centroid_c - T_cw.t), c);
  return c;
}

void AddUncertainty(const PlaneEstimate& estimate, const Eigen::Vector3d& x_w,
                    PlaneConstraint& constraint) {
  const Eigen::Matrix3d covariance = estimate.Covariance();
  const Eigen::Vector3d lever = estimate.Lever(x_w);
  double &offset_m = constraint.offset_sigma_m, &angle_rad = constraint.angle_sigma_rad;
  offset_m = std::sqrt(offset_m * offset_m + lever.dot(covariance * lever));
  angle_rad = std::sqrt(angle_rad * angle_rad + PlaneEstimate::WorstSlopeVariance(covariance));
  constraint.world_variance_m2 = estimate.world_variance_m2;
}

const MapPlane* TrustedMatch(const Frame& frame, const Map& map, std::size_t plane) {
  if (plane >= frame.plane_matches.size() || frame.planes[plane].bad) return nullptr;
  const PlaneMatch& match = frame.plane_matches[plane];
  if (match.decision != PlaneDecision::kMatched || match.map_plane < 0) return nullptr;
  return &map.planes.At(match.map_plane);
}

void AddPlaneConstraints(const Frame& frame, const Map& map, const Camera& camera,
                         const PlaneConstraintConfig& config, PoseProblem& problem) {
  for (std::size_t i = 0; i < frame.planes.size(); ++i) {
    const FramePlane& plane = frame.planes[i];
    const MapPlane* matched = TrustedMatch(frame, map, i);
    if (matched == nullptr) continue;
    problem.planes.push_back(MakePlaneConstraint(
        plane, *matched, frame.T_cw,
        std::hypot(plane.offset_sigma_m, config.bend_share * plane.bend_offset_sigma_m),
        std::hypot(plane.angle_sigma_rad, config.bend_share * plane.bend_angle_sigma_rad)));
    AddVertices(frame.T_cw, plane, *matched, problem);
    AddBox(frame, plane, *matched, camera, config, problem);
  }
  AddPointPlanes(frame, map, config, problem);
}

}  // namespace slam
