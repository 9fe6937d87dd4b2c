#include "slam/places/place_search.h"

#include <algorithm>
#include <array>
#include <opencv2/calib3d.hpp>

#include "slam/base/index.h"
#include "slam/base/random.h"
#include "slam/pose/point_constraints.h"

namespace slam {
namespace {

constexpr int kSampleSize = 4;  // three points and one that chooses among the solutions

/// Correspondences of the frame with one keyframe's points.
struct Correspondences {
  std::vector<int> features, points;
  std::vector<PointConstraint> constraints;
  std::vector<Eigen::Vector3d> measured_c;  ///< from the frame's depth; z = 0 without
};

Correspondences Correspond(const Frame& frame, const Keyframe& keyframe, const Map& map,
                           const Camera& camera, const FeatureScale& scale,
                           const PointMatchConfig& match) {
  std::vector<bool> has_point(keyframe.features.size());
  for (std::size_t f = 0; f < has_point.size(); ++f) {
    has_point[f] = keyframe.map_points[f] != kNone;
  }
  Correspondences found;
  for (const FeaturePair& pair :
       MatchDescriptors(frame.features, keyframe.features, has_point, match)) {
    const int point = keyframe.map_points[Index(pair.second)];
    found.features.push_back(pair.first);
    found.points.push_back(point);
    const PointFeature& feature = frame.features[Index(pair.first)];
    found.constraints.push_back(ConstraintOf(feature, map.points[Index(point)].p_w, scale));
    found.measured_c.push_back(camera.Backproject(feature.u_px, feature.depth_m));
  }
  return found;
}

/// Pose from three points and a fourth that chooses among the solutions.
std::optional<Pose> SolveP3p(const std::vector<PointConstraint>& constraints,
                             const std::array<int, kSampleSize>& sample, const Camera& camera) {
  std::vector<cv::Point3d> world;
  std::vector<cv::Point2d> rays;  // on the normalised plane: the camera is the identity
  for (const int i : sample) {
    const PointConstraint& c = constraints[Index(i)];
    world.emplace_back(c.p_w.x(), c.p_w.y(), c.p_w.z());
    rays.emplace_back((c.u_px.x() - camera.cx) / camera.fx,
                      (c.u_px.y() - camera.cy) / camera.fy);
  }
  cv::Vec3d rotation, t;
  if (!cv::solvePnP(world, rays, cv::Matx33d::eye(), cv::noArray(), rotation, t, false,
                    cv::SOLVEPNP_AP3P)) {
    return std::nullopt;
  }
  const Pose T_cw{ExpSo3({rotation[0], rotation[1], rotation[2]}), {t[0], t[1], t[2]}};
  if (!T_cw.R.allFinite() || !T_cw.t.allFinite()) return std::nullopt;
  return T_cw;
}

/// Whether the points of a sample are as far from each other by the frame's depth as in the
/// map: most samples with a wrong match are not, which costs less to see than a pose. Pairs
/// without depth say nothing.
bool SameShape(const std::vector<PointConstraint>& constraints,
               const std::vector<Eigen::Vector3d>& measured_c,
               const std::array<int, kSampleSize>& sample, double tolerance) {
  for (std::size_t i = 0; i < sample.size(); ++i) {
    for (std::size_t j = i + 1; j < sample.size(); ++j) {
      const Eigen::Vector3d &a_c = measured_c[Index(sample[i])],
                            &b_c = measured_c[Index(sample[j])];
      if (!(a_c.z() > 0 && b_c.z() > 0)) continue;
      const double in_map =
          (constraints[Index(sample[i])].p_w - constraints[Index(sample[j])].p_w).norm();
      const double off = std::abs((a_c - b_c).norm() - in_map);
      if (off > tolerance * std::max(a_c.z(), b_c.z())) return false;
    }
  }
  return true;
}

/// Positions of the constraints whose reprojection error is at most error_px at octave 0.
std::vector<int> Inliers(const std::vector<PointConstraint>& constraints, const Pose& T_cw,
                         const Camera& camera, double error_px) {
  std::vector<int> inliers;
  for (std::size_t i = 0; i < constraints.size(); ++i) {
    const PointConstraint& c = constraints[i];
    const Eigen::Vector3d p_c = T_cw * c.p_w;
    if (!(p_c.z() > 0)) continue;
    const double error2 = ((camera.Project(p_c) - c.u_px) / c.sigma_px).squaredNorm();
    if (error2 <= error_px * error_px) inliers.push_back(static_cast<int>(i));
  }
  return inliers;
}

/// Four different numbers below count.
std::array<int, kSampleSize> Sample(int count, Random& random) {
  std::array<int, kSampleSize> sample{};
  for (std::size_t i = 0; i < sample.size(); ++i) {
    do {
      sample[i] = random.Below(count);
    } while (std::find(sample.begin(), sample.begin() + static_cast<long>(i), sample[i]) !=
             sample.begin() + static_cast<long>(i));
  }
  return sample;
}

// Solved samples after which a pose with half of all matches is taken: four such matches
// are drawn once in 16 samples.
constexpr int kMinSolved = 50;

/// What RANSAC found: a pose, and the correspondences that agree with it.
struct Agreement {
  Pose T_cw;
  std::vector<int> inliers;
};

/// The pose with the most inliers, of those with enough.
std::optional<Agreement> Ransac(const std::vector<PointConstraint>& constraints,
                                const std::vector<Eigen::Vector3d>& measured_c,
                                const Camera& camera, Random random,
                                const PlaceSearchConfig& config) {
  std::optional<Agreement> best;
  std::size_t most = Index(config.min_ransac_inliers - 1);
  const int count = static_cast<int>(constraints.size());
  int solved = 0;
  for (int i = 0; i < config.ransac_samples && solved < config.ransac_iterations; ++i) {
    if (2 * most > constraints.size() && solved >= kMinSolved) break;
    const std::array<int, kSampleSize> sample = Sample(count, random);
    if (!SameShape(constraints, measured_c, sample, config.shape_tolerance)) continue;
    ++solved;
    const auto T_cw = SolveP3p(constraints, sample, camera);
    if (!T_cw) continue;
    std::vector<int> inliers = Inliers(constraints, *T_cw, camera, config.ransac_error_px);
    if (inliers.size() <= most) continue;
    most = inliers.size();
    best = {*T_cw, std::move(inliers)};
  }
  return best;
}

}  // namespace

bool SamePose(const Pose& a_cw, const Pose& b_cw, const PlaceSearchConfig& config) {
  return (a_cw * Inverse(b_cw)).t.norm() < config.same_pose_m &&
         RotationAngle(a_cw, b_cw) < config.same_pose_rad;
}

std::optional<PlacePose> FindPose(const Keyframe& keyframe, const Frame& frame, const Map& map,
                                  const Camera& camera, const FeatureScale& scale,
                                  const PointSearchConfig& search) {
  const PlaceSearchConfig& config = search.place;
  const Correspondences found = Correspond(frame, keyframe, map, camera, scale, config.match);
  if (found.features.size() < Index(std::max(config.min_matches, kSampleSize)))
    return std::nullopt;
  const Random random{static_cast<std::uint64_t>(frame.index),
                      static_cast<std::uint64_t>(keyframe.id)};
  const auto agreed = Ransac(found.constraints, found.measured_c, camera, random, config);
  if (!agreed) return std::nullopt;

  // Refine by the inliers alone: wrong matches would pull the pose away.
  PoseProblem problem;
  problem.T_cw = agreed->T_cw;
  for (const int i : agreed->inliers) problem.points.push_back(found.constraints[Index(i)]);
  const PoseSummary summary = OptimisePose(problem, camera, search.pose);
  if (!summary.usable || summary.inlier_count < config.min_ransac_inliers) return std::nullopt;
  PlacePose out{summary.T_cw, std::vector<int>(frame.features.size(), kNone),
                summary.inlier_count};
  for (std::size_t i = 0; i < agreed->inliers.size(); ++i) {
    if (!summary.point_inliers[i]) continue;
    const std::size_t match = Index(agreed->inliers[i]);
    out.map_points[Index(found.features[match])] = found.points[match];
  }
  return out;
}

}  // namespace slam
