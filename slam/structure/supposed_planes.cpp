#include "slam/structure/supposed_planes.h"

#include <cmath>
#include <optional>

#include "slam/model/map_queries.h"
#include "slam/pose/plane_constraints.h"
#include "slam/pose/pose_error.h"

namespace slam {
namespace {

/// The supposed plane that lies nearest, or none within the bounds: its position.
std::optional<std::size_t> NearestSupposed(const std::vector<SupposedPlane>& known,
                                           const Plane& pi_w, const Eigen::Vector3d& edge_w,
                                           const SupposedConfig& config) {
  std::optional<std::size_t> nearest;
  double least_m = config.max_offset_m;
  for (std::size_t i = 0; i < known.size(); ++i) {
    const double offset_m = std::abs(SignedDistance(known[i].pi_w, edge_w));
    if (!(Angle(known[i].pi_w.n, pi_w.n) < config.max_angle_rad) || !(offset_m < least_m))
      continue;
    least_m = offset_m;
    nearest = i;
  }
  return nearest;
}

PlaneConstraint ConstraintTo(const SupposedPlane& known, const MeasuredPlane& seen,
                             const Eigen::Vector3d& edge_w) {
  PlaneConstraint c{known.pi_w, seen.pi_c, seen.centroid_c, seen.angle_sigma_rad,
                    seen.offset_sigma_m};
  AddUncertainty(known.estimate, edge_w, c);
  return c;
}

void Observe(const MeasuredPlane& seen, const Frame& frame, double keep, SupposedPlane& known) {
  const Pose T_wc = Inverse(frame.T_cw);
  AddObservation(known.estimate, Transform(T_wc, seen.pi_c), T_wc * seen.centroid_c,
                 seen.angle_sigma_rad, seen.offset_sigma_m, keep,
                 VarianceAlong(CovarianceInWorld(frame), seen.pi_c.n, seen.centroid_c));
  known.pi_w = known.estimate.Mean();
  if (known.observations == 0) known.first_frame = frame.index;
  // Several lines along one edge are one observation.
  if (known.observations == 0 || known.last_frame != frame.index) ++known.observations;
  known.last_frame = frame.index;
}

/// The landmark that a trusted plane of the frame shows or has become, or none.
MapPlane* LandmarkOf(const Frame& frame, Map& map, std::size_t plane) {
  if (plane >= frame.plane_matches.size() || frame.planes[plane].bad) return nullptr;
  const PlaneMatch& match = frame.plane_matches[plane];
  return match.ShowsLandmark() ? &map.planes.At(CurrentPlane(map, match.map_plane)) : nullptr;
}

}  // namespace

std::vector<MeasuredPlane> SupposePlanes(const FramePlane& plane,
                                         const SupposedConfig& config) {
  std::vector<MeasuredPlane> out;
  for (const Line& line : plane.lines_c) {
    const Eigen::Vector3d edge_c = line.P + line.V.dot(plane.centroid_c - line.P) * line.V;
    Eigen::Vector3d n_c = line.V.cross(plane.pi_c.n);
    if (!(n_c.norm() > 0)) continue;
    n_c.normalize();
    if (n_c.dot(plane.centroid_c - edge_c) > 0) n_c = -n_c;
    out.push_back(
        {{n_c, -n_c.dot(edge_c)}, edge_c, config.angle_sigma_rad, config.offset_sigma_m});
  }
  return out;
}

void AddSupposedPlanes(const Frame& frame, const Map& map, const SupposedConfig& config,
                       PoseProblem& problem) {
  const Pose T_wc = Inverse(frame.T_cw);
  for (std::size_t i = 0; i < frame.planes.size(); ++i) {
    const MapPlane* matched = TrustedMatch(frame, map, i);
    if (matched == nullptr) continue;
    for (const MeasuredPlane& seen : SupposePlanes(frame.planes[i], config)) {
      const Plane pi_w = Transform(T_wc, seen.pi_c);
      const Eigen::Vector3d edge_w = T_wc * seen.centroid_c;
      const auto at = NearestSupposed(matched->supposed, pi_w, edge_w, config);
      if (!at || matched->supposed[*at].observations < config.min_observations) continue;
      problem.planes.push_back(ConstraintTo(matched->supposed[*at], seen, edge_w));
    }
  }
}

void LearnSupposedPlanes(const Frame& frame, double keep, const SupposedConfig& config,
                         Map& map) {
  const Pose T_wc = Inverse(frame.T_cw);
  // Where the map begins nothing else may hold the next frame, so that edges need not prove themselves.
  const bool map_begins =
      !map.keyframes.empty() && map.keyframes.front().frame_index == frame.index;
  for (std::size_t i = 0; i < frame.planes.size(); ++i) {
    MapPlane* landmark = LandmarkOf(frame, map, i);
    if (landmark == nullptr) continue;
    std::vector<SupposedPlane>& known = landmark->supposed;
    for (const MeasuredPlane& seen : SupposePlanes(frame.planes[i], config)) {
      const Plane pi_w = Transform(T_wc, seen.pi_c);
      const Eigen::Vector3d edge_w = T_wc * seen.centroid_c;
      const auto at = NearestSupposed(known, pi_w, edge_w, config);
      SupposedPlane& supposed = at ? known[*at] : known.emplace_back();
      Observe(seen, frame, keep, supposed);
      if (map_begins) supposed.observations = config.min_observations;
    }
    std::erase_if(known, [&](const SupposedPlane& supposed) {
      return supposed.observations < config.min_observations &&
             frame.index - supposed.last_frame > config.max_misses;
    });
  }
}

}  // namespace slam
