#include "slam/extract/roughness.h"

#include "slam/extract/pixel_labels.h"

namespace slam {
namespace {

constexpr int kApart_px = 8;
constexpr int kMinPairs = 30;

}  // namespace

double MeasureRoughness(const DepthGrid& grid, const cv::Mat1b& labels, const cv::Rect& bounds,
                        std::uint8_t label, const InverseDepthPlane& plane,
                        const DepthNoise& noise, int step_px) {
  const LabelPlane unslanted{plane, 1.0};
  const auto at = [&](int u, int v) {
    return ResidualSigmas(grid, static_cast<std::size_t>(grid.Index(u, v)), unslanted);
  };
  double sum = 0.0;
  int pairs = 0;
  const auto add = [&](float here, int u, int v) {
    if (u >= labels.cols || v >= labels.rows || labels(v, u) != label) return;
    const float by = here - at(u, v);
    sum += static_cast<double>(by * by), ++pairs;
  };
  for (int v = bounds.y; v < bounds.y + bounds.height; v += step_px) {
    for (int u = bounds.x; u < bounds.x + bounds.width; u += step_px) {
      if (labels(v, u) != label) continue;
      const float here = at(u, v);
      add(here, u + kApart_px, v);
      add(here, u, v + kApart_px);
    }
  }
  if (pairs < kMinPairs) return 0.0;
  const int u = bounds.x + bounds.width / 2, v = bounds.y + bounds.height / 2;
  const auto i = static_cast<std::size_t>(grid.Index(u, v));
  const auto x = static_cast<double>(grid.x[i]), y = static_cast<double>(grid.y[i]);
  const double q = plane.InverseDepth(x, y);
  const double grazing = q > 0 ? noise.GrazingFactor(1.0 / q, plane.Cosine(x, y)) : 1.0;
  return sum / (2.0 * pairs * grazing * grazing);
}

}  // namespace slam
