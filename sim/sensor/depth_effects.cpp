#include "sim/sensor/depth_effects.h"

#include <algorithm>
#include <cmath>

namespace sim {

cv::Mat1f SmoothNoise(const cv::Size& size, int radius, const PixelNoise& noise,
                      std::uint32_t draw) {
  const int side = 2 * radius + 1;
  cv::Mat1f white(size.height + 2 * radius, size.width + 2 * radius);
  for (int v = 0; v < white.rows; ++v) {
    for (int u = 0; u < white.cols; ++u) {
      white(v, u) = static_cast<float>(noise.Normal(u - radius, v - radius, draw));
    }
  }
  cv::Mat1f across(white.rows, size.width), smooth(size);
  for (int v = 0; v < white.rows; ++v) {
    for (int u = 0; u < size.width; ++u) {
      float sum = white(v, u);
      for (int i = 1; i < side; ++i) sum += white(v, u + i);
      across(v, u) = sum;
    }
  }
  for (int v = 0; v < size.height; ++v) {
    for (int u = 0; u < size.width; ++u) {
      float sum = across(v, u);
      for (int i = 1; i < side; ++i) sum += across(v + i, u);
      smooth(v, u) = sum / static_cast<float>(side);
    }
  }
  return smooth;
}

double Incidence(float cosine) {
  return std::acos(std::clamp(static_cast<double>(cosine), 0.0, 1.0));
}

bool SameSurface(const Rendering& rendering, cv::Point a, cv::Point b) {
  return rendering.plane_id(a) == rendering.plane_id(b) &&
         rendering.object_id(a) == rendering.object_id(b);
}

double RoundDepth(double z_m, double step_m) {
  return step_m > 0 ? step_m * std::floor(z_m / step_m + 0.5) : z_m;
}

double SigmaBeforeRounding(double sigma, double step_a, double step_b) {
  const double rounding = (step_a * step_a + step_b * step_b) / 12.0;
  const double least = std::max(step_a, step_b) / 6.0;
  return std::sqrt(std::max(sigma * sigma - rounding, least * least));
}

}  // namespace sim
