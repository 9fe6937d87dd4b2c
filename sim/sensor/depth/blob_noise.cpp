#include "sim/sensor/depth/blob_noise.h"

#include <cmath>

namespace sim {

BlobNoise::BlobNoise(cv::Size size, const PixelNoise& noise, std::uint32_t draw)
    : knots_(size.height / kBlobKnot_px + 2, size.width / kBlobKnot_px + 2) {
  for (int j = 0; j < knots_.rows; ++j) {
    for (int i = 0; i < knots_.cols; ++i) {
      knots_(j, i) = static_cast<float>(noise.Normal(i, j, draw));
    }
  }
  for (int k = 0; k < kBlobKnot_px; ++k) {
    const double part = (k + 0.5) / kBlobKnot_px;
    const double norm = 1.0 / std::sqrt(part * part + (1.0 - part) * (1.0 - part));
    weights_[static_cast<std::size_t>(k)] = {norm * (1.0 - part), norm * part};
  }
}

}  // namespace sim
