#include "slam/segment/map_split.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace slam {
namespace {

constexpr double kCertain = 3.0;  // standard deviations that agreement may be off by
// Independent errors that vote on a pixel: the fewer, the finer the outline.
constexpr double kLeastVotes = 3.0, kMostVotes = 30.0;
constexpr double kSureVote = 4.0;  // standard deviations of a vote that a step must have

/// Distance from a plane of the point that a ray (x, y, 1) meets at an inverse depth.
double Off(const Plane& pi_c, const Eigen::Vector3d& ray, double q) {
  return SignedDistance(pi_c, ray / q);
}

Eigen::Vector3d MeanRay(const PlaneSums& sums) {
  return {sums.wx / sums.w, sums.wy / sums.w, 1.0};
}

double InverseDepth(const InverseDepthPlane& plane, const Eigen::Vector3d& ray) {
  return plane.InverseDepth(ray.x(), ray.y());
}

cv::Rect Widened(const cv::Rect& r, int by, const cv::Size& image) {
  return cv::Rect(r.x - by, r.y - by, r.width + 2 * by, r.height + 2 * by) &
         cv::Rect(0, 0, image.width, image.height);
}

}  // namespace

PlaneSums MapSplit::SumIn(const DepthGrid& grid, const cv::Mat1b& labels, int host,
                          const Segment& segment, const PixelArea& area) const {
  PlaneSums sums;
  const int last_row = area.top + static_cast<int>(area.spans.size()) - 1;
  for (int v = std::max(area.top, segment.low.y); v <= std::min(last_row, segment.high.y);
       ++v) {
    const auto [first, end] = area.spans[static_cast<std::size_t>(v - area.top)];
    for (int u = std::max(first, segment.low.x); u < std::min(end, segment.high.x + 1); ++u) {
      if (labels(v, u) != host + 1) continue;
      const auto i = static_cast<std::size_t>(grid.Index(u, v));
      const double g = static_cast<double>(grid.g[i]);
      sums.Add(static_cast<double>(grid.x[i]), static_cast<double>(grid.y[i]),
               static_cast<double>(grid.q[i]), g * g);
    }
  }
  return sums;
}

/// Elects the pixels that are nearer to `sought` than to the pixels outside, as far apart as
/// `sought` and `other`, and asks whether they are what the map says.
bool MapSplit::Elect(const DepthGrid& grid, const cv::Mat1b& labels, int host,
                     const Segment& outside, const PlaneSums& inside, const Plane& sought_c,
                     const Plane& other_c, const PlaneExtractionConfig& config) {
  const MapSplitConfig& rules = config.map_split;
  const InverseDepthPlane sought = SeenAlongRays(sought_c), other = SeenAlongRays(other_c);
  const Eigen::Vector3d middle = MeanRay(inside);
  const double weight = std::sqrt(inside.w / inside.n) / outside.plane.grazing;
  const double step = (InverseDepth(sought, middle) - InverseDepth(other, middle)) * weight;
  const double votes = kSureVote * kSureVote / (step * step);
  if (!(votes < kMostVotes)) return false;
  // The segment's pixels are that near to its plane.
  if (std::abs(step) > 2.0 * config.growth.max_pixel_sigmas) return false;
  const double window_px = std::max(votes, kLeastVotes) * config.noise.correlated_px;
  region_.Elect(
      grid, labels, {static_cast<std::uint8_t>(host + 1), outside.plane, 0.0, step, window_px},
      Widened(around_.Bounds(), ElectedRegion::Reach(window_px), labels.size()), around_);
  if (static_cast<int>(region_.pixels().size()) < config.min_pixels) return false;

  const PlaneSums found = region_.Sum(grid);
  const std::optional<PlaneFit> fit = Fit(found);
  if (!fit) return false;
  const Eigen::Vector3d ray = MeanRay(found);
  const double q = found.wq / found.w, q_outside = InverseDepth(outside.plane.plane, ray);
  if (!(q_outside > 0.0)) return false;
  const double scale =
      std::max(outside.plane.grazing, std::sqrt(fit->error / std::max(found.n - 3.0, 1.0)));
  const double sigma_q = std::sqrt(scale * scale * config.noise.correlated_px / found.w +
                                   ray.dot(outside.sigmas.covariance * ray));
  if (!(std::abs(q - q_outside) > rules.min_evidence_sigmas * sigma_q)) return false;
  const double off_m = Off(sought_c, ray, q), other_off_m = Off(other_c, ray, q_outside);
  const double sigma_m = sought_c.d / q * sigma_q;
  return std::abs(off_m - other_off_m) < kCertain * std::hypot(sigma_m, rules.map_sigma_m);
}

bool MapSplit::Find(const DepthGrid& grid, const cv::Mat1b& labels, int host,
                    const Segment& segment, const std::vector<ExpectedPlane>& all,
                    std::size_t expected, const PlaneExtractionConfig& config) {
  const ExpectedPlane& sought = all[expected];
  SetConvex(sought.outline_px, -sought.margin_px, labels.size(), core_);
  SetConvex(sought.outline_px, sought.margin_px, labels.size(), around_);
  const PlaneSums inside = SumIn(grid, labels, host, segment, core_);
  if (!(inside.n >= 0.5 * config.min_pixels)) return false;
  const std::optional<Segment> outside =
      Measure(Without(segment.sums, SumIn(grid, labels, host, segment, around_)), 0, config);
  if (!outside) return false;
  const Plane outside_c = outside->plane.plane.Hessian();
  const auto is_parallel = [&](const Plane& pi_c) {
    return Angle(outside_c.n, pi_c.n) < config.map_split.max_angle_rad;
  };
  if (!is_parallel(sought.pi_c)) return false;
  const Eigen::Vector3d middle = MeanRay(inside);
  const double q_outside = InverseDepth(outside->plane.plane, middle);
  if (!(q_outside > 0.0)) return false;
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (k == expected || !is_parallel(all[k].pi_c)) continue;
    if (!(std::abs(Off(all[k].pi_c, middle, q_outside)) <
          kCertain * config.map_split.pose_sigma_m))
      continue;
    if (Elect(grid, labels, host, *outside, inside, sought.pi_c, all[k].pi_c, config))
      return true;
  }
  return false;
}

std::array<int, 256> CountLabels(const cv::Mat1b& labels, const PixelArea& area) {
  constexpr int kStep_px = 4;
  std::array<int, 256> pixels{};
  for (std::size_t row = 0; row < area.spans.size(); row += kStep_px) {
    const auto [first, end] = area.spans[row];
    const std::uint8_t* label = labels[area.top + static_cast<int>(row)];
    for (int u = first; u < end; u += kStep_px) pixels[label[u]] += kStep_px * kStep_px;
  }
  return pixels;
}

}  // namespace slam
