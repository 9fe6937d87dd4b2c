#include "slam/extract/plane_edges.h"

#include <algorithm>
#include <cstddef>

namespace slam {
namespace {

constexpr std::size_t kLeastContour = 8;  // pixels; shorter ones bound specks

/// To the nearest integer, halves away from zero.
int Rounded(double x) {
  const int whole = static_cast<int>(x);
  const double rest = x - whole;
  return whole + (rest >= 0.5 ? 1 : 0) - (rest <= -0.5 ? 1 : 0);
}

EdgeKind KindBeyond(const DepthGrid& grid, const cv::Point& at, const Eigen::Vector2d& outward,
                    const LabelPlane& plane, const EdgeConfig& config) {
  const Eigen::Vector2d step = outward / outward.cwiseAbs().maxCoeff();
  const float least_step = static_cast<float>(config.min_step_sigmas);
  float first = 0, last = 0;
  int measured = 0;
  for (int k = 1; k <= std::max(config.reach_px, config.shadow_px); ++k) {
    if (k > config.reach_px && measured > 0) break;
    const int u = at.x + Rounded(k * step.x());
    const int v = at.y + Rounded(k * step.y());
    if (u < 0 || v < 0 || u >= grid.width || v >= grid.height) {
      if (measured == 0) return k <= config.reach_px ? EdgeKind::kBorder : EdgeKind::kMissing;
      break;
    }
    const auto i = static_cast<std::size_t>(grid.Index(u, v));
    if (!(grid.g[i] > 0)) continue;
    last = ResidualSigmas(grid, i, plane);
    if (k > config.reach_px) {  // beyond a gap
      if (last < -least_step) return EdgeKind::kSurface;
      return last > least_step ? EdgeKind::kOccluded : EdgeKind::kMissing;
    }
    if (measured++ == 0) first = last;
  }
  if (measured == 0) return EdgeKind::kMissing;
  if (!(last > least_step)) return EdgeKind::kSurface;
  return first < static_cast<float>(config.max_crease_start) * last ? EdgeKind::kSurface
                                                                    : EdgeKind::kOccluded;
}

}  // namespace

void FindEdgePoints(const DepthGrid& grid, const OuterContours& contours, int value,
                    const LabelPlane& plane, const EdgeConfig& config,
                    std::vector<EdgePoint>& edge) {
  edge.clear();
  const auto& list = contours.contours();
  auto contour = std::lower_bound(list.begin(), list.end(), value,
                                  [](const auto& c, int label) { return c.label < label; });
  for (; contour != list.end() && contour->label == value; ++contour) {
    if (contour->end - contour->begin < kLeastContour) break;
    for (std::size_t k = contour->begin; k < contour->end;
         k += static_cast<std::size_t>(config.step_px)) {
      const cv::Point& at = contours.points()[k];
      const cv::Point sum = contours.Outward(at);
      if (sum.x == 0 && sum.y == 0) continue;
      const auto i = static_cast<std::size_t>(grid.Index(at.x, at.y));
      const double z = 1.0 / static_cast<double>(grid.q[i]);
      edge.push_back({Eigen::Vector3d(static_cast<double>(grid.x[i]) * z,
                                      static_cast<double>(grid.y[i]) * z, z),
                      Eigen::Vector2d(at.x, at.y),
                      KindBeyond(grid, at, Eigen::Vector2d(sum.x, sum.y), plane, config)});
    }
  }
}

}  // namespace slam
