#include "app/bench/bench_planes_score.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "eval/planes/step_scores.h"
#include "eval/planes/truth_of_planes.h"

namespace app {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;
constexpr double kLevelNormalZ = 0.95;        // looks up, 18 degrees
constexpr double kThinStep_m = 0.010 - 1e-6;  // the scene's numbers are rounded
constexpr double kThinDistance_m = 1.2;
constexpr std::array<int, 10> kStepBins_mm = {0, 3, 4, 5, 6, 8, 10, 15, 25, 50};

int BinOf(double step_m) {
  const auto above =
      std::upper_bound(kStepBins_mm.begin(), kStepBins_mm.end(), 1e3 * step_m + 1e-3);
  return *(above - 1);
}

/// One frame with what is found in it and what is there.
struct ScoredFrame {
  const slam::Frame& found;
  const eval::TrueFrame& truth;
  eval::LabelPairs pairs;       ///< ids of true planes with found.plane_labels
  std::map<int, int> truth_of;  ///< by index of the frame plane
};

bool Ignored(const ScoredFrame& f, int truth_id) {
  const eval::SeenPlane* seen = f.truth.Find(truth_id);
  return seen != nullptr && !seen->counted;
}

/// Labels of both without what is ignored: true planes too small or too slanted to be asked
/// for, and what was found on them.
eval::Overlap OverlapOf(const ScoredFrame& f) {
  std::map<int, int> region_of;
  for (const slam::FramePlane& plane : f.found.planes) {
    const auto truth = f.truth_of.find(plane.index);
    if (truth == f.truth_of.end() || Ignored(f, truth->second) || plane.bad) continue;
    region_of[plane.index + 1] = plane.index + 1;
  }
  return eval::OverlapOf(eval::CountedPairs(f.truth, f.pairs, region_of));
}

/// A found region holds 80 % of the true one, and the true one 80 % of it.
bool Separated(const eval::Overlap& overlap, int truth_id) {
  const auto row = overlap.shared.find(truth_id);
  if (row == overlap.shared.end()) return false;
  return std::any_of(row->second.begin(), row->second.end(), [&](const auto& entry) {
    return eval::IsCorrect(overlap, truth_id, entry.first);
  });
}

void AddRegions(const ScoredFrame& f, const eval::SceneTruth& scene, PlaneBench& bench) {
  const eval::Overlap overlap = OverlapOf(f);
  bench.hoover += eval::ScoreHoover(overlap);
  bench.panoptic += eval::CountPanoptic(overlap);
  for (const eval::SeenPlane& seen : f.truth.planes) {
    const bool top =
        seen.object->role == eval::Role::kRegular && seen.plane->pi_g.n.z() > kLevelNormalZ;
    if (!seen.counted || !top) continue;
    const double step_m = eval::StepOf(*seen.plane, scene);
    Eigen::Vector3d middle_c = Eigen::Vector3d::Zero();
    for (const Eigen::Vector3d& corner_c : seen.corners_c) middle_c += corner_c;
    const double distance_m = (middle_c / static_cast<double>(seen.corners_c.size())).norm();
    const bool separated = Separated(overlap, seen.plane->id);
    bench.steps[{BinOf(step_m), static_cast<int>(5.0 * distance_m) * 2}].Add(separated);
    if (step_m >= kThinStep_m && distance_m <= kThinDistance_m) bench.thin_tops.Add(separated);
  }
}

void AddParameters(const ScoredFrame& f, PlaneBench& bench) {
  for (const slam::FramePlane& plane : f.found.planes) {
    const auto truth = f.truth_of.find(plane.index);
    if (plane.bad || truth == f.truth_of.end()) continue;
    const eval::SeenPlane* seen = f.truth.Find(truth->second);
    if (seen == nullptr || !seen->counted) continue;
    const Eigen::Vector3d foot_c =
        plane.centroid_c - slam::SignedDistance(plane.pi_c, plane.centroid_c) * plane.pi_c.n;
    bench.normal_deg.push_back(kDegrees * slam::Angle(plane.pi_c.n, seen->pi_c.n));
    bench.offset_mm.push_back(1e3 * std::abs(eval::SignedDistance(seen->pi_c, foot_c)));
  }
}

void AddTopCorners(const ScoredFrame& f, PlaneBench& bench) {
  std::map<int, std::vector<Eigen::Vector3d>> claimed_c;
  for (const slam::FramePlane& plane : f.found.planes) {
    const auto truth = f.truth_of.find(plane.index);
    if (plane.bad || truth == f.truth_of.end()) continue;
    for (const slam::Vertex& vertex : plane.vertices_c) {
      if (!vertex.extrapolated) claimed_c[truth->second].push_back(vertex.p_c);
    }
  }
  bench.corners.claimed += static_cast<int>(claimed_c[0].size());
  for (const eval::SeenPlane& seen : f.truth.planes) {
    const bool top =
        seen.object->role == eval::Role::kRegular && seen.plane->pi_g.n.z() > kLevelNormalZ;
    if (top && seen.counted) bench.corners.AddPlane(seen, claimed_c[seen.plane->id]);
  }
}

bool SeesNear(const cv::Mat1b& mask, const slam::Camera& camera, const Eigen::Vector3d& x_c) {
  const Eigen::Vector2d u = camera.Project(x_c);
  const int reach = std::max(1, static_cast<int>(std::lround(3.0 * mask.cols / 640.0)));
  const cv::Rect around(static_cast<int>(std::lround(u.x())) - reach,
                        static_cast<int>(std::lround(u.y())) - reach, 2 * reach + 1,
                        2 * reach + 1);
  const cv::Rect inside = around & cv::Rect(0, 0, mask.cols, mask.rows);
  return inside.area() > 0 && cv::countNonZero(mask(inside)) > 0;
}

}  // namespace

void LeaveOutUnmeasured(const cv::Mat1f& depth_m, const slam::Camera& camera,
                        eval::TrueFrame& truth) {
  const cv::Mat1b measured = cv::Mat(depth_m > 0.0f);
  const double least =
      eval::kMinPixels * static_cast<double>(measured.total()) / (640.0 * 480.0);
  truth.plane_ids->setTo(0, measured == 0);
  for (eval::SeenPlane& seen : truth.planes) {
    const cv::Mat1b mask = cv::Mat(*truth.plane_ids == seen.plane->id);
    seen.pixels = cv::countNonZero(mask);
    seen.counted = seen.counted && seen.pixels >= least;
    for (std::size_t k = 0; k < seen.corners_c.size(); ++k) {
      if (!seen.corner_in_view[k]) continue;
      seen.corner_in_view[k] = SeesNear(mask, camera, seen.corners_c[k]);
    }
  }
}

void ScoreFrame(const slam::Frame& found, const eval::TrueFrame& truth,
                const eval::SceneTruth& scene, PlaneBench& bench) {
  ScoredFrame f{found, truth, {}, {}};
  cv::Mat1w labels;
  found.plane_labels.convertTo(labels, CV_16U);
  f.pairs = eval::CountPairs(*truth.plane_ids, labels);
  f.truth_of = eval::TruthByPixels(truth, f.pairs);
  ++bench.scored_frames;
  AddRegions(f, scene, bench);
  AddParameters(f, bench);
  AddTopCorners(f, bench);
}

void AddLevelPlane(const slam::Frame& found, const eval::Pose& T_gc, PlaneBench& bench) {
  const slam::FramePlane* largest = nullptr;
  Eigen::Vector3d normal_w = Eigen::Vector3d::Zero();
  for (const slam::FramePlane& plane : found.planes) {
    const Eigen::Vector3d n_w = T_gc.R * plane.pi_c.n;
    if (!(n_w.z() > kLevelNormalZ)) continue;
    if (largest != nullptr && plane.pixel_count <= largest->pixel_count) continue;
    largest = &plane, normal_w = n_w;
  }
  if (largest == nullptr) return;
  bench.level_normals_w.push_back(normal_w);
  bench.level_shares.push_back(static_cast<double>(largest->pixel_count) /
                               std::max(1, cv::countNonZero(found.depth_m)));
}

}  // namespace app
