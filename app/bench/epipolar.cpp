#include "app/bench/epipolar.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <opencv2/features2d.hpp>
#include <optional>

#include "eval/formats/sequence/sequence_agreement.h"

namespace app {
namespace {

constexpr int kMaxFeatures = 1500;  // of an image
constexpr float kMaxRatio = 0.6F;   // Lowe's test, strict: a wrong match is no error of a pose

/// The pose at an image's time, or nothing.
std::optional<eval::Pose> PoseAt(const eval::Trajectory& trajectory, double stamp_s) {
  const auto later = std::lower_bound(
      trajectory.begin(), trajectory.end(), stamp_s,
      [](const eval::StampedPose& pose, double stamp) { return pose.stamp_s < stamp; });
  const auto off = [&](auto pose) { return std::abs(pose->stamp_s - stamp_s); };
  auto nearest = later;
  if (later == trajectory.end() ||
      (later != trajectory.begin() && off(std::prev(later)) < off(later))) {
    if (later == trajectory.begin()) return std::nullopt;
    nearest = std::prev(later);
  }
  if (off(nearest) > eval::kMaxStampDifference_s) return std::nullopt;
  return nearest->T_wc;
}

/// A pixel of each of two images that show one thing, distortion taken out.
struct Match {
  Eigen::Vector3d one, other;  ///< (u, v, 1)
};

struct View {
  double stamp_s = 0.0;
  std::vector<Eigen::Vector2d> pixels;  ///< without the lens
  cv::Mat descriptors;
};

View See(const slam::RecordedFrame& frame, const slam::Camera& camera, cv::SIFT& sift) {
  View view{frame.timestamp_s, {}, {}};
  std::vector<cv::KeyPoint> keypoints;
  sift.detectAndCompute(frame.gray, {}, keypoints, view.descriptors);
  for (const cv::KeyPoint& keypoint : keypoints)
    view.pixels.push_back(camera.Undistort({keypoint.pt.x, keypoint.pt.y}));
  return view;
}

std::vector<Match> MatchViews(const View& one, const View& other) {
  std::vector<Match> matches;
  if (one.descriptors.rows < 2 || other.descriptors.rows < 2) return matches;
  std::vector<std::vector<cv::DMatch>> nearest;
  cv::BFMatcher(cv::NORM_L2).knnMatch(one.descriptors, other.descriptors, nearest, 2);
  for (const std::vector<cv::DMatch>& two : nearest) {
    if (!(two[0].distance < kMaxRatio * two[1].distance)) continue;
    matches.push_back({one.pixels[static_cast<std::size_t>(two[0].queryIdx)].homogeneous(),
                       other.pixels[static_cast<std::size_t>(two[0].trainIdx)].homogeneous()});
  }
  return matches;
}

/// F with other^T F one = 0 for pixels of what stands still.
Eigen::Matrix3d Fundamental(const eval::Pose& one, const eval::Pose& other,
                            const slam::Camera& camera) {
  const eval::Pose relative = eval::Inverse(other) * one;
  Eigen::Matrix3d cross;
  cross << 0, -relative.t.z(), relative.t.y(), relative.t.z(), 0, -relative.t.x(),
      -relative.t.y(), relative.t.x(), 0;
  Eigen::Matrix3d to_ray;
  to_ray << 1 / camera.fx, 0, -camera.cx / camera.fx, 0, 1 / camera.fy, -camera.cy / camera.fy,
      0, 0, 1;
  return to_ray.transpose() * cross * relative.R * to_ray;
}

double DistanceFromLine(const Eigen::Vector3d& pixel, const Eigen::Vector3d& line) {
  return std::abs(line.dot(pixel)) / line.head<2>().norm();
}

/// Of each trajectory the pose at both times; nothing where one has none, or too short a way.
std::optional<std::vector<std::pair<eval::Pose, eval::Pose>>> PosesAt(
    const std::vector<eval::Trajectory>& trajectories, double one_s, double other_s,
    double min_baseline_m) {
  std::vector<std::pair<eval::Pose, eval::Pose>> poses;
  for (const eval::Trajectory& trajectory : trajectories) {
    const std::optional<eval::Pose> one = PoseAt(trajectory, one_s);
    const std::optional<eval::Pose> other = PoseAt(trajectory, other_s);
    if (!one || !other || (one->t - other->t).norm() < min_baseline_m) return std::nullopt;
    poses.emplace_back(*one, *other);
  }
  return poses;
}

}  // namespace

std::vector<std::vector<double>> EpipolarDistances(
    slam::FrameSource& frames, const slam::Camera& camera,
    const std::vector<eval::Trajectory>& trajectories, const EpipolarRules& rules) {
  std::vector<std::vector<double>> distances(trajectories.size());
  const cv::Ptr<cv::SIFT> sift = cv::SIFT::create(kMaxFeatures);
  std::map<int, View> views;  // that later frames are compared with, by their place
  for (int i = 0; i < frames.size(); ++i) {
    const slam::RecordedFrame frame = frames.Read(i);
    const bool begins = i % rules.every == 0, ends = views.count(i - rules.apart) > 0;
    if (!begins && !ends) continue;
    const View view = See(frame, camera, *sift);
    if (ends) {
      const View& before = views.at(i - rules.apart);
      const auto poses =
          PosesAt(trajectories, before.stamp_s, view.stamp_s, rules.min_baseline_m);
      for (const Match& match : poses ? MatchViews(before, view) : std::vector<Match>{}) {
        for (std::size_t k = 0; k < trajectories.size(); ++k) {
          const auto& [one, other] = (*poses)[k];
          distances[k].push_back(
              DistanceFromLine(match.other, Fundamental(one, other, camera) * match.one));
        }
      }
      views.erase(i - rules.apart);
    }
    if (begins) views.emplace(i, view);
  }
  return distances;
}

}  // namespace app
