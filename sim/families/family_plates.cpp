#include <algorithm>

#include "sim/base/angle.h"
#include "sim/families/recipe.h"

namespace sim {
namespace {

constexpr std::uint64_t kPlatesKey = 0x706c6174;
constexpr double kFloor_m = 4;

void PutFloor(Random& random, Scene& scene) {
  PutStructure("floor", "floor", {kFloor_m, kFloor_m, 0.1}, {0, 0, -0.05},
               DrawMaterial(Print::kWood, random), scene);
}

void AimAt(double z, Scene& scene) {
  scene.motion.target_w = {0, 0, Rounded(z)};
  scene.motion.target_spread_m = 0.15;
}

}  // namespace

Scene MakePlates(std::uint64_t seed, const ParameterValues& values) {
  Random random({kPlatesKey, seed});
  Scene scene;
  PutFloor(random, scene);
  const double gap = values.at("gap_mm") / 1000, side = values.at("side_mm") / 1000;
  const double low = values.at("thickness_mm") / 1000;
  const double high = low + values.at("step_mm") / 1000;
  const double tilt_deg = values.at("tilt_deg");

  Item boards;
  boards.parts.push_back(BoxPart("book", {side, side, low}, -(gap + side) / 2, 0, 0));
  // Tilted about its upper edge at the gap, whose height keeps the step; the far edge rises.
  Part board = BoxPart("book", {side, side, high}, 0, 0, 0);
  const SinCos tilt = SinCosDeg(tilt_deg);
  const Eigen::Vector3d along(tilt.cos, 0, tilt.sin), normal(-tilt.sin, 0, tilt.cos);
  board.object.center_w =
      Eigen::Vector3d(gap / 2, 0, high) + along * side / 2 - normal * high / 2;
  board.rpy_deg.y() = -tilt_deg;
  boards.parts.push_back(board);
  for (Part& part : boards.parts) {
    part.object.size = part.object.size.unaryExpr(&Rounded);
    Dress(part.object, random);
  }
  Put(boards, {}, scene);
  AimAt(std::min(low, high), scene);
  return scene;
}

Scene MakeStack(std::uint64_t seed, const ParameterValues& values) {
  Random random({kPlatesKey, 1, seed});
  Scene scene;
  PutFloor(random, scene);
  const int count = static_cast<int>(values.at("count"));
  const double step = values.at("step_mm") / 1000, turn_deg = values.at("turn_deg");
  const SinCos turn = SinCosDeg(turn_deg);
  const double shrink = 0.995 / (turn.cos + 4.0 / 3.0 * turn.sin);  // stays on the one below
  Eigen::Vector2d base(0.30, 0.40);
  Item stack;
  for (int i = 0; i < count; ++i) {
    Part box =
        BoxPart("book", {Rounded(base.x()), Rounded(base.y()), Rounded(step)}, 0, 0, i * step);
    box.rpy_deg.z() = Rounded(i % 2 == 0 ? 0 : turn_deg);
    Dress(box.object, random);
    stack.parts.push_back(box);
    base *= shrink;
  }
  Put(stack, {0, 0, 0, Rounded(0.1 * random.Below(3600))}, scene);
  AimAt(count * step, scene);
  return scene;
}

}  // namespace sim
