#include "sim/sensor/depth/kinect_rows.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/sensor/depth/depth_effects.h"
#include "sim/trace/lanes.h"

namespace sim {
namespace {

constexpr double kHalfPi = std::numbers::pi / 2;
// The rest of the law of depth_sensor.h, from the same paper.
constexpr double kGrazing = 0.0001;  ///< m^1.5, beyond 60 degrees
constexpr double kLateralFloor_px = 0.8, kLateralGrowth_px = 0.035;

/// To nearest, halves away from zero.
inline int Nearest(double x) { return static_cast<int>(x < 0 ? x - 0.5 : x + 0.5); }

/// To nearest, halves up; 0 <= x < 2^51.
inline double Rounded(double x) {
  constexpr double kWhole = 0x1.8p52;  // added to a number it leaves no digits after the point
  const double up = x + 0.5, near = (up + kWhole) - kWhole;
  return near > up ? near - 1.0 : near;
}

inline double Lateral(double theta) {
  return kLateralFloor_px + kLateralGrowth_px * theta / (kHalfPi - theta);
}

inline double Axial(double z, double theta) {
  const double ratio = theta / (kHalfPi - theta);
  const double grazing = kGrazing / std::sqrt(z) * ratio * ratio;
  const double sigma =
      kAxialFloor_m + kAxialGrowth_per_m * (z - kAxialNearest_m) * (z - kAxialNearest_m);
  return theta > std::numbers::pi / 3 ? sigma + grazing : sigma;
}

/// Disparity noise in steps so that, with rounding (variance 1/12), the sd in metres is sigma.
template <bool kQuantise>
inline double DisparitySigma(double sigma_m, double z, double steps) {
  const double sigma = sigma_m * steps / (z * z);
  if (!kQuantise) return sigma;
  return std::sqrt(std::max(sigma * sigma - 1.0 / 12.0, 1.0 / 36.0));
}

template <bool kNoisy, bool kQuantise>
[[gnu::always_inline]] inline void Measured(const double* z, const double* theta,
                                            const float* draw, const KinectModel& model,
                                            int count, double* measured) {
  const double steps = model.disparity_m_steps, scale = model.noise_scale;
  const double least = model.min_depth_m, most = model.max_depth_m;
  const double flattest = model.max_incidence_rad;
  for (int i = 0; i < count; ++i) {
    // Noise is added and rounded in disparity, where the sensor measures, and turned back.
    double disparity = steps / z[i];
    if (kNoisy) {
      const double sigma_m = scale * Axial(z[i], theta[i]);
      disparity +=
          DisparitySigma<kQuantise>(sigma_m, z[i], steps) * static_cast<double>(draw[i]);
    }
    if (kQuantise) disparity = Rounded(disparity);
    const bool changed = kNoisy || kQuantise;
    const double found = changed ? steps / disparity : z[i];
    const bool seen = (z[i] > 0) & (z[i] >= least) & (z[i] <= most) & (theta[i] <= flattest);
    measured[i] = seen & (!changed | (disparity >= 1.0)) ? found : 0.0;
  }
}

}  // namespace

double AxialSigma(double z_m, double theta_rad) { return Axial(z_m, theta_rad); }

SIM_LANES void KinectAngles(const float* cosine, int count, double* theta) {
  for (int i = 0; i < count; ++i) theta[i] = Incidence(cosine[i]);
}

SIM_LANES void KinectJitter(const double* theta, const float* jitter_u, const float* jitter_v,
                            double scale, int count, int* du, int* dv) {
  for (int i = 0; i < count; ++i) {
    const double sigma = scale * Lateral(std::min(theta[i], 0.95 * kHalfPi));
    du[i] = Nearest(sigma * static_cast<double>(jitter_u[i]));
    dv[i] = Nearest(sigma * static_cast<double>(jitter_v[i]));
  }
}

SIM_LANES void KinectMeasured(const double* z, const double* theta, const float* draw,
                              const KinectModel& model, int count, double* measured) {
  if (model.noise_scale > 0 && model.quantise) {
    Measured<true, true>(z, theta, draw, model, count, measured);
  } else if (model.noise_scale > 0) {
    Measured<true, false>(z, theta, draw, model, count, measured);
  } else if (model.quantise) {
    Measured<false, true>(z, theta, draw, model, count, measured);
  } else {
    Measured<false, false>(z, theta, draw, model, count, measured);
  }
}

SIM_LANES void DepthUnits(const double* depth_m, double depth_factor, int count,
                          ushort* units) {
  for (int i = 0; i < count; ++i) {
    const double value = depth_m[i] * depth_factor + 0.5;
    const bool fits = (value >= 1.0) & (value < 65536.0);
    units[i] = static_cast<ushort>(static_cast<int>(fits ? value : 0.0));
  }
}

}  // namespace sim
