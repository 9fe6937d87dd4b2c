#include "slam/segment/edges/plane_edges.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <opencv2/imgproc.hpp>

#include "slam/base/index.h"
#include "slam/segment/pixels/block_pixels.h"

namespace slam {
namespace {

constexpr std::size_t kMinContour_px = 8;  // shorter ones bound specks
constexpr int kFrame_px = 2;               // around a segment, for Outward

/// To the nearest integer, halves away from zero.
int Rounded(double x) {
  const int whole = static_cast<int>(x);
  const double rest = x - whole;
  return whole + (rest >= 0.5 ? 1 : 0) - (rest <= -0.5 ? 1 : 0);
}

/// The side of one segment on which its boundary is looked beyond.
struct Outside {
  const DepthGrid& grid;
  const cv::Mat1b& labels;
  int value;  ///< the segment's in them
  PixelPlane plane;
  std::span<const double> areas_m2;
  const EdgeConfig& config;

  bool Contains(const cv::Point& at) const {
    return at.x >= 0 && at.y >= 0 && at.x < grid.width && at.y < grid.height;
  }
  std::size_t Index(const cv::Point& at) const {
    return static_cast<std::size_t>(grid.Index(at.x, at.y));
  }
};

cv::Point Along(const cv::Point& at, const Eigen::Vector2d& step, int k) {
  return {at.x + Rounded(k * step.x()), at.y + Rounded(k * step.y())};
}

/// Whether what rises from the segment at a concave crease ends it (min_rising_area).
bool EndsAtCrease(const Outside& outside, const cv::Point& at, const Eigen::Vector2d& step) {
  for (int k = outside.config.reach_px; k >= 1; --k) {
    const cv::Point beyond = Along(at, step, k);
    if (!outside.Contains(beyond)) continue;
    const int label = outside.labels(beyond);
    if (label == 0 || label == outside.value) continue;
    const auto area_m2 = [&](int value) { return outside.areas_m2[Index(value - 1)]; };
    return area_m2(label) >= outside.config.min_rising_area * area_m2(outside.value);
  }
  return false;
}

/// Beyond a gap without depth, which ends within shadow_px.
EdgeKind KindBeyondGap(const Outside& outside, const cv::Point& at, const Eigen::Vector2d& step,
                       float& step_sigmas) {
  const float min_step = static_cast<float>(outside.config.min_step_sigmas);
  for (int k = outside.config.reach_px + 1; k <= outside.config.shadow_px; ++k) {
    const cv::Point beyond = Along(at, step, k);
    if (!outside.Contains(beyond)) break;
    const std::size_t i = outside.Index(beyond);
    if (!(outside.grid.g[i] > 0)) continue;
    const float residual = ResidualSigmas(outside.grid, i, outside.plane);
    step_sigmas = std::abs(residual);
    if (residual < -min_step) return EdgeKind::kSurface;
    return residual > min_step ? EdgeKind::kOccluded : EdgeKind::kMissing;
  }
  return EdgeKind::kMissing;
}

/// @param step_sigmas  set to the residual of what lies beyond
EdgeKind KindBeyond(const Outside& outside, const cv::Point& at, const Eigen::Vector2d& outward,
                    float& step_sigmas) {
  constexpr std::size_t kUnmeasured = std::numeric_limits<std::size_t>::max();
  const EdgeConfig& config = outside.config;
  const Eigen::Vector2d step = outward / outward.cwiseAbs().maxCoeff();

  // The nearest and the farthest that is measured within reach; what lies between does not
  // count.
  std::size_t nearest = kUnmeasured, farthest = kUnmeasured;
  int k = 1;
  for (; k <= config.reach_px && nearest == kUnmeasured; ++k) {
    const cv::Point beyond = Along(at, step, k);
    if (!outside.Contains(beyond)) return EdgeKind::kBorder;
    const std::size_t i = outside.Index(beyond);
    if (outside.grid.g[i] > 0) nearest = farthest = i;
  }
  if (nearest == kUnmeasured) return KindBeyondGap(outside, at, step, step_sigmas);
  for (int far = config.reach_px; far >= k; --far) {
    const cv::Point beyond = Along(at, step, far);
    if (!outside.Contains(beyond) || !(outside.grid.g[outside.Index(beyond)] > 0)) continue;
    farthest = outside.Index(beyond);
    break;
  }

  // What lies nearer than the plane occludes it, unless it rises from the plane at a crease.
  const float last = ResidualSigmas(outside.grid, farthest, outside.plane);
  step_sigmas = std::abs(last);
  if (!(last > static_cast<float>(config.min_step_sigmas))) return EdgeKind::kSurface;
  const float first = ResidualSigmas(outside.grid, nearest, outside.plane);
  const bool crease = first < static_cast<float>(config.max_crease_start) * last;
  return crease && EndsAtCrease(outside, at, step) ? EdgeKind::kSurface : EdgeKind::kOccluded;
}

/// Direction from a pixel to the outside of its segment: the sum of its outside neighbours, two
/// to each side.
cv::Point Outward(const cv::Mat1b& inside, const cv::Point& at) {
  cv::Point sum;
  for (int v = -kFrame_px; v <= kFrame_px; ++v)
    for (int u = -kFrame_px; u <= kFrame_px; ++u)
      if (inside(at.y + v, at.x + u) == 0) sum += cv::Point(u, v);
  return sum;
}

}  // namespace

std::vector<EdgePoint> FindEdgePoints(const DepthGrid& grid, const cv::Mat1b& labels,
                                      const cv::Rect& bounds, int value,
                                      const LabelPlane& plane, std::span<const double> areas_m2,
                                      const EdgeConfig& config) {
  const Outside outside{grid, labels, value, PixelPlane(plane), areas_m2, config};
  const cv::Point frame(kFrame_px, kFrame_px);
  cv::Mat1b inside(bounds.size() + cv::Size(2 * frame), 0);
  cv::compare(labels(bounds), value, inside(cv::Rect(frame, bounds.size())), cv::CMP_EQ);
  std::vector<std::vector<cv::Point>> contours;
  cv::findContours(inside, contours, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
  std::stable_sort(contours.begin(), contours.end(),
                   [](const auto& a, const auto& b) { return a.size() > b.size(); });
  std::vector<EdgePoint> edge;
  for (const std::vector<cv::Point>& contour : contours) {
    if (contour.size() < kMinContour_px) break;
    for (std::size_t k = 0; k < contour.size(); k += static_cast<std::size_t>(config.step_px)) {
      const cv::Point sum = Outward(inside, contour[k]);
      if (sum.x == 0 && sum.y == 0) continue;
      const cv::Point at = contour[k] + bounds.tl() - frame;
      const auto i = static_cast<std::size_t>(grid.Index(at.x, at.y));
      const double z = 1.0 / static_cast<double>(grid.q[i]);
      EdgePoint point;
      point.p_c = {static_cast<double>(grid.x[i]) * z, static_cast<double>(grid.y[i]) * z, z};
      point.u_px = {at.x, at.y};
      point.kind = KindBeyond(outside, at, {sum.x, sum.y}, point.step_sigmas);
      edge.push_back(point);
    }
  }
  return edge;
}

}  // namespace slam
