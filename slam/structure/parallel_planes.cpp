#include "slam/structure/parallel_planes.h"

#include <algorithm>
#include <cmath>

#include "slam/pose/plane_constraints.h"

namespace slam {
namespace {

void AddDirections(const FramePlane& plane, const MapPlane& matched, const Map& map,
                   const Pose& T_cw, const ParallelConfig& config, PoseProblem& problem) {
  const std::size_t parallels = problem.parallels.size();
  const std::size_t perpendiculars = problem.perpendiculars.size();
  for (const MapPlane& other : map.planes) {
    if (other.status != LandmarkStatus::kLandmark || other.id == matched.id) continue;
    if (other.observations < config.min_observations) continue;
    if (!(other.area_m2 > config.min_area_m2)) continue;
    // Standard deviation of the angle: frame plane, map plane and pose.
    double map_variance = 0.0;
    if (!other.estimate.empty())
      map_variance = PlaneEstimate::WorstSlopeVariance(other.estimate.Covariance());
    const double sigma =
        std::hypot(plane.AngleSigma_rad(), std::sqrt(map_variance), config.pose_sigma_rad);
    // Close to the hypothesis, and consistent with it.
    const double angle = Angle(plane.pi_c.n, T_cw.R * other.pi_w.n);
    const double from_parallel = std::min(angle, M_PI - angle);
    const double from_right = std::abs(angle - 0.5 * M_PI);
    const double max_error = std::min(config.max_angle_rad, config.max_sigmas * sigma);
    const double factor_sigma = std::hypot(config.sigma_rad, sigma);
    if (from_parallel < max_error)
      problem.parallels.push_back({other.pi_w.n, plane.pi_c.n, factor_sigma});
    if (from_right < max_error)
      problem.perpendiculars.push_back({other.pi_w.n, plane.pi_c.n, factor_sigma});
  }
  // All of them share the error of the one normal that the frame measured: together they weigh as one.
  const auto share = [](auto& factors, std::size_t first) {
    const double widened = std::sqrt(static_cast<double>(factors.size() - first));
    for (std::size_t i = first; i < factors.size(); ++i) factors[i].sigma_rad *= widened;
  };
  share(problem.parallels, parallels);
  share(problem.perpendiculars, perpendiculars);
}

}  // namespace

void AddParallelPlanes(const Frame& frame, const Map& map, const ParallelConfig& config,
                       PoseProblem& problem) {
  for (std::size_t i = 0; i < frame.planes.size(); ++i) {
    const MapPlane* matched = TrustedMatch(frame, map, i);
    if (matched == nullptr || !(frame.planes[i].area_m2 > config.min_area_m2)) continue;
    AddDirections(frame.planes[i], *matched, map, frame.T_cw, config, problem);
  }
}

}  // namespace slam
