#include "eval/check/check_deep.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgcodecs.hpp>

#include "eval/check/check_truth_depth.h"
#include "eval/check/checked_text.h"

namespace eval {
namespace {

using Eigen::Vector3d;

constexpr std::size_t kFrames = 24;
constexpr int kStride_px = 3;
constexpr double kOutside_px = 0.2;     // rendering in single precision reaches 0.002
constexpr double kOutsideShare = 5e-4;  // of a frame's pixels; a shift by a pixel has 1e-2
constexpr double kBaseline_m = 0.1, kLargestBaseline_m = 0.4, kLargestTurn_rad = 0.4;
constexpr std::size_t kMinPixels = 200;
constexpr double kMaxTilt_rad = 1.3;

struct DeepFrame {
  std::string name, plane_file;
  double stamp_s = 0;
  std::size_t pose = 0;  // index into truth.poses
  cv::Mat ids, depth;    // depth may be empty
};

double Median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

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

class DeepCheck {
 public:
  DeepCheck(FolderCheck& check, const SequenceTruth& truth)
      : check_(check), truth_(truth), unit_m_(1 / truth.camera->depth_factor) {
    std::vector<cv::Point2d> pixels;
    for (int v = 0; v < truth.camera->height; ++v) {
      for (int u = 0; u < truth.camera->width; ++u) pixels.emplace_back(u, v);
    }
    rays_ = RaysOf(*truth.camera, pixels);
    Load();
  }

  void Run() {
    if (truth_.scene) CheckIds();
    if (truth_.scene) CheckTime();
    CheckWarp();
  }

 private:
  const Eigen::Isometry3d& Pose(const DeepFrame& frame) const {
    return truth_.poses[frame.pose].T_wc;
  }
  const Vector3d& Ray(int u, int v) const {
    return rays_[static_cast<std::size_t>(v) * static_cast<std::size_t>(truth_.camera->width) +
                 static_cast<std::size_t>(u)];
  }

  void Load() {
    std::vector<double> stamps;
    for (const CheckedPose& pose : truth_.poses) stamps.push_back(pose.stamp_s);
    const std::size_t count = truth_.rgb.size();
    const std::size_t step = std::max<std::size_t>(1, (count + kFrames - 1) / kFrames);
    for (std::size_t i = 0; i < count; i += step) {
      const ListedImage& image = truth_.rgb[i];
      const auto pose = NearestStamp(stamps, image.stamp_s, kSameInstant_s);
      DeepFrame frame;
      frame.name = std::filesystem::path(image.file).filename().string();
      frame.plane_file = "gt/plane_id/" + frame.name;
      frame.stamp_s = image.stamp_s;
      if (!pose || !check_.Has(frame.plane_file)) continue;
      frame.pose = *pose;
      frame.ids = Read(frame.plane_file);
      const auto pair =
          std::find_if(truth_.pairs.begin(), truth_.pairs.end(),
                       [&](const ListedPair& p) { return p.rgb.stamp_s == image.stamp_s; });
      if (pair != truth_.pairs.end()) frame.depth = Read(pair->depth.file);
      if (!frame.ids.empty()) frames_.push_back(std::move(frame));
    }
  }

  cv::Mat Read(const std::string& file) const {
    const cv::Mat image = cv::imread((check_.root / file).string(), cv::IMREAD_UNCHANGED);
    const cv::Size size(truth_.camera->width, truth_.camera->height);
    return image.type() == CV_16UC1 && image.size() == size ? image : cv::Mat();
  }

  /// How far outside its face the pixel's ray meets the plane, in pixels; 0 inside.
  double Outside(const DeepFrame& frame, int u, int v, const CheckedScene::Plane& plane) const {
    const Eigen::Isometry3d& T_wc = Pose(frame);
    const Vector3d ray_w = T_wc.linear() * Ray(u, v);
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

  void CheckIds() {
    for (const DeepFrame& frame : frames_) {
      const double share = ShareOutside(frame, {0, 0}, 1);
      if (!(share > kOutsideShare)) continue;
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
  }

  /// Median |depth - z| / sigma for the pose of index `pose`.
  double Misfit(const DeepFrame& frame, std::size_t pose) const {
    const Eigen::Isometry3d& T_wc = truth_.poses[pose].T_wc;
    std::vector<double> ratios;
    for (int v = 1; v < frame.ids.rows; v += kStride_px) {
      for (int u = 1; u < frame.ids.cols; u += kStride_px) {
        const auto plane = truth_.scene->planes.find(frame.ids.at<unsigned short>(v, u));
        const int units = frame.depth.at<unsigned short>(v, u);
        if (units == 0 || plane == truth_.scene->planes.end()) continue;
        const Vector3d ray_w = T_wc.linear() * Ray(u, v);
        const double z = -(plane->second.normal.dot(T_wc.translation()) + plane->second.d) /
                         plane->second.normal.dot(ray_w);
        if (!(z > 0)) continue;
        ratios.push_back(std::abs(units * unit_m_ - z) /
                         DepthSigma(truth_.sensor, z, 0, unit_m_));
      }
    }
    return ratios.size() < kMinPixels ? -1 : Median(ratios);
  }

  /// An id image goes with the pose; so a depth that fits a neighbour's pose is a neighbour's.
  void CheckTime() {
    int judged = 0, before = 0, after = 0;
    for (const DeepFrame& frame : frames_) {
      if (frame.depth.empty() || frame.pose == 0 || frame.pose + 1 >= truth_.poses.size()) {
        continue;
      }
      const double own = Misfit(frame, frame.pose), last = Misfit(frame, frame.pose - 1),
                   next = Misfit(frame, frame.pose + 1);
      if (!(own >= 0) || !(last >= 0) || !(next >= 0)) continue;
      ++judged;
      if (last < 0.97 * own && last <= next) ++before;
      if (next < 0.97 * own && next < last) ++after;
    }
    for (const auto& [count, which] : {std::pair{before, "before"}, {after, "after"}}) {
      if (judged < 2 || 3 * count <= 2 * judged) continue;
      check_.Add(
          "depth.txt", 0,
          fmt::format("in {} of {} frames the depth fits the pose of the frame {} better "
                      "than its own",
                      count, judged, which),
          "pair depth, ids and poses of one instant");
    }
  }

  /// 1/z of B at a place between four pixels that all show the plane; 0 when they do not.
  double InverseDepthAt(const DeepFrame& b, double u, double v, int plane) const {
    const int u0 = static_cast<int>(std::floor(u)), v0 = static_cast<int>(std::floor(v));
    if (u0 < 1 || v0 < 1 || u0 + 2 >= b.ids.cols || v0 + 2 >= b.ids.rows) return 0;
    double sum = 0;
    for (int k = 0; k < 4; ++k) {
      const int x = u0 + (k & 1), y = v0 + (k >> 1);
      const int units = b.depth.at<unsigned short>(y, x);
      if (b.ids.at<unsigned short>(y, x) != plane || units == 0) return 0;
      const double weight =
          ((k & 1) != 0 ? u - u0 : u0 + 1 - u) * ((k >> 1) != 0 ? v - v0 : v0 + 1 - v);
      sum += weight / (units * unit_m_);
    }
    return sum;
  }

  void Compare(const DeepFrame& a, const DeepFrame& b, std::vector<double>& ratios,
               std::vector<double>& errors_m) const {
    const Eigen::Isometry3d T_ba = Pose(b).inverse() * Pose(a);
    const CheckedCamera& camera = *truth_.camera;
    for (int v = 1; v < a.ids.rows; v += kStride_px) {
      for (int u = 1; u < a.ids.cols; u += kStride_px) {
        const int id = a.ids.at<unsigned short>(v, u);
        const int units = a.depth.at<unsigned short>(v, u);
        if (id == 0 || units == 0) continue;
        const Vector3d x_b = T_ba * (units * unit_m_ * Ray(u, v));
        if (!(x_b.z() > 0.05)) continue;
        const double inverse_z = InverseDepthAt(b, camera.fx * x_b.x() / x_b.z() + camera.cx,
                                                camera.fy * x_b.y() / x_b.z() + camera.cy, id);
        if (!(inverse_z > 0)) continue;
        const double error = std::abs(x_b.z() - 1 / inverse_z);
        const double sa = DepthSigma(truth_.sensor, units * unit_m_, 0, unit_m_);
        const double sb = DepthSigma(truth_.sensor, 1 / inverse_z, 0, unit_m_);
        errors_m.push_back(error);
        ratios.push_back(error / std::hypot(sa, sb));
      }
    }
  }

  void CheckWarp() {
    int judged = 0, bad = 0;
    std::vector<double> medians_m;
    // Lenses bend the straight projection used here.
    const auto& k = truth_.camera->distortion;
    if (std::any_of(k.begin(), k.end(), [](double x) { return x != 0; })) return;
    for (std::size_t i = 0; i < frames_.size(); ++i) {
      for (std::size_t j = i + 1; j < frames_.size(); ++j) {
        if (frames_[i].depth.empty() || frames_[j].depth.empty()) continue;
        const Eigen::Isometry3d T = Pose(frames_[i]).inverse() * Pose(frames_[j]);
        const double far_m = T.translation().norm();
        if (far_m < kBaseline_m) continue;
        if (far_m > kLargestBaseline_m ||
            Eigen::AngleAxisd(T.linear()).angle() > kLargestTurn_rad) {
          break;
        }
        std::vector<double> ratios, errors_m;
        Compare(frames_[i], frames_[j], ratios, errors_m);
        if (ratios.size() < kMinPixels) continue;
        ++judged;
        medians_m.push_back(Median(errors_m));
        if (!(Median(ratios) <= 1)) ++bad;
        break;
      }
    }
    if (judged == 0 || 4 * bad <= judged) return;
    check_.Add(".", 0,
               fmt::format("in {} of {} pairs of frames the depth of one, carried into the "
                           "other by the poses, is {:.1f} mm (median) off",
                           bad, judged, Median(medians_m) * 1e3),
               "check the direction of the poses, planar depth, depth_factor and which images "
               "belong together");
  }

  FolderCheck& check_;
  const SequenceTruth& truth_;
  double unit_m_;
  std::vector<Vector3d> rays_;
  std::vector<DeepFrame> frames_;
};

}  // namespace

void CheckDeep(FolderCheck& check, const SequenceTruth& truth) {
  if (!truth.camera || truth.poses.empty() || truth.rgb.empty()) return;
  if (!check.Has("gt/plane_id")) return;
  DeepCheck(check, truth).Run();
}

}  // namespace eval
