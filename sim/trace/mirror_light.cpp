#include "sim/trace/mirror_light.h"

#include <cmath>
#include <numbers>

#include "sim/scene/surface_light.h"

namespace sim {
namespace {

/// our choice: between clear glass, which mirrors a lamp's shape, and a matt display
constexpr double kHaze_rad = 0.1;

/// Light of a unit from one direction as it is mirrored `cosine` beside it: (1 + a^2/w^2)^-2 / w^2,
/// a the angle, in units of what a white matt face would send; its integral over directions is pi.
double HazeLobe(double cosine, double width2) {
  const double fall = 1.0 + 2.0 * (1.0 - cosine) / width2;
  return 1.0 / (width2 * fall * fall);
}

/// What a lamp sends to the spot, mirrored. A rectangle widens the lobe by its own size.
double MirroredLamp(const Light& light, const MirrorSpot& spot, const Eigen::Vector3d& way_w) {
  const Eigen::Vector3d to_light = light.center_w - spot.x_w;
  const double r2 = to_light.squaredNorm();
  const Eigen::Vector3d ray = to_light / std::sqrt(r2);
  double intensity = light.intensity / r2, width2 = kHaze_rad * kHaze_rad;
  if (light.kind == LightKind::kArea) {
    const Eigen::Vector3d front = light.half_a_w.cross(light.half_b_w);
    intensity *= std::max(0.0, -front.normalized().dot(ray));
    width2 += 4.0 * front.norm() / (std::numbers::pi * r2);
  }
  return intensity * HazeLobe(way_w.dot(ray), width2);
}

}  // namespace

cv::Vec3f MirrorLight(const Scene& scene, const Eigen::Vector3d& to_sun_w,
                      const MirrorSpot& spot) {
  const double along = spot.look_w.dot(spot.n_w);
  const Eigen::Vector3d way_w = spot.look_w - 2.0 * along * spot.n_w;
  // The room: as bright as its ambient light in the mean, the ceiling more than the floor.
  double white = scene.sun.ambient * (1.0 + way_w.z());
  if (spot.sunlit) {
    white += scene.sun.intensity * HazeLobe(way_w.dot(to_sun_w), kHaze_rad * kHaze_rad);
  }
  Eigen::Vector3d sum = Eigen::Vector3d::Constant(white);
  for (std::size_t k = 0; k < scene.lights.size(); ++k) {
    if ((spot.lights_seen >> k & 1u) == 0) continue;
    const Light& light = scene.lights[k];
    sum += MirroredLamp(light, spot, way_w) *
           Eigen::Vector3d(light.colour[0], light.colour[1], light.colour[2]);
  }
  sum *= GlassReflection(std::abs(along));
  return cv::Vec3f(static_cast<float>(sum[0]), static_cast<float>(sum[1]),
                   static_cast<float>(sum[2]));
}

}  // namespace sim
