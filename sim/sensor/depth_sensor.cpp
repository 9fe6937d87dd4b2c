#include "sim/sensor/depth_sensor.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "sim/sensor/depth_effects.h"
#include "sim/sensor/recycled.h"

namespace sim {
namespace {

constexpr double kHalfPi = std::numbers::pi / 2;

/// To nearest, halves away from zero.
int Nearest(double x) { return static_cast<int>(x < 0 ? x - 0.5 : x + 0.5); }

/// The three fields of noise of a frame.
struct Noises {
  std::array<cv::Mat1f, 3> fields;  ///< in the order of DepthDraw
  const cv::Mat1f& axial() const { return fields[kAxialDraw]; }
  const cv::Mat1f& jitter_u() const { return fields[kJitterUDraw]; }
  const cv::Mat1f& jitter_v() const { return fields[kJitterVDraw]; }
};

/// Which pixel's surface a pixel sees: itself, but near an edge perhaps a neighbour's.
cv::Point Source(const Rendering& rendering, cv::Point at, double sigma, float jitter_u,
                 float jitter_v) {
  const int du = Nearest(sigma * static_cast<double>(jitter_u));
  const int dv = Nearest(sigma * static_cast<double>(jitter_v));
  if (du == 0 && dv == 0) return at;
  const cv::Point to(std::clamp(at.x + du, 0, rendering.depth_m.cols - 1),
                     std::clamp(at.y + dv, 0, rendering.depth_m.rows - 1));
  return SameSurface(rendering, at, to) ? at : to;
}

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

namespace {

/// z as it comes out with noise and rounding; `draw` is standard normal. 0 = no measurement.
double Measured(double z, double theta, float draw, const KinectModel& model) {
  if (!(model.noise_scale > 0) && !model.quantise) return z;
  double disparity = model.disparity_m_steps / z;
  if (model.noise_scale > 0) {
    const double sigma_m = model.noise_scale * AxialSigma(z, theta);
    disparity += DisparitySigma(sigma_m, z, model) * static_cast<double>(draw);
  }
  if (model.quantise) disparity = static_cast<double>(static_cast<long>(disparity + 0.5));
  return disparity >= 1.0 ? model.disparity_m_steps / disparity : 0.0;
}

}  // namespace

cv::Mat1d MeasureDepth(const Rendering& rendering, const KinectModel& model,
                       const PixelNoise& noise) {
  const cv::Size size = rendering.depth_m.size();
  thread_local Noises noises;  // memory only
  SmoothNoise(size, 1, noise, kAxialDraw, noises.fields);
  thread_local cv::Mat1d kept;
  cv::Mat1d measured = Recycled(kept, size);
  for (int v = 0; v < size.height; ++v) {
    const double* depth = rendering.depth_m[v];
    const float* cosine = rendering.incidence_cos[v];
    const float *axial = noises.axial()[v], *jitter_u = noises.jitter_u()[v],
                *jitter_v = noises.jitter_v()[v];
    double* out = measured[v];
    for (int u = 0; u < size.width; ++u) {
      out[u] = 0.0;
      if (!(depth[u] > 0)) continue;
      double z = depth[u], theta = Incidence(cosine[u]);
      cv::Point seen(u, v);
      if (model.lateral_scale > 0) {
        const double sigma =
            model.lateral_scale * LateralSigma(std::min(theta, 0.95 * kHalfPi));
        seen = Source(rendering, seen, sigma, jitter_u[u], jitter_v[u]);
        if (seen != cv::Point(u, v)) {
          z = rendering.depth_m(seen);
          theta = Incidence(rendering.incidence_cos(seen));
        }
      }
      if (!(z >= model.min_depth_m && z <= model.max_depth_m)) continue;
      if (!(theta <= model.max_incidence_rad)) continue;
      if (!rendering.projector_lit.empty() && rendering.projector_lit(seen) == 0) continue;
      out[u] = Measured(z, theta, axial[u], model);
    }
  }
  return measured;
}

cv::Mat1w EncodeDepth(const cv::Mat1d& depth_m, double depth_factor) {
  thread_local cv::Mat1w kept;
  cv::Mat1w units = Recycled(kept, depth_m.size());
  for (int v = 0; v < depth_m.rows; ++v) {
    const double* in = depth_m[v];
    ushort* out = units[v];
    for (int u = 0; u < depth_m.cols; ++u) {
      const double value = in[u] * depth_factor + 0.5;
      out[u] = value >= 1.0 && value < 65536.0 ? static_cast<ushort>(value) : ushort{0};
    }
  }
  return units;
}

}  // namespace sim
