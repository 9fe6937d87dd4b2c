#include "slam/segment/measured_segments.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

namespace slam {
namespace {

std::optional<Segment> Measure(const PlaneSums& sums, int id, const DepthNoise& noise,
                               const PlaneExtractionConfig& config) {
  const std::optional<PlaneFit> fit = Fit(sums);
  if (!fit) return std::nullopt;
  const double grazing = GrazingFactor(sums, fit->plane, noise);
  // Its pixels may scatter by more than noise does; then the plane is less sure.
  constexpr double kParameters = 3.0;  // degrees of freedom of a plane
  const double dof = std::max(sums.n - kParameters, 1.0);
  const double scale = std::max(grazing, std::sqrt(fit->error / dof));
  const PlaneSigmas sigmas = Sigmas(sums, fit->plane, noise, scale);
  if (!(sigmas.angle_rad < config.max_angle_sigma_rad)) return std::nullopt;
  return Segment{id, sums, {fit->plane, grazing}, sigmas, {}};
}

/// Side of the square of pixels that share an error because the sensor measures them together.
/// Triangulation matches windows. Time of flight measures each pixel by itself; what its pixels
/// share is a wave over the distance.
double SideOfSharedError_px(const SensorModel& sensor) {
  return sensor.sensor == DepthSensor::kAzure ? 1.0 : std::sqrt(sensor.noise.correlated_px);
}

}  // namespace

std::vector<Segment> KeepMeasured(const PartSegments& segments, const SensorModel& sensor,
                                  const PlaneExtractionConfig& config) {
  const std::vector<int> perimeters = CountContacts(segments.runs, segments.sums.size()).around;
  const auto height = static_cast<double>(segments.runs.rows.size() - 1);
  const double min_pixels = config.min_share * segments.runs.width * height;
  const double min_width_px = SideOfSharedError_px(sensor);  // across less, noise is one number
  std::vector<Segment> kept;
  for (std::size_t k = 0; k < perimeters.size(); ++k) {
    const PlaneSums& sums = segments.sums[k];
    if (sums.n < min_pixels) continue;
    if (2.0 * sums.n < min_width_px * perimeters[k]) continue;  // a strip has two long sides
    if (const auto segment = Measure(sums, static_cast<int>(k), sensor.noise, config))
      kept.push_back(*segment);
  }
  std::sort(kept.begin(), kept.end(), [](const Segment& a, const Segment& b) {
    return a.sums.n != b.sums.n ? a.sums.n > b.sums.n : a.id < b.id;
  });
  if (kept.size() > static_cast<std::size_t>(kMaxSegments)) kept.resize(kMaxSegments);
  return kept;
}

}  // namespace slam
