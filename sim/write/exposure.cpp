#include "sim/write/exposure.h"

#include <algorithm>
#include <cmath>

#include "sim/sensor/noise.h"

namespace sim {
namespace {

constexpr int kBandRows = 8;
constexpr double kDriftKnot_s = 1.5;
/// Keeps these draws apart from the noise of frames.
constexpr std::uint64_t kExposureFrame = 0xFFFFFFFFFFFFFFFDull;

/// Adds the band's rows as they are at one moment. A row more on either side lets edges be
/// smoothed as in a whole image.
void AddBand(const FrameRenderer& renderer, const Pose& T_wc, double time_s,
             const cv::Range& band, cv::Mat3f& sum) {
  thread_local Rendering part;  // memory only
  RenderOptions options;
  options.exact_edges = false;  // edges are averaged over four rays
  options.sensed = false;
  options.time_s = time_s;
  options.rows = cv::Range(std::max(0, band.start - 1), std::min(sum.rows, band.end + 1));
  renderer.Render(T_wc, options, part);
  for (int v = band.start; v < band.end; ++v) {
    for (int u = 0; u < sum.cols; ++u) sum(v, u) += part.radiance(v, u);
  }
}

}  // namespace

double RowTime_s(const Exposure& exposure, double v, int height) {
  return exposure.rolling_s * (v / (height - 1) - 0.5);
}

cv::Mat3f ExposeMoving(const FrameRenderer& renderer, const Exposure& exposure,
                       const PoseAround& around, double time_s) {
  const cv::Size size(renderer.camera().width, renderer.camera().height);
  cv::Mat3f sum(size, cv::Vec3f(0, 0, 0));
  const int samples = exposure.shutter_s > 0 ? std::max(1, exposure.shutter_samples) : 1;
  const int rows = exposure.rolling_s != 0 ? kBandRows : size.height;
  for (int first = 0; first < size.height; first += rows) {
    const cv::Range band(first, std::min(size.height, first + rows));
    const double row_s = RowTime_s(exposure, 0.5 * (band.start + band.end - 1), size.height);
    for (int i = 0; i < samples; ++i) {
      const double shutter_s = exposure.shutter_s * ((i + 0.5) / samples - 0.5);
      AddBand(renderer, around(row_s + shutter_s), time_s + row_s + shutter_s, band, sum);
    }
  }
  if (samples > 1) sum = sum * (1.0 / samples);
  return sum;
}

double ExposureGain(const Exposure& exposure, std::uint64_t seed, double time_s) {
  if (exposure.drift_stops == 0) return 1.0;
  const PixelNoise noise(seed, kExposureFrame);
  const double knots = time_s / kDriftKnot_s, before = std::floor(knots);
  const auto knot = [&](double at) {
    return 2.0 * noise.Uniform(static_cast<int>(at), 0, 0) - 1.0;
  };
  const double x = knots - before, smooth = x * x * (3.0 - 2.0 * x);
  const double drift = knot(before) + smooth * (knot(before + 1) - knot(before));
  return std::exp2(exposure.drift_stops * drift);
}

}  // namespace sim
