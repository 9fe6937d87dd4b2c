#include "sim/families/keycaps.h"

#include <algorithm>
#include <cmath>

#include "sim/base/angle.h"
#include "sim/families/recipe.h"
#include "sim/scene/geometry.h"

namespace sim {
namespace {

constexpr double kPitch_m = 0.01905;  ///< from key to key: 3/4 inch
constexpr double kGap_m = 0.003;      ///< between caps

/// A block of keys stands on a keyboard's base and is detected with it.
bool IsBlock(const Object& object, const Scene& scene) {
  if (object.class_name != "keyboard" || object.detection_group == 0) return false;
  const auto base = std::find_if(
      scene.objects.begin(), scene.objects.end(),
      [&](const Object& other) { return other.detection_group == object.detection_group; });
  return base->id != object.id;
}

int Keys(double length_m) {
  return std::max(1, static_cast<int>(std::lround(length_m / kPitch_m)));
}

/// The cap in column i and row j of the block.
Object Cap(const Object& block, int i, int j) {
  const int columns = Keys(block.size.x()), rows = Keys(block.size.y());
  const double across = block.size.x() / columns, along = block.size.y() / rows;
  Object cap = block;
  cap.role = Role::kOther;
  // Inwards to the micrometre, so that no cap leaves its block.
  cap.size = {std::floor((across - kGap_m) * 1e6) / 1e6,
              std::floor((along - kGap_m) * 1e6) / 1e6, block.size.z()};
  const Eigen::Vector3d at((i + 0.5) * across - block.size.x() / 2,
                           (j + 0.5) * along - block.size.y() / 2, 0);
  cap.center_w = (ObjectPose(block) * at).unaryExpr(&Rounded);
  for (Material& face : cap.faces) {
    face.print = Print::kPlain;
    face.seed += static_cast<std::uint64_t>(16 * (columns * j + i));
  }
  cap.faces[static_cast<std::size_t>(Face::kPlusZ)].print = Print::kText;
  return cap;
}

}  // namespace

void PutKeycaps(Scene& scene) {
  std::vector<Object> more;
  int next_id = static_cast<int>(scene.objects.size()) + 1;
  const Scene before = scene;
  for (Object& object : scene.objects) {
    if (!IsBlock(object, before)) continue;
    const Object block = object;
    for (int j = 0; j < Keys(block.size.y()); ++j) {
      for (int i = 0; i < Keys(block.size.x()); ++i) {
        Object cap = Cap(block, i, j);
        if (i == 0 && j == 0) {  // takes the block's place and id
          cap.name = block.name + "_key_1";
          object = cap;
          continue;
        }
        cap.id = next_id++;
        cap.name = block.name + "_key_" + std::to_string(Keys(block.size.x()) * j + i + 1);
        more.push_back(cap);
      }
    }
  }
  scene.objects.insert(scene.objects.end(), more.begin(), more.end());
}

}  // namespace sim
