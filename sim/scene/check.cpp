#include "sim/scene/check.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "sim/scene/geometry.h"
#include "sim/scene/number_text.h"

namespace sim {
namespace {

std::string Millimetres(double length_m) {
  return NumberText(std::round(length_m * 1e4) / 10) + " mm";
}

double Lowest(const Object& object) {
  double z = object.center_w.z();
  for (const Eigen::Vector3d& corner : Corners(object)) z = std::min(z, corner.z());
  return z;
}

double Highest(const Object& object) {
  double z = object.center_w.z();
  for (const Eigen::Vector3d& corner : Corners(object)) z = std::max(z, corner.z());
  return z;
}

std::optional<std::string> RepeatedName(const Scene& scene, std::size_t i) {
  const Object& object = scene.objects[i];
  for (std::size_t j = 0; j < i; ++j) {
    const Object& earlier = scene.objects[j];
    if (earlier.id == object.id) {
      return "id " + std::to_string(object.id) + " belongs to '" + earlier.name +
             "' already; give each object its own";
    }
    if (earlier.name == object.name) {
      return "name '" + object.name + "' is taken already; give each object its own";
    }
  }
  return std::nullopt;
}

}  // namespace

std::optional<SceneFault> FindFault(const Scene& scene) {
  double floor_z = 0;
  for (const Object& object : scene.objects) {
    if (object.class_name == "floor") floor_z = Highest(object);
  }
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    const Object& object = scene.objects[i];
    if (const auto repeated = RepeatedName(scene, i)) return SceneFault{i, *repeated};
    const double below = floor_z - Lowest(object);
    if (object.class_name != "floor" && !(below <= kTouch_m)) {
      return SceneFault{i, "'" + object.name + "' reaches " + Millimetres(below) +
                               " below the floor; raise center_m"};
    }
    for (std::size_t j = 0; j < i; ++j) {
      const Object& other = scene.objects[j];
      const double reach = (object.size.norm() + other.size.norm()) / 2;
      if ((object.center_w - other.center_w).squaredNorm() > reach * reach) continue;
      const double depth = OverlapDepth(object, other);
      if (depth <= kTouch_m) continue;
      return SceneFault{i, "'" + object.name + "' and '" + other.name + "' are " +
                               Millimetres(depth) + " inside each other; move one apart"};
    }
  }
  return std::nullopt;
}

}  // namespace sim
