#include "sim/families/recipe.h"

#include <algorithm>
#include <cmath>

#include "sim/base/angle.h"

namespace sim {
namespace {

std::string FreshName(const Scene& scene, const std::string& class_name) {
  std::string base = class_name;
  std::replace(base.begin(), base.end(), ' ', '_');
  const auto taken = [&](const std::string& name) {
    return std::any_of(scene.objects.begin(), scene.objects.end(),
                       [&](const Object& object) { return object.name == name; });
  };
  int number = 1;
  while (taken(base + "_" + std::to_string(number))) ++number;
  return base + "_" + std::to_string(number);
}

}  // namespace

int NextGroup(const Scene& scene) {
  int group = 0;
  for (const Object& object : scene.objects) group = std::max(group, object.detection_group);
  return group + 1;
}

double Rounded(double number) { return std::round(number * 1e6) / 1e6 + 0.0; }

double DrawLength(Random& random, double low_m, double high_m) {
  return Rounded(std::round(random.Between(low_m, high_m) * 1e4) / 1e4);
}

Part BoxPart(const std::string& class_name, const Eigen::Vector3d& size, double x, double y,
             double bottom_z) {
  Part part;
  part.object.class_name = class_name;
  part.object.role = Role::kRegular;
  part.object.size = size;
  part.object.center_w = {x, y, bottom_z + size.z() / 2};
  return part;
}

void Put(const Item& item, const Place& place, Scene& scene) {
  const SinCos yaw = SinCosDeg(place.yaw_deg);
  const int group = item.one_detection ? NextGroup(scene) : 0;
  for (const Part& part : item.parts) {
    Object object = part.object;
    const Eigen::Vector3d& at = part.object.center_w;
    object.id = static_cast<int>(scene.objects.size()) + 1;
    object.name = FreshName(scene, object.class_name);
    object.center_w = {Rounded(place.x + yaw.cos * at.x() - yaw.sin * at.y()),
                       Rounded(place.y + yaw.sin * at.x() + yaw.cos * at.y()),
                       Rounded(place.z + at.z())};
    object.q_wo = QuaternionFromRpyDeg(
        {part.rpy_deg.x(), part.rpy_deg.y(), Rounded(part.rpy_deg.z() + place.yaw_deg)});
    object.detection_group = group;
    scene.objects.push_back(object);
  }
}

Object NextObject(const Scene& scene, const std::string& name, const std::string& class_name,
                  Role role) {
  Object object;
  object.id = static_cast<int>(scene.objects.size()) + 1;
  object.name = name;
  object.class_name = class_name;
  object.role = role;
  return object;
}

void PutStructure(const std::string& name, const std::string& class_name,
                  const Eigen::Vector3d& size, const Eigen::Vector3d& center_w,
                  const Material& material, Scene& scene) {
  Object object = NextObject(scene, name, class_name, Role::kStructure);
  object.size = size;
  object.center_w = center_w.unaryExpr(&Rounded);
  object.faces.fill(material);
  scene.objects.push_back(object);
}

}  // namespace sim
