#include "eval/check/check_deep.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "eval/check/check_deep_depth.h"

namespace eval {
namespace {

using Eigen::Vector3d;

constexpr double kOutside_px = 0.2;     // rendering in single precision reaches 0.002
constexpr double kOutsideShare = 5e-4;  // of a frame's pixels; a shift by a pixel has 1e-2

/// Distance from x to a loop in the plane of right and up; positive when the loop goes round x.
double DistanceInto(const std::vector<Vector3d>& loop, const Vector3d& x, const Vector3d& right,
                    const Vector3d& up) {
  std::vector<cv::Point2f> outline;  // about x, so that single precision is enough
  outline.reserve(loop.size());
  for (const Vector3d& corner : loop) {
    outline.emplace_back(static_cast<float>(right.dot(corner - x)),
                         static_cast<float>(up.dot(corner - x)));
  }
  return cv::pointPolygonTest(outline, {0.0f, 0.0f}, true);
}

class IdCheck {
 public:
  IdCheck(Folder& folder, const DeepFrames& frames)
      : folder_(folder), frames_(frames), truth_(frames.truth()) {}

  void Run() {
    for (const DeepFrame& frame : frames_.frames()) CheckFrame(frame);
  }

 private:
  /// How far outside its face the pixel's ray meets the plane, in pixels; 0 inside.
  double Outside(const DeepFrame& frame, int u, int v, const TruthPlane& plane) const {
    const Pose& T_wc = frames_.PoseOf(frame);
    const Vector3d ray_w = T_wc.R * frames_.Ray(u, v);
    const double towards = plane.pi_g.n.dot(ray_w);
    const double z = -SignedDistance(plane.pi_g, T_wc.t) / towards;
    if (!(towards < 0) || !(z > 0)) return 1e6;
    const Vector3d x_w = T_wc.t + z * ray_w;
    const double cosine = std::abs(towards) / ray_w.norm();
    // The longest a pixel gets on the plane.
    const double pixel_m = z * ray_w.norm() / std::min(truth_.camera->fx, truth_.camera->fy) /
                           std::max(cosine, 1e-3);
    // Inside the outline and outside the holes: an odd number of loops goes round the point.
    const Vector3d right = plane.pi_g.n.unitOrthogonal(), up = plane.pi_g.n.cross(right);
    const double into_m = DistanceInto(plane.vertices_g, x_w, right, up);
    bool inside = into_m > 0;
    double nearest_m = std::abs(into_m);
    for (const auto& hole : plane.holes_g) {
      const double into_hole_m = DistanceInto(hole, x_w, right, up);
      inside ^= into_hole_m > 0;
      nearest_m = std::min(nearest_m, std::abs(into_hole_m));
    }
    return inside ? 0 : nearest_m / pixel_m;
  }

  /// Share of pixels with a plane that lie outside its face when ids are read `shift` away.
  double ShareOutside(const DeepFrame& frame, cv::Point shift, int stride) const {
    long outside = 0, all = 0;
    const cv::Rect image({0, 0}, frame.ids.size());
    for (int v = 0; v < frame.ids.rows; v += stride) {
      for (int u = 0; u < frame.ids.cols; ++u) {
        const cv::Point from = cv::Point(u, v) + shift;
        if (!image.contains(from)) continue;
        const TruthPlane* plane = truth_.scene->FindPlane(frame.ids.at<unsigned short>(from));
        if (plane == nullptr || plane->vertices_g.empty()) continue;
        ++all;
        if (Outside(frame, u, v, *plane) > kOutside_px) ++outside;
      }
    }
    return all > 0 ? static_cast<double>(outside) / static_cast<double>(all) : 0.0;
  }

  void CheckFrame(const DeepFrame& frame) {
    const double share = ShareOutside(frame, {0, 0}, 1);
    if (!(share > kOutsideShare)) return;
    std::string mend = "render the id image with the pose and camera that are written";
    for (int dv = -2; dv <= 2; ++dv) {
      for (int du = -2; du <= 2; ++du) {
        if (ShareOutside(frame, {du, dv}, 2) > kOutsideShare) continue;
        mend = fmt::format(
            "the image is shifted by ({}, {}) px; write ids of the centre "
            "rays of the pixels themselves",
            du, dv);
        du = dv = 3;
      }
    }
    folder_.Tell(
        frame.plane_file, 0,
        fmt::format("{:.2f} % of its pixels lie outside the face they name", 100 * share),
        mend);
  }

  Folder& folder_;
  const DeepFrames& frames_;
  const SequenceTruth& truth_;
};

}  // namespace

void CheckDeep(Folder& folder, const SequenceTruth& truth) {
  if (!truth.camera || truth.poses.empty() || truth.rgb.empty()) return;
  if (!folder.Has("gt/plane_id")) return;
  const DeepFrames frames(folder, truth);
  if (truth.scene) {
    IdCheck(folder, frames).Run();
    CheckDepthTime(folder, frames);
  }
  CheckWarp(folder, frames);
}

}  // namespace eval
