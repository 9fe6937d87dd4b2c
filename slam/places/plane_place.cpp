#include "slam/places/plane_place.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "slam/associate/plane_overlap.h"
#include "slam/geometry/pixel_projection.h"
#include "slam/pose/plane_constraints.h"

namespace slam {
namespace {

/// How well frame and map fit at a pose.
struct Fit {
  UncertainPose pose;
  Matrix6d before = Matrix6d::Zero();  ///< see PlanePlace
  int planes = 0;                      ///< of the frame, that show landmarks
  double explained = 0.0;              ///< share of the frame's planes that do, by weight
  double met = 0.0;  ///< share of the landmarks in view that are where depth was measured

  double Score() const { return explained * met; }
};

/// Moves the pose to where frame planes and the landmarks nearest to them fit best.
bool Refine(const Frame& frame, const std::vector<KnownPlane>& known, const Camera& camera,
            const PlanePlaceConfig& config, const PoseProblemConfig& settings,
            UncertainPose& pose) {
  constexpr int kRounds = 3;
  PoseProblem problem;
  problem.prior = pose;
  for (int round = 0; round < kRounds; ++round) {
    problem.T_cw = pose.T_cw;
    problem.planes.clear();
    for (const FramePlane& plane : frame.planes) {
      if (plane.bad) continue;
      const KnownPlane* shown = NearestLike(plane, known, pose.T_cw, config);
      if (!shown) continue;
      problem.planes.push_back(MakePlaneConstraint(
          plane, *shown->landmark, pose.T_cw,
          std::hypot(plane.offset_sigma_m, plane.bend_offset_sigma_m, config.max_offset_m / 4),
          std::hypot(plane.angle_sigma_rad, plane.bend_angle_sigma_rad,
                     config.max_angle_rad / 4)));
    }
    const PoseSummary summary = OptimisePose(problem, camera, settings);
    if (!summary.usable) return false;
    pose = {summary.T_cw, summary.covariance};
  }
  return true;
}

/// The share of a landmark's cloud, of what nothing nearer hides, at which depth was measured.
struct Seen {
  int expected = 0, met = 0;
};

Seen SeenOf(const MapPlane& landmark, const Frame& frame, const Pose& T_cw,
            const Camera& camera, double max_offset_m) {
  Seen seen;
  const Plane pi_c = Transform(T_cw, landmark.pi_w);
  if (!(pi_c.d > 0)) return seen;  // from behind
  for (const Eigen::Vector3d& p_w : landmark.points_w) {
    const Eigen::Vector3d x_c = T_cw * p_w;
    const Eigen::Vector2i u = RecordedPixel(camera, x_c);
    if (u.x() < 0) continue;
    const double depth_m = frame.depth_m(u.y(), u.x());
    if (!(depth_m > 0)) continue;
    const double off_m = SignedDistance(pi_c, x_c * (depth_m / x_c.z()));
    if (off_m > max_offset_m) continue;  // hidden
    ++seen.expected;
    seen.met += off_m > -max_offset_m;
  }
  return seen;
}

Fit FitAt(const UncertainPose& pose, const Frame& frame, const std::vector<KnownPlane>& known,
          const Camera& camera, const PlanePlaceConfig& config) {
  constexpr int kMinExpected = 10;  // points of a landmark that is in view
  // Of a frame plane that landmarks cover: the map may not know the rest, which is no reason
  // against a place.
  constexpr double kMinShare = 0.3;
  Fit fit;
  fit.pose = pose;
  std::vector<double> shown(frame.planes.size());
  double expected = 0.0, met = 0.0;
  for (const KnownPlane& plane_w : known) {
    const MapPlane& landmark = *plane_w.landmark;
    // Where it should be, depth is that of the landmark ...
    const Seen seen = SeenOf(landmark, frame, pose.T_cw, camera, 2 * config.max_offset_m);
    if (seen.expected >= kMinExpected) {
      const double weight = std::sqrt(seen.expected);
      expected += weight;
      met += weight * seen.met / seen.expected;
    }
    // ... and frame planes that lie as it does are covered by it.
    const PlaneView view = ViewMapPlane(landmark, frame, pose.T_cw, camera);
    for (const FramePlane& plane : frame.planes) {
      const std::size_t at = Index(plane.index);
      if (plane.bad || view.landed[at] == 0 || !ClassesAllow(plane, plane_w)) continue;
      const double max_m = config.max_offset_m + 3 * plane.OffsetSigma_m();
      const Plane pi_c = Transform(pose.T_cw, landmark.pi_w);
      if (Angle(pi_c.n, plane.pi_c.n) > config.max_angle_rad ||
          std::abs(SignedDistance(pi_c, plane.centroid_c)) > max_m) {
        continue;
      }
      shown[at] += Covered(view, plane);
    }
  }
  double all = 0.0;
  for (const FramePlane& plane : frame.planes) {
    if (plane.bad) continue;
    all += Weight(plane);
    if (shown[Index(plane.index)] < kMinShare) continue;
    fit.explained += Weight(plane);
    ++fit.planes;
  }
  fit.explained = all > 0 ? fit.explained / all : 0.0;
  fit.met = expected > 0 ? met / expected : 0.0;
  return fit;
}

bool Good(const Fit& fit, const PlanePlaceConfig& config) {
  return fit.planes >= config.min_planes && fit.explained >= config.min_explained &&
         fit.met >= config.min_met;
}

}  // namespace

PlanePlace FindPlaceByPlanes(const Frame& frame, const Map& map, const Camera& camera,
                             const PlanePlaceConfig& config, const PointSearchConfig& search) {
  PlanePlace out;
  const auto trusted = std::count_if(frame.planes.begin(), frame.planes.end(),
                                     [](const FramePlane& plane) { return !plane.bad; });
  if (trusted < config.min_planes) return out;
  std::vector<Fit> fits;
  const std::vector<KnownPlane> known = KnownPlanes(map);
  for (const UncertainPose& guess : GuessPlaces(frame, known, config)) {
    UncertainPose pose = guess;
    if (!Refine(frame, known, camera, config, search.pose, pose)) continue;
    fits.push_back(FitAt(pose, frame, known, camera, config));
    fits.back().before = guess.covariance;
  }
  const auto best = std::max_element(fits.begin(), fits.end(), [](const Fit& a, const Fit& b) {
    return a.Score() < b.Score();
  });
  if (best == fits.end() || !Good(*best, config)) return out;
  out.ambiguous = std::any_of(fits.begin(), fits.end(), [&](const Fit& other) {
    return other.Score() >= config.max_second_best_ratio * best->Score() &&
           !SamePose(other.pose.T_cw, best->pose.T_cw, search.place);
  });
  if (out.ambiguous) return out;
  out.pose = best->pose;
  out.before = best->before;
  return out;
}

}  // namespace slam
