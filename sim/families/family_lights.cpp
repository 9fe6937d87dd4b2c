#include <algorithm>

#include "sim/families/recipe.h"

namespace sim {
namespace {

constexpr std::uint64_t kLightsKey = 0x6c696768;

/// A bulb in the shade of a desk lamp: warm, and 0.9 times the light of a sun of 1 at 0.3 m.
Light Bulb(const Object& shade) {
  Light light;
  light.center_w = shade.center_w;
  light.intensity = 0.08;
  light.colour = {1, 0.82, 0.6};
  return light;
}

/// A panel of 0.6 x 0.2 m that hangs over what the camera looks at.
Light Panel(const Eigen::Vector3d& over_w, Random& random) {
  Light light;
  light.kind = LightKind::kArea;
  const double x = DrawLength(random, -0.4, 0.4), y = DrawLength(random, -0.3, 0.3);
  const Eigen::Vector3d at = over_w + Eigen::Vector3d(x, y, DrawLength(random, 1.1, 1.4));
  light.center_w = at.unaryExpr(&Rounded);
  light.half_a_w = {0.3, 0, 0};
  light.half_b_w = {0, -0.1, 0};
  light.intensity = 0.6;
  return light;
}

bool IsShade(const Object& object) {
  return object.class_name == "lamp" && object.shape == ShapeKind::kBowl;
}

}  // namespace

void PutLights(int count, std::uint64_t seed, Scene& scene) {
  Random random({kLightsKey, seed});
  const auto wanted = static_cast<std::size_t>(count);
  for (const Object& object : scene.objects) {
    if (scene.lights.size() < wanted && IsShade(object)) scene.lights.push_back(Bulb(object));
  }
  while (scene.lights.size() < wanted) {
    scene.lights.push_back(Panel(scene.motion.target_w, random));
  }
}

}  // namespace sim
