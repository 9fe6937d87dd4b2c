#include "sim/sensor/depth_sensor.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/sensor/depth_effects.h"

namespace sim {
namespace {

constexpr double kHalfPi = std::numbers::pi / 2;

/// Which pixel's surface each pixel sees: itself, but near an edge perhaps a neighbour's.
class LateralJitter {
 public:
  LateralJitter(const Rendering& rendering, double scale, const PixelNoise& noise)
      : rendering_(rendering), scale_(scale) {
    if (scale_ <= 0) return;
    jitter_u_ = SmoothNoise(rendering.depth_m.size(), 1, noise, kJitterUDraw);
    jitter_v_ = SmoothNoise(rendering.depth_m.size(), 1, noise, kJitterVDraw);
  }
  cv::Point Source(int u, int v) const {
    if (scale_ <= 0) return {u, v};
    const double sigma =
        scale_ *
        LateralSigma(std::min(Incidence(rendering_.incidence_cos(v, u)), 0.95 * kHalfPi));
    const auto moved = [&](float draw, int from, int size) {
      const int to = from + static_cast<int>(std::lround(sigma * static_cast<double>(draw)));
      return std::clamp(to, 0, size - 1);
    };
    const int x = moved(jitter_u_(v, u), u, rendering_.depth_m.cols);
    const int y = moved(jitter_v_(v, u), v, rendering_.depth_m.rows);
    return SameSurface(rendering_, {u, v}, {x, y}) ? cv::Point(u, v) : cv::Point(x, y);
  }

 private:
  const Rendering& rendering_;
  double scale_;
  cv::Mat1f jitter_u_, jitter_v_;
};

/// Disparity noise in steps so that, with rounding (variance 1/12), the sd in metres is sigma.
double DisparitySigma(double sigma_m, double z, const KinectModel& model) {
  const double sigma = sigma_m * model.disparity_m_steps / (z * z);
  if (!model.quantise) return sigma;
  return std::sqrt(std::max(sigma * sigma - 1.0 / 12.0, 1.0 / 36.0));
}

}  // namespace

double AxialSigma(double z_m, double theta_rad) {
  double sigma = 0.0012 + 0.0019 * (z_m - 0.4) * (z_m - 0.4);
  if (theta_rad > std::numbers::pi / 3) {
    const double ratio = theta_rad / (kHalfPi - theta_rad);
    sigma += 0.0001 / std::sqrt(z_m) * ratio * ratio;
  }
  return sigma;
}

double LateralSigma(double theta_rad) {
  return 0.8 + 0.035 * theta_rad / (kHalfPi - theta_rad);
}

cv::Mat1d MeasureDepth(const Rendering& rendering, const KinectModel& model,
                       const PixelNoise& noise) {
  const cv::Size size = rendering.depth_m.size();
  const LateralJitter jitter(rendering, model.lateral_scale, noise);
  cv::Mat1f draw;
  if (model.noise_scale > 0) draw = SmoothNoise(size, 1, noise, kAxialDraw);
  cv::Mat1d measured(size, 0.0);
  for (int v = 0; v < size.height; ++v) {
    for (int u = 0; u < size.width; ++u) {
      if (!(rendering.depth_m(v, u) > 0)) continue;
      const cv::Point seen = jitter.Source(u, v);
      const double z = rendering.depth_m(seen);
      const double theta = Incidence(rendering.incidence_cos(seen));
      if (!(z >= model.min_depth_m && z <= model.max_depth_m)) continue;
      if (!(theta <= model.max_incidence_rad)) continue;
      if (!rendering.projector_lit.empty() && rendering.projector_lit(seen) == 0) continue;
      double result = z;
      if (model.noise_scale > 0 || model.quantise) {
        double disparity = model.disparity_m_steps / z;
        if (model.noise_scale > 0) {
          const double sigma_m = model.noise_scale * AxialSigma(z, theta);
          disparity += DisparitySigma(sigma_m, z, model) * static_cast<double>(draw(v, u));
        }
        if (model.quantise) disparity = std::round(disparity);
        if (!(disparity >= 1.0)) continue;
        result = model.disparity_m_steps / disparity;
      }
      measured(v, u) = result;
    }
  }
  return measured;
}

cv::Mat1w EncodeDepth(const cv::Mat1d& depth_m, double depth_factor) {
  cv::Mat1w units(depth_m.size(), ushort{0});
  for (int v = 0; v < depth_m.rows; ++v) {
    for (int u = 0; u < depth_m.cols; ++u) {
      const double value = std::floor(depth_m(v, u) * depth_factor + 0.5);
      if (value >= 1.0 && value <= 65535.0) units(v, u) = static_cast<ushort>(value);
    }
  }
  return units;
}

}  // namespace sim
