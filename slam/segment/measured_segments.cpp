#include "slam/segment/measured_segments.h"

#include <algorithm>
#include <cmath>

namespace slam {

std::optional<Segment> Measure(const PlaneSums& sums, int id, const DepthNoise& noise,
                               const PlaneExtractionConfig& config) {
  if (!(sums.n >= config.min_pixels)) return std::nullopt;
  const std::optional<PlaneFit> fit = Fit(sums);
  if (!fit) return std::nullopt;
  const double grazing = GrazingFactor(sums, fit->plane, noise);
  // Its pixels may scatter by more than noise does; then the plane is less sure.
  constexpr double kParameters = 3.0;  // degrees of freedom of a plane
  const double dof = std::max(sums.n - kParameters, 1.0);
  const double scale = std::max(grazing, std::sqrt(fit->error / dof));
  const PlaneSigmas sigmas = Sigmas(sums, fit->plane, noise, scale);
  if (!(sigmas.angle_rad < config.max_angle_sigma_rad)) return std::nullopt;
  return Segment{id, sums, {fit->plane, grazing}, sigmas, {}, {}};
}

void SortBySize(std::vector<Segment>& segments) {
  std::sort(segments.begin(), segments.end(), [](const Segment& a, const Segment& b) {
    return a.sums.n != b.sums.n ? a.sums.n > b.sums.n : a.id < b.id;
  });
}

void KeepMeasured(const std::vector<PlaneSums>& sums, const DepthNoise& noise,
                  const PlaneExtractionConfig& config, std::vector<Segment>& kept) {
  kept.clear();
  for (std::size_t k = 0; k < sums.size(); ++k) {
    if (const std::optional<Segment> segment =
            Measure(sums[k], static_cast<int>(k), noise, config))
      kept.push_back(*segment);
  }
  SortBySize(kept);
  if (kept.size() > static_cast<std::size_t>(kMaxSegments)) kept.resize(kMaxSegments);
}

PlaneSums Without(PlaneSums all, const PlaneSums& part) {
  all.n -= part.n, all.w -= part.w, all.wx -= part.wx, all.wy -= part.wy, all.wxx -= part.wxx,
      all.wxy -= part.wxy;
  all.wyy -= part.wyy, all.wq -= part.wq, all.wqx -= part.wqx, all.wqy -= part.wqy,
      all.wqq -= part.wqq;
  return all;
}

void Extend(const PlaneSums& more, const cv::Point& low, const cv::Point& high,
            const DepthNoise& noise, const PlaneExtractionConfig& config, Segment& segment) {
  PlaneSums sums = segment.sums;
  sums += more;
  const std::optional<Segment> both = Measure(sums, segment.id, noise, config);
  if (!both) return;
  const cv::Point old_low = segment.low, old_high = segment.high;
  segment = *both;
  segment.low = {std::min(old_low.x, low.x), std::min(old_low.y, low.y)};
  segment.high = {std::max(old_high.x, high.x), std::max(old_high.y, high.y)};
}

}  // namespace slam
