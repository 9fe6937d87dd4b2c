#pragma once

#include <Eigen/Core>
#include <cmath>
#include <numbers>
#include <vector>

namespace sim {

/// Root mean square of the acceleration, m/s^2, of positions `rate_hz` apart, of which Gauss's
/// bell of 50 ms has taken the noise. The recorded fr1/xyz has 0.81 by this measure.
inline double RmsAcceleration(const std::vector<Eigen::Vector3d>& path_w, double rate_hz) {
  const double sigma = 0.05 * rate_hz;
  const int reach = static_cast<int>(std::ceil(4 * sigma)), n = static_cast<int>(path_w.size());
  std::vector<Eigen::Vector3d> smooth_w;
  for (int i = reach; i + reach < n; ++i) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    double weights = 0;
    for (int k = -reach; k <= reach; ++k) {
      const double weight = std::exp(-0.5 * k * k / (sigma * sigma));
      sum += weight * path_w[static_cast<std::size_t>(i + k)];
      weights += weight;
    }
    smooth_w.push_back(sum / weights);
  }
  double sum = 0;
  for (std::size_t i = 2; i < smooth_w.size(); ++i) {
    sum += (smooth_w[i] - 2 * smooth_w[i - 1] + smooth_w[i - 2]).squaredNorm();
  }
  return std::sqrt(sum / static_cast<double>(smooth_w.size() - 2)) * rate_hz * rate_hz;
}

/// Standard deviation in space, mm, of the part of the way with frequencies of [low, high): by
/// a Fourier transform under Hann's window. The recorded fr1/xyz has 5.5 in 1-4 Hz, 0.28 in
/// 4-12 Hz.
inline double SwayIn_mm(const std::vector<Eigen::Vector3d>& path_w, double rate_hz,
                        double low_hz, double high_hz) {
  const double n = static_cast<double>(path_w.size());
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : path_w) mean += p / n;
  std::vector<Eigen::Vector3d> windowed;
  double window_power = 0;
  for (const Eigen::Vector3d& p : path_w) {
    const double i = static_cast<double>(windowed.size());
    const double window = 0.5 - 0.5 * std::cos(2 * std::numbers::pi * i / n);
    windowed.push_back(window * (p - mean));
    window_power += window * window;
  }
  double variance = 0;
  for (double k = std::ceil(low_hz * n / rate_hz); k < high_hz * n / rate_hz; ++k) {
    Eigen::Vector3d even = Eigen::Vector3d::Zero(), odd = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < windowed.size(); ++i) {
      const double angle = 2 * std::numbers::pi * k * static_cast<double>(i) / n;
      even += std::cos(angle) * windowed[i];
      odd += std::sin(angle) * windowed[i];
    }
    variance += 2 * (even.squaredNorm() + odd.squaredNorm()) / n / window_power;
  }
  return 1000 * std::sqrt(variance);
}

}  // namespace sim
