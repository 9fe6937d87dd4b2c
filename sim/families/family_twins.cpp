#include <algorithm>

#include "io/input_error.h"
#include "sim/base/angle.h"
#include "sim/families/filling.h"
#include "sim/families/furniture.h"

namespace sim {
namespace {

constexpr std::uint64_t kTwinsKey = 0x7477696e, kRevisitKey = 0x72657669;

Eigen::Vector3d Point(double x, double y, double z) {
  return Eigen::Vector3d(x, y, z).unaryExpr(&Rounded);
}

/// Along both desks and back, a little further away.
std::vector<Station> ThereAndBack(double half_x, const Table& table) {
  constexpr int kEach = 5;
  const double front = -table.depth / 2 - 0.35;
  std::vector<Station> stations;
  for (const int way : {1, -1}) {
    for (int i = 0; i < kEach; ++i) {
      const double x = way * half_x * (2.0 * i / (kEach - 1) - 1);
      const double back = way > 0 ? 0 : 0.2;
      stations.push_back({Point(x, front - back, table.top_z + 0.50 + back / 2),
                          Point(x * 1.02, way > 0 ? 0.05 : -0.05, table.top_z)});
    }
  }
  return stations;
}

}  // namespace

Scene MakeTwins(std::uint64_t seed, const ParameterValues& values) {
  Random random({kTwinsKey, seed});
  Scene scene;
  const double apart = values.at("apart_m");
  const double half_room = Rounded(apart / 2 + 1.6);
  PutRoom({-half_room, -2.6}, {half_room, 0.5}, Print::kSpeckle, random, scene);
  Table table;
  table.width = 1.5;
  table.depth = 0.8;
  table.top_z = DrawLength(random, .70, .76);
  table.center.x() = Rounded(-apart / 2);
  const Material wood = DrawMaterial(Print::kWood, random);
  Table other = table;
  other.center.x() = Rounded(apart / 2);
  PutTable("desk_a", table, wood, scene);
  PutTable("desk_b", other, wood, scene);

  const auto missing = static_cast<std::size_t>(values.at("missing"));
  for (std::uint64_t attempt = 0;; ++attempt) {
    if (attempt == 200) throw io::InputError("family twins", "no room on the desks");
    Random things({kTwinsKey, seed, 1, attempt});
    std::vector<Wish> wishes = DrawClutter(8, things);
    // The same draws put what both desks have in the same places.
    Random first({kTwinsKey, seed, 2, attempt}), second({kTwinsKey, seed, 2, attempt});
    Scene filled = scene;
    if (!FillTable(wishes, table, first, filled)) continue;
    wishes.resize(wishes.size() - std::min(missing, wishes.size()));
    if (!FillTable(wishes, other, second, filled)) continue;
    scene = filled;
    break;
  }
  scene.motion.preset = "loop";
  scene.motion.target_w = {0, 0, table.top_z};
  scene.motion.stations = ThereAndBack(Rounded(apart / 2 + 0.2), table);
  return scene;
}

Scene MakeRevisit(std::uint64_t seed, const ParameterValues& values) {
  Scene scene = MakeDesk(seed, {{"objects", values.at("objects")}});
  const auto named = [&](const char* name) -> const Object& {
    return *std::find_if(scene.objects.begin(), scene.objects.end(),
                         [&](const Object& object) { return object.name == name; });
  };
  const double open = named("wall_side").center_w.x() > 0 ? -1 : 1;
  const double top = scene.motion.target_w.z();
  const double front = -named("desk").size.y() / 2;
  Random random({kRevisitKey, seed});
  const Place away{open * 2.6, -1.3, 0, open > 0 ? -90.0 : 90.0};
  const Eigen::Vector3d shelf(1.0, 0.28, 1.6);
  Put(MakeShelf(shelf, 4, random), away, scene);
  Put(MakeShelfBooks(shelf, 4, random), away, scene);

  // The floor and the wall behind reach past the shelf, where the camera looks.
  for (Object& object : scene.objects) {
    if (object.name != "floor" && object.name != "wall_back") continue;
    object.size.x() = 10;
    object.center_w.x() = Rounded(open * 2);
  }
  PutStructure("wall_far", "wall", {0.1, 6, 2.5},
               {open * (2.6 + 0.5), named("floor").center_w.y(), 1.25},
               DrawMaterial(Print::kSpeckle, random), scene);

  Motion& motion = scene.motion;
  motion.preset = "loop";
  motion.turn_deg_s = 18;
  const auto at = [&](double x, double y, double z, double to_x, double to_y, double to_z) {
    motion.stations.push_back(
        {Point(open * x, front + y, top + z), Point(open * to_x, front + to_y, top + to_z)});
  };
  at(-0.30, -0.40, 0.50, -0.20, 0.35, 0.00);
  at(-0.10, -0.45, 0.52, -0.05, 0.35, 0.00);
  at(0.15, -0.50, 0.52, 0.15, 0.35, 0.00);
  at(0.40, -0.60, 0.55, 0.70, 0.25, 0.00);
  at(0.75, -0.80, 0.60, 1.60, -0.30, 0.10);
  at(1.00, -0.95, 0.60, 2.20, -0.80, 0.20);
  at(1.05, -1.10, 0.60, 2.25, -1.15, 0.20);
  at(0.90, -1.20, 0.60, 1.95, -1.80, 0.10);
  at(0.70, -1.20, 0.60, 1.90, -1.40, 0.10);
  at(0.50, -1.00, 0.55, 1.50, -0.40, 0.05);
  at(0.25, -0.75, 0.52, 0.70, 0.20, 0.00);
  at(-0.10, -0.50, 0.50, 0.00, 0.35, 0.00);
  return scene;
}

}  // namespace sim
