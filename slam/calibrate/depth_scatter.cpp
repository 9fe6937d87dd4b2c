#include "slam/calibrate/depth_scatter.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <utility>

#include "slam/base/median.h"

namespace slam {
namespace {

constexpr int kSide_px = 12;  // wider than sensors share errors, narrower than they bend
constexpr int kPixels = kSide_px * kSide_px;

// Nearer, the noise of all sensors is alike; farther, few measure at all.
constexpr double kNearest_m = 0.9;
constexpr double kFarthest_m = 4.0;
constexpr std::size_t kMinWindows = 500;  // a quarter of one image of 640 x 480

// Bounds are between what recordings show (docs/planes.md#sensors). Levels: 0.18 to 0.85 by Azure,
// 0.77 to 1.02 by first Kinects, two of them real, 1.48 to 1.85 by D435, 0.02 without noise.
constexpr double kNoNoise = 0.06;
constexpr double kTimeOfFlightLevel = 0.9;  // a Kinect simulated with white noise has 1.0
constexpr double kStereoLevel = 1.25;
// Triangulation matches windows, so that neighbours err alike: 0.29 to 0.53. Time of flight
// measures each pixel by itself: -0.03 to -0.01.
constexpr double kAlike = 0.15;

using Values = Eigen::Matrix<double, kSide_px, kSide_px, Eigen::RowMajor>;

/// Inverse depths of a window; false if one of its pixels is not measured.
bool ReadWindow(const cv::Mat1f& depth_m, int u0, int v0, Values& q) {
  for (int v = 0; v < kSide_px; ++v) {
    const float* row = depth_m[v0 + v] + u0;
    for (int u = 0; u < kSide_px; ++u) {
      if (!(row[u] > 0.0f) || !std::isfinite(row[u])) return false;
      q(v, u) = 1.0 / row[u];
    }
  }
  return true;
}

/// Takes the best linear function of the pixel out of a window.
void TakeOutPlane(Values& q) {
  static const Eigen::RowVectorXd at =
      Eigen::RowVectorXd::LinSpaced(kSide_px, -0.5 * (kSide_px - 1), 0.5 * (kSide_px - 1));
  const double norm = kSide_px * at.squaredNorm();
  const double along_u = (q.colwise().sum().array() * at.array()).sum() / norm;
  const double along_v = (q.rowwise().sum().transpose().array() * at.array()).sum() / norm;
  q.array() -= q.mean();
  q.rowwise() -= along_u * at;
  q.colwise() -= along_v * at.transpose();
}

}  // namespace

void DepthScatter::Add(const cv::Mat1f& depth_m) {
  const DepthNoise kinect = ModelOf(DepthSensor::kKinect1).noise;
  Values q;
  for (int v0 = 0; v0 + kSide_px <= depth_m.rows; v0 += kSide_px) {
    for (int u0 = 0; u0 + kSide_px <= depth_m.cols; u0 += kSide_px) {
      if (!ReadWindow(depth_m, u0, v0, q)) continue;
      const double z_m = 1.0 / q.mean();
      if (z_m < kNearest_m || z_m > kFarthest_m) continue;
      TakeOutPlane(q);
      constexpr double kParameters = 3.0;
      const double variance = q.squaredNorm() / (kPixels - kParameters);
      const double beside =
          (q.leftCols<kSide_px - 1>().array() * q.rightCols<kSide_px - 1>().array()).mean();
      windows_.push_back({std::sqrt(variance) * z_m * z_m / kinect.Sigma(z_m),
                          variance > 0.0 ? beside / variance : 0.0});
    }
  }
}

DepthScatter::Figures DepthScatter::Measure() const {
  if (windows_.empty()) return {};
  std::vector<Window> half = windows_;
  std::sort(half.begin(), half.end(),
            [](const Window& a, const Window& b) { return a.level < b.level; });
  half.resize((half.size() + 1) / 2);
  std::vector<double> level, alike;
  for (const Window& window : half) {
    level.push_back(window.level);
    alike.push_back(window.alike);
  }
  return {UpperMedian(std::move(level)), UpperMedian(std::move(alike)), windows_.size()};
}

std::optional<DepthSensor> DepthScatter::TellSensor() const {
  const Figures seen = Measure();
  if (seen.windows < kMinWindows || seen.level < kNoNoise) return std::nullopt;
  if (seen.level > kStereoLevel) return DepthSensor::kD435;
  if (seen.alike > kAlike) return DepthSensor::kKinect1;
  if (seen.level < kTimeOfFlightLevel) return DepthSensor::kAzure;
  return std::nullopt;
}

}  // namespace slam
