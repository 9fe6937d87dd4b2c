#pragma once

#include <array>
#include <opencv2/core/mat.hpp>

#include "sim/sensor/noise.h"

namespace sim {

/// Blobs: measured in partly lost surfaces of fr1/xyz and the kitchen, the autocorrelation of the
/// loss falls to a half after 4.5 to 6.5 px; that of noise linear between knots after 0.7 of them.
inline constexpr int kBlobKnot_px = 8;

/// Normal noise, sd 1 at each pixel, linear between knots: blobs of some pixels.
class BlobNoise {
 public:
  BlobNoise(cv::Size size, const PixelNoise& noise, std::uint32_t draw);

  double At(int u, int v) const {
    const auto& [left, right] = weights_[static_cast<std::size_t>(u % kBlobKnot_px)];
    const auto& [above, below] = weights_[static_cast<std::size_t>(v % kBlobKnot_px)];
    const float* upper = knots_[v / kBlobKnot_px] + u / kBlobKnot_px;
    const float* lower = knots_[v / kBlobKnot_px + 1] + u / kBlobKnot_px;
    return above *
               (left * static_cast<double>(upper[0]) + right * static_cast<double>(upper[1])) +
           below *
               (left * static_cast<double>(lower[0]) + right * static_cast<double>(lower[1]));
  }

 private:
  cv::Mat1f knots_;
  /// Shares of the knots on both sides, scaled so that the sd between knots is theirs.
  std::array<std::array<double, 2>, kBlobKnot_px> weights_;
};

}  // namespace sim
