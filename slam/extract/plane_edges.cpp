#include "slam/extract/plane_edges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <opencv2/imgproc.hpp>

namespace slam {
namespace {

constexpr std::size_t kLeastContour = 8;  // pixels; shorter ones bound specks

/// Direction from a boundary pixel to the outside: the mean of its outside neighbours.
Eigen::Vector2d Outward(const cv::Mat1b& labels, int value, const cv::Point& at) {
  int sum_u = 0, sum_v = 0;
  if (at.x >= 2 && at.y >= 2 && at.x + 2 < labels.cols && at.y + 2 < labels.rows) {
    for (int dv = -2; dv <= 2; ++dv) {
      const std::uint8_t* row = labels[at.y + dv] + at.x;
      for (int du = -2; du <= 2; ++du) {
        const int outside = row[du] != value ? 1 : 0;
        sum_u += outside * du, sum_v += outside * dv;
      }
    }
    return Eigen::Vector2d(sum_u, sum_v);
  }
  for (int dv = -2; dv <= 2; ++dv) {
    for (int du = -2; du <= 2; ++du) {
      const int u = at.x + du, v = at.y + dv;
      const bool inside = u >= 0 && v >= 0 && u < labels.cols && v < labels.rows;
      if (!inside || labels(v, u) != value) sum_u += du, sum_v += dv;
    }
  }
  return Eigen::Vector2d(sum_u, sum_v);
}

EdgeKind KindBeyond(const DepthGrid& grid, const cv::Point& at, const Eigen::Vector2d& outward,
                    const LabelPlane& plane, const EdgeConfig& config) {
  const Eigen::Vector2d step = outward / outward.cwiseAbs().maxCoeff();
  const float least_step = static_cast<float>(config.min_step_sigmas);
  float first = 0, last = 0;
  int measured = 0;
  for (int k = 1; k <= std::max(config.reach_px, config.shadow_px); ++k) {
    if (k > config.reach_px && measured > 0) break;
    const int u = at.x + static_cast<int>(std::lround(k * step.x()));
    const int v = at.y + static_cast<int>(std::lround(k * step.y()));
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

std::vector<EdgePoint> TraceEdges(const DepthGrid& grid, const cv::Mat1b& labels, int value,
                                  const cv::Rect& bounds, const LabelPlane& plane,
                                  const EdgeConfig& config) {
  // findContours leaves out the outermost rows and columns: give the mask a frame of zeros.
  cv::Mat1b mask(bounds.height + 2, bounds.width + 2, static_cast<std::uint8_t>(0));
  cv::Mat inner = mask(cv::Rect(1, 1, bounds.width, bounds.height));
  cv::compare(labels(bounds), value, inner, cv::CMP_EQ);
  std::vector<std::vector<cv::Point>> contours;
  cv::findContours(mask, contours, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE,
                   bounds.tl() - cv::Point(1, 1));
  std::stable_sort(contours.begin(), contours.end(),
                   [](const auto& a, const auto& b) { return a.size() > b.size(); });
  std::vector<EdgePoint> edge;
  for (const std::vector<cv::Point>& contour : contours) {
    if (contour.size() < kLeastContour) continue;
    for (std::size_t k = 0; k < contour.size(); k += static_cast<std::size_t>(config.step_px)) {
      const cv::Point& at = contour[k];
      const Eigen::Vector2d outward = Outward(labels, value, at);
      if (!(outward.squaredNorm() > 0)) continue;
      const auto i = static_cast<std::size_t>(grid.Index(at.x, at.y));
      const double z = 1.0 / static_cast<double>(grid.q[i]);
      edge.push_back({Eigen::Vector3d(static_cast<double>(grid.x[i]) * z,
                                      static_cast<double>(grid.y[i]) * z, z),
                      Eigen::Vector2d(at.x, at.y),
                      KindBeyond(grid, at, outward, plane, config)});
    }
  }
  return edge;
}

}  // namespace slam
