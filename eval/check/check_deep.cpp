#include "eval/check/check_deep.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "eval/check/check_deep_depth.h"

namespace eval {
namespace {

using Eigen::Vector3d;

constexpr double kOutside_px = 0.2;     // rendering in single precision reaches 0.002
constexpr double kOutsideShare = 5e-4;  // of a frame's pixels; a shift by a pixel has 1e-2

/// Whether the loop goes round x, seen along right and up.
bool Encloses(const std::vector<Vector3d>& loop, const Vector3d& x, const Vector3d& right,
              const Vector3d& up) {
  bool inside = false;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Vector3d a = loop[i] - x, b = loop[(i + 1) % loop.size()] - x;
    const double ya = up.dot(a), yb = up.dot(b);
    if ((ya > 0) == (yb > 0)) continue;
    if (right.dot(a) + ya / (ya - yb) * right.dot(b - a) > 0) inside = !inside;
  }
  return inside;
}

double DistanceToLoop(const std::vector<Vector3d>& loop, const Vector3d& x) {
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Vector3d& a = loop[i];
    const Vector3d along = loop[(i + 1) % loop.size()] - a;
    const double part = std::clamp(along.dot(x - a) / along.squaredNorm(), 0.0, 1.0);
    nearest = std::min(nearest, (x - a - part * along).norm());
  }
  return nearest;
}

class IdCheck {
 public:
  IdCheck(FolderCheck& check, const DeepFrames& frames)
      : check_(check), frames_(frames), truth_(frames.truth()) {}

  void Run() {
    for (const DeepFrame& frame : frames_.frames()) CheckFrame(frame);
  }

 private:
  /// How far outside its face the pixel's ray meets the plane, in pixels; 0 inside.
  double Outside(const DeepFrame& frame, int u, int v, const CheckedScene::Plane& plane) const {
    const Eigen::Isometry3d& T_wc = frames_.Pose(frame);
    const Vector3d ray_w = T_wc.linear() * frames_.Ray(u, v);
    const double towards = plane.normal.dot(ray_w);
    const double z = -(plane.normal.dot(T_wc.translation()) + plane.d) / towards;
    if (!(towards < 0) || !(z > 0)) return 1e6;
    const Vector3d x_w = T_wc.translation() + z * ray_w;
    const double cosine = std::abs(towards) / ray_w.norm();
    // The longest a pixel gets on the plane.
    const double pixel_m = z * ray_w.norm() / std::min(truth_.camera->fx, truth_.camera->fy) /
                           std::max(cosine, 1e-3);
    // Inside the outline and outside the holes: an odd number of loops goes round the point.
    const Vector3d right = plane.normal.unitOrthogonal(), up = plane.normal.cross(right);
    bool inside = Encloses(plane.corners, x_w, right, up);
    for (const auto& hole : plane.holes) inside ^= Encloses(hole, x_w, right, up);
    if (inside) return 0;
    double nearest_m = DistanceToLoop(plane.corners, x_w);
    for (const auto& hole : plane.holes) {
      nearest_m = std::min(nearest_m, DistanceToLoop(hole, x_w));
    }
    return nearest_m / pixel_m;
  }

  /// Share of pixels with a plane that lie outside its face when ids are read `shift` away.
  double ShareOutside(const DeepFrame& frame, cv::Point shift, int stride) const {
    long outside = 0, all = 0;
    const cv::Rect image({0, 0}, frame.ids.size());
    for (int v = 0; v < frame.ids.rows; v += stride) {
      for (int u = 0; u < frame.ids.cols; ++u) {
        const cv::Point from = cv::Point(u, v) + shift;
        if (!image.contains(from)) continue;
        const auto plane = truth_.scene->planes.find(frame.ids.at<unsigned short>(from));
        if (plane == truth_.scene->planes.end() || plane->second.corners.empty()) continue;
        ++all;
        if (Outside(frame, u, v, plane->second) > kOutside_px) ++outside;
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
    check_.Add(
        frame.plane_file, 0,
        fmt::format("{:.2f} % of its pixels lie outside the face they name", 100 * share),
        mend);
  }

  FolderCheck& check_;
  const DeepFrames& frames_;
  const SequenceTruth& truth_;
};

}  // namespace

void CheckDeep(FolderCheck& check, const SequenceTruth& truth) {
  if (!truth.camera || truth.poses.empty() || truth.rgb.empty()) return;
  if (!check.Has("gt/plane_id")) return;
  const DeepFrames frames(check, truth);
  if (truth.scene) {
    IdCheck(check, frames).Run();
    CheckDepthTime(check, frames);
  }
  CheckWarp(check, frames);
}

}  // namespace eval
