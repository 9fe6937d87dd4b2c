#include "slam/segment/measured_segments.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace slam {
namespace {

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

}  // namespace

void KeepMeasured(const std::vector<PlaneSums>& sums, const DepthNoise& noise,
                  const PlaneExtractionConfig& config, std::vector<Segment>& kept) {
  kept.clear();
  for (std::size_t k = 0; k < sums.size(); ++k) {
    if (const std::optional<Segment> segment =
            Measure(sums[k], static_cast<int>(k), noise, config))
      kept.push_back(*segment);
  }
  std::sort(kept.begin(), kept.end(), [](const Segment& a, const Segment& b) {
    return a.sums.n != b.sums.n ? a.sums.n > b.sums.n : a.id < b.id;
  });
  if (kept.size() > static_cast<std::size_t>(kMaxSegments)) kept.resize(kMaxSegments);
}

PlaneSums Without(PlaneSums all, const PlaneSums& part) {
  all.n -= part.n, all.w -= part.w, all.wx -= part.wx, all.wy -= part.wy, all.wxx -= part.wxx,
      all.wxy -= part.wxy;
  all.wyy -= part.wyy, all.wq -= part.wq, all.wqx -= part.wqx, all.wqy -= part.wqy,
      all.wqq -= part.wqq;
  return all;
}

}  // namespace slam
