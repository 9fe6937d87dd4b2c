#include "eval/check/check_truth_depth.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "eval/formats/sequence/images.h"
#include "eval/formats/stamps.h"
#include "eval/trajectory/statistics.h"
#include "eval/trajectory/true_pose.h"

namespace eval {

using Eigen::Vector3d;

std::vector<Vector3d> RaysOf(const Camera& camera, const std::vector<cv::Point2d>& pixels) {
  const cv::Matx33d K(camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1);
  const auto& k = camera.distortion;
  std::vector<cv::Point2d> points;
  if (!pixels.empty()) {
    // Five iterations, as by default, are too few for the corners of a lens that bends much.
    const cv::TermCriteria until(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 200, 1e-6);
    cv::undistortPoints(pixels, points, K, cv::Vec<double, 5>(k[0], k[1], k[2], k[3], k[4]),
                        cv::noArray(), cv::noArray(), until);
  }
  std::vector<Vector3d> rays;
  rays.reserve(points.size());
  for (const cv::Point2d& p : points) rays.emplace_back(p.x, p.y, 1);
  return rays;
}

namespace {

constexpr double kMaxTilt_rad = 1.4;       // beyond, sensors measure nothing to rely on
constexpr double kBend = 0.0033;           // of depth; docs/sensors.md
constexpr double kMisplaced_rad = 0.0035;  // 1.9 px of 525: registration and intrinsics
constexpr double kRimShare = 12.0 / 640;  // of the width: a turn of 70 deg/s in 20 ms, and 2 px

}  // namespace

double DepthSigma(const std::string& sensor, double z, double tilt_rad, double unit_m) {
  if (sensor == "ideal") return unit_m;
  const bool as_recorded = sensor == "kinect1";
  if (!as_recorded && sensor != "kinect1-clean") return 0.002 + 0.01 * z + unit_m;
  const double axial = 0.0012 + 0.0019 * (z - 0.4) * (z - 0.4);
  const double tilted = tilt_rad > M_PI / 3 ? 0.0001 / std::sqrt(z) *
                                                  std::pow(tilt_rad / (M_PI / 2 - tilt_rad), 2)
                                            : 0.0;
  const double noise = axial + tilted + unit_m;
  if (!as_recorded) return noise;
  const double beside = kMisplaced_rad * z * std::tan(std::min(tilt_rad, kMaxTilt_rad));
  return std::hypot(noise, kBend * z, beside);
}

cv::Mat InnerIds(const cv::Mat& ids) {
  const int side = 2 * static_cast<int>(std::ceil(kRimShare * ids.cols)) + 1;
  const cv::Mat window = cv::Mat::ones(side, side, CV_8U);
  cv::Mat lowest, highest, inner = ids.clone();
  cv::erode(ids, lowest, window);
  cv::dilate(ids, highest, window);
  inner.setTo(0, lowest != highest);
  return inner;
}

namespace {

constexpr int kDepthStride_px = 4;            // every sixteenth pixel: 19,200 of a VGA image
constexpr std::size_t kMinDepthPixels = 100;  // fewer say nothing about a median

/// A measured depth with the plane and the ray it belongs to.
struct Sample {
  double depth_m;
  Vector3d ray_c;  ///< z = 1
  const TruthPlane* plane;
};

std::vector<Sample> Samples(const cv::Mat& depth, const cv::Mat& ids, const SceneTruth& scene,
                            const Camera& camera) {
  std::vector<Sample> samples;
  std::vector<cv::Point2d> pixels;
  for (int y = kDepthStride_px / 2; y < ids.rows; y += kDepthStride_px) {
    for (int x = kDepthStride_px / 2; x < ids.cols; x += kDepthStride_px) {
      const TruthPlane* plane = scene.FindPlane(ids.at<unsigned short>(y, x));
      const int units = depth.at<unsigned short>(y, x);
      if (units == 0 || plane == nullptr) continue;
      samples.push_back({units / camera.depth_factor, Vector3d::UnitZ(), plane});
      pixels.emplace_back(x, y);
    }
  }
  const std::vector<Vector3d> rays = RaysOf(camera, pixels);
  for (std::size_t i = 0; i < samples.size(); ++i) samples[i].ray_c = rays[i];
  return samples;
}

/// How well a set of samples agrees with a pose; `measured` turns a sample into planar depth.
struct Agreement {
  double ratio = 0;    ///< median |error| / sigma
  double error_m = 0;  ///< median |error|
  double scale = 1;    ///< median measured / predicted
  std::size_t pixels = 0;
};

Agreement Compare(const std::vector<Sample>& samples, const Pose& T_wc,
                  const std::function<double(const Sample&)>& measured,
                  const std::string& sensor, double unit_m) {
  std::vector<double> ratios, errors, scales;
  for (const Sample& sample : samples) {
    const Vector3d ray_w = T_wc.R * sample.ray_c;
    const double towards = sample.plane->pi_g.n.dot(ray_w);
    const double z = -SignedDistance(sample.plane->pi_g, T_wc.t) / towards;
    const double tilt =
        std::acos(std::clamp(std::abs(towards) / sample.ray_c.norm(), 0.0, 1.0));
    if (tilt > kMaxTilt_rad) continue;
    const double z_measured = measured(sample);
    // A plane behind the camera is predicted nowhere: as wrong as can be.
    const bool ahead = std::isfinite(z) && z > 0;
    const double error = ahead ? std::abs(z_measured - z) : z_measured;
    errors.push_back(error);
    ratios.push_back(ahead ? error / DepthSigma(sensor, z, tilt, unit_m) : 1e6);
    scales.push_back(ahead ? z_measured / z : 0);
  }
  if (errors.size() < kMinDepthPixels) return {};
  return {Quantile(ratios, 0.5), Quantile(errors, 0.5), Quantile(scales, 0.5), errors.size()};
}

// Tries the usual mistakes on a bad frame; the first that makes it good is named.
std::string Explain(const std::vector<Sample>& samples, const Pose& T_wc,
                    const Agreement& found, const std::string& sensor, double unit_m) {
  const auto as_told = [](const Sample& s) { return s.depth_m; };
  const auto agrees = [&](const Pose& pose,
                          const std::function<double(const Sample&)>& measured) {
    const Agreement tried = Compare(samples, pose, measured, sensor, unit_m);
    return tried.pixels > 0 && tried.ratio <= 1;
  };
  if (agrees(T_wc, [](const Sample& s) { return s.depth_m / s.ray_c.norm(); })) {
    return "the depth is the length of the ray; write the coordinate along the optical axis";
  }
  if (agrees(Inverse(T_wc), as_told)) {
    return "groundtruth.txt holds world to camera; write camera to world";
  }
  const double scale = found.scale;
  if (scale > 0 && agrees(T_wc, [&](const Sample& s) { return s.depth_m / scale; })) {
    return fmt::format(
        "all depths are {:.4g} times too large; mend depth_factor in camera.yaml", scale);
  }
  return "";
}

}  // namespace

TruthDepthCheck::TruthDepthCheck(Folder& folder, const SequenceTruth& truth)
    : folder_(folder), truth_(truth) {}

void TruthDepthCheck::Frame(double stamp_s, const cv::Mat& plane_ids) {
  if (!truth_.camera || !truth_.scene || plane_ids.empty()) return;
  const auto pair = std::find_if(
      truth_.pairs.begin(), truth_.pairs.end(),
      [&](const SequenceFrame& p) { return std::abs(p.stamp_s - stamp_s) <= kSameInstant_s; });
  if (pair == truth_.pairs.end()) return;
  const auto T_wc = PoseAt(truth_.poses, pair->depth_stamp_s);
  Folder again(folder_.root(), OnFault::kCollect);  // its faults have been told
  const cv::Mat depth = ReadImage(again, pair->depth, {CV_16U, 1, plane_ids.size()});
  if (!T_wc || depth.empty()) return;

  const bool same_instant = std::abs(pair->depth_stamp_s - stamp_s) <= kSameInstant_s;
  const std::vector<Sample> samples = Samples(
      depth, same_instant ? plane_ids : InnerIds(plane_ids), *truth_.scene, *truth_.camera);
  const double unit_m = 1 / truth_.camera->depth_factor;
  const auto as_told = [](const Sample& s) { return s.depth_m; };
  const Agreement found = Compare(samples, *T_wc, as_told, truth_.sensor, unit_m);
  if (found.pixels == 0) return;
  Verdict verdict{pair->depth, found.error_m, !(found.ratio <= 1), ""};
  if (verdict.bad) {
    verdict.explanation = Explain(samples, *T_wc, found, truth_.sensor, unit_m);
  }
  verdicts_.push_back(verdict);
}

void TruthDepthCheck::Finish() {
  std::vector<Verdict> bad;
  for (const Verdict& verdict : verdicts_) {
    if (verdict.bad) bad.push_back(verdict);
  }
  const std::string unexplained =
      "check the poses, camera.yaml, the planes of gt/scene.json and the order of the images";
  if (bad.size() <= verdicts_.size() / 2) {
    for (const Verdict& verdict : bad) {
      folder_.Tell(verdict.file, 0,
                   fmt::format("is {:.1f} mm (median) off the depth that the truth predicts",
                               verdict.error_m * 1e3),
                   verdict.explanation.empty() ? unexplained : verdict.explanation);
    }
    return;
  }
  // Without its numbers, which noise changes from frame to frame.
  const auto kind = [](const Verdict& verdict) {
    return verdict.explanation.substr(0, verdict.explanation.find_first_of("0123456789"));
  };
  std::map<std::string, int> votes;
  std::vector<double> errors;
  for (const Verdict& verdict : bad) {
    ++votes[kind(verdict)];
    errors.push_back(verdict.error_m);
  }
  const auto most =
      std::max_element(votes.begin(), votes.end(),
                       [](const auto& a, const auto& b) { return a.second < b.second; });
  std::string mend = unexplained;
  for (const Verdict& verdict : bad) {
    if (!verdict.explanation.empty() && kind(verdict) == most->first) {
      mend = verdict.explanation;
      break;
    }
  }
  folder_.Tell(
      "depth.txt", 0,
      fmt::format("in {} of {} frames the depth is off what the truth predicts, by {:.1f} mm "
                  "(median)",
                  bad.size(), verdicts_.size(), Quantile(errors, 0.5) * 1e3),
      mend);
}

}  // namespace eval
