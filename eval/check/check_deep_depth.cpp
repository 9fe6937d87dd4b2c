#include "eval/check/check_deep_depth.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "eval/check/check_truth_depth.h"
#include "eval/trajectory/statistics.h"
#include "eval/trajectory/true_pose.h"

namespace eval {
namespace {

using Eigen::Vector3d;

constexpr int kWarpStride_px = 3;
constexpr double kMinBaseline_m = 0.1, kMaxBaseline_m = 0.4, kMaxTurn_rad = 0.4;
constexpr std::size_t kMinWarpPixels = 200;

/// Median |depth - z| / sigma for a pose.
double Misfit(const DeepFrames& frames, const DeepFrame& frame, const Pose& T_wc) {
  std::vector<double> ratios;
  for (int v = 1; v < frame.depth_ids.rows; v += kWarpStride_px) {
    for (int u = 1; u < frame.depth_ids.cols; u += kWarpStride_px) {
      const TruthPlane* plane =
          frames.truth().scene->FindPlane(frame.depth_ids.at<unsigned short>(v, u));
      const int units = frame.depth.at<unsigned short>(v, u);
      if (units == 0 || plane == nullptr) continue;
      const Vector3d ray_w = T_wc.R * frames.Ray(u, v);
      const double z = -SignedDistance(plane->pi_g, T_wc.t) / plane->pi_g.n.dot(ray_w);
      if (!(z > 0)) continue;
      ratios.push_back(std::abs(units * frames.unit_m() - z) /
                       DepthSigma(frames.truth().sensor, z, 0, frames.unit_m()));
    }
  }
  return ratios.size() < kMinWarpPixels ? -1 : Quantile(ratios, 0.5);
}

/// 1/z of B at a place between four pixels that all show the plane; 0 when they do not.
double InverseDepthAt(const DeepFrames& frames, const DeepFrame& b, double u, double v,
                      int plane) {
  const int u0 = static_cast<int>(std::floor(u)), v0 = static_cast<int>(std::floor(v));
  if (u0 < 1 || v0 < 1 || u0 + 2 >= b.depth_ids.cols || v0 + 2 >= b.depth_ids.rows) return 0;
  double sum = 0;
  for (int k = 0; k < 4; ++k) {
    const int x = u0 + (k & 1), y = v0 + (k >> 1);
    const int units = b.depth.at<unsigned short>(y, x);
    if (b.depth_ids.at<unsigned short>(y, x) != plane || units == 0) return 0;
    const double weight =
        ((k & 1) != 0 ? u - u0 : u0 + 1 - u) * ((k >> 1) != 0 ? v - v0 : v0 + 1 - v);
    sum += weight / (units * frames.unit_m());
  }
  return sum;
}

void CompareViews(const DeepFrames& frames, const DeepFrame& a, const DeepFrame& b,
                  std::vector<double>& ratios, std::vector<double>& errors_m) {
  const Pose T_ba = Inverse(b.T_wc_depth) * a.T_wc_depth;
  for (int v = 1; v < a.depth_ids.rows; v += kWarpStride_px) {
    for (int u = 1; u < a.depth_ids.cols; u += kWarpStride_px) {
      const int id = a.depth_ids.at<unsigned short>(v, u);
      const int units = a.depth.at<unsigned short>(v, u);
      if (id == 0 || units == 0) continue;
      const Vector3d x_b = T_ba * (units * frames.unit_m() * frames.Ray(u, v));
      if (!(x_b.z() > 0.05)) continue;
      const Eigen::Vector2d pixel = frames.Pixel(x_b);
      const double inverse_z = InverseDepthAt(frames, b, pixel.x(), pixel.y(), id);
      if (!(inverse_z > 0)) continue;
      const double error = std::abs(x_b.z() - 1 / inverse_z);
      const double sa =
          DepthSigma(frames.truth().sensor, units * frames.unit_m(), 0, frames.unit_m());
      const double sb = DepthSigma(frames.truth().sensor, 1 / inverse_z, 0, frames.unit_m());
      errors_m.push_back(error);
      ratios.push_back(error / std::hypot(sa, sb));
    }
  }
}

}  // namespace

/// An id image goes with the pose; so a depth that fits a neighbour's pose is a neighbour's.
void CheckDepthTime(Folder& folder, const DeepFrames& frames) {
  int judged = 0, before = 0, after = 0;
  for (const DeepFrame& frame : frames.frames()) {
    if (frame.depth.empty() || frame.pose == 0 ||
        frame.pose + 1 >= frames.truth().poses.size()) {
      continue;
    }
    // As far in time as the poses before and after are.
    const Trajectory& poses = frames.truth().poses;
    const double late_s = frame.depth_stamp_s - poses[frame.pose].stamp_s;
    const auto T_wc_last = PoseAt(poses, poses[frame.pose - 1].stamp_s + late_s);
    const auto T_wc_next = PoseAt(poses, poses[frame.pose + 1].stamp_s + late_s);
    if (!T_wc_last || !T_wc_next) continue;
    const double own = Misfit(frames, frame, frame.T_wc_depth),
                 last = Misfit(frames, frame, *T_wc_last),
                 next = Misfit(frames, frame, *T_wc_next);
    if (!(own >= 0) || !(last >= 0) || !(next >= 0)) continue;
    ++judged;
    if (last < 0.97 * own && last <= next) ++before;
    if (next < 0.97 * own && next < last) ++after;
  }
  for (const auto& [count, which] : {std::pair{before, "before"}, {after, "after"}}) {
    if (judged < 2 || 3 * count <= 2 * judged) continue;
    folder.Tell("depth.txt", 0,
                fmt::format("in {} of {} frames the depth fits the pose of the frame {} better "
                            "than its own",
                            count, judged, which),
                "pair depth, ids and poses of one instant");
  }
}

void CheckWarp(Folder& folder, const DeepFrames& frames) {
  const std::vector<DeepFrame>& list = frames.frames();
  int judged = 0, bad = 0;
  std::vector<double> medians_m;
  for (std::size_t i = 0; i < list.size(); ++i) {
    for (std::size_t j = i + 1; j < list.size(); ++j) {
      if (list[i].depth.empty() || list[j].depth.empty()) continue;
      const Pose T_ij = Inverse(list[i].T_wc_depth) * list[j].T_wc_depth;
      const double far_m = T_ij.t.norm();
      if (far_m < kMinBaseline_m) continue;
      if (far_m > kMaxBaseline_m || AngleOf(T_ij.R) > kMaxTurn_rad) {
        break;
      }
      std::vector<double> ratios, errors_m;
      CompareViews(frames, list[i], list[j], ratios, errors_m);
      if (ratios.size() < kMinWarpPixels) continue;
      ++judged;
      medians_m.push_back(Quantile(errors_m, 0.5));
      if (!(Quantile(ratios, 0.5) <= 1)) ++bad;
      break;
    }
  }
  if (judged == 0 || 4 * bad <= judged) return;
  folder.Tell(".", 0,
              fmt::format("in {} of {} pairs of frames the depth of one, carried into the "
                          "other by the poses, is {:.1f} mm (median) off",
                          bad, judged, Quantile(medians_m, 0.5) * 1e3),
              "check the direction of the poses, planar depth, depth_factor and which images "
              "belong together");
}

}  // namespace eval
