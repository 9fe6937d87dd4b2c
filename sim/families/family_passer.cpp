#include <cmath>

#include "io/input_error.h"
#include "sim/base/angle.h"
#include "sim/families/filling.h"
#include "sim/scene/check.h"

namespace sim {
namespace {

constexpr std::uint64_t kPasserKey = 0x70617373;
constexpr double kFirst_s = 1.5;  ///< nothing moves before
constexpr double kStep_s = 0.2;   ///< between the points of a way

enum Kind { kDrawn, kWalker, kReachingHand, kCarriedToy };

Waypoint PointAt(double time_s, double x, double y, double z, double yaw_deg) {
  return {Rounded(time_s), Eigen::Vector3d(x, y, z).unaryExpr(&Rounded), Rounded(yaw_deg)};
}

/// From 0 to 1, slow at both ends.
double Eased(double part) { return part * part * (3 - 2 * part); }

void PutMoving(const std::string& name, const std::string& class_name, ShapeKind shape,
               const Eigen::Vector3d& size, const Material& material,
               const std::vector<Waypoint>& way, Scene& scene) {
  Object object = NextObject(scene, name, class_name, Role::kUnstructured);
  object.shape = shape;
  object.size = size.unaryExpr(&Rounded);
  object.faces.fill(material);
  object.seed = static_cast<std::uint64_t>(object.id);
  object.way = way;
  object.center_w = way.front().center_w;
  scene.objects.push_back(object);
}

/// To and fro behind the desk, with the bob of steps.
void PutWalker(const Table& table, int times, double speed_m_s, Random& random, Scene& scene) {
  const double height = DrawLength(random, 1.58, 1.90), depth = DrawLength(random, .42, .50),
               width = DrawLength(random, .54, .62);
  const Eigen::Vector3d size(width, depth, height);
  const double from = 2.0, y = table.depth / 2 + DrawLength(random, .40, .70);
  const double pace_s = 2 * from / speed_m_s;
  std::vector<Waypoint> way;
  double time_s = kFirst_s;
  for (int pass = 0; pass < times; ++pass) {
    const double sign = pass % 2 == 0 ? 1 : -1;
    const int steps = static_cast<int>(std::ceil(pace_s / kStep_s));
    for (int i = 0; i <= steps; ++i) {
      const double part = static_cast<double>(i) / steps;
      const double bob = 0.012 * (1 - SinCosDeg(360 * 1.9 * part * pace_s).cos);
      way.push_back(PointAt(time_s + part * pace_s, sign * from * (2 * part - 1), y,
                            size.z() / 2 + bob, 90 * sign));
    }
    time_s += pace_s + 1.0;  // turns outside of the view
  }
  PutMoving("passer", "person", ShapeKind::kPerson, size, DrawMaterial(Print::kCloth, random),
            way, scene);
}

/// Into the view from the side, a rest, out again; each time over another part of the desk.
std::vector<Waypoint> Reaches(const Table& table, int times, double speed_m_s, double height_m,
                              double side, double length_m, Random& random) {
  const double outside = table.width / 2 + length_m / 2 + 0.45;
  std::vector<Waypoint> way;
  double time_s = kFirst_s;
  for (int pass = 0; pass < times; ++pass) {
    const double y = table.depth * random.Between(-0.35, 0.0);
    const double reach = random.Between(0.0, 0.25) * table.width + length_m / 2;
    const double lift = random.Between(0.0, 0.06);
    const double lasts_s = (outside - reach) / speed_m_s;
    const int steps = static_cast<int>(std::ceil(lasts_s / kStep_s));
    const auto at = [&](double moment_s, double part) {
      const double x = outside + (reach - outside) * Eased(part);
      const double z = table.top_z + height_m + lift * (1 - part);
      way.push_back(PointAt(moment_s, side * x, y, z, 90 * side));
    };
    for (int i = 0; i <= steps; ++i) at(time_s + lasts_s * i / steps, double(i) / steps);
    time_s += lasts_s + 1.0;
    for (int i = 0; i <= steps; ++i) at(time_s + lasts_s * i / steps, 1 - double(i) / steps);
    time_s += lasts_s + 1.5;
  }
  return way;
}

/// A hand, or one that carries a toy. @returns false when something is in its way
bool PutHand(const Table& table, int times, double speed_m_s, bool toy, double height_m,
             Random& random, Scene& scene) {
  const double height = DrawLength(random, .11, .13), length = DrawLength(random, .50, .58),
               width = DrawLength(random, .12, .14);
  const Eigen::Vector3d size(width, length, height);
  const double side = random.Chance(0.5) ? 1 : -1;
  Scene filled = scene;
  std::vector<Waypoint> way =
      Reaches(table, times, speed_m_s, height_m, side, size.y(), random);
  const Material skin{
      Print::kSpeckle, {.62, .42, .32}, {.45, .28, .20}, 0.35, random.Bits() >> 32};
  PutMoving("passer", "person", ShapeKind::kHand, size, skin, way, filled);
  if (toy) {
    const double toy_height = DrawLength(random, .13, .18),
                 toy_depth = DrawLength(random, .11, .15),
                 toy_width = DrawLength(random, .11, .15);
    const Eigen::Vector3d toy_size(toy_width, toy_depth, toy_height);
    for (Waypoint& point : way) {  // it hangs from the fingers
      point.center_w.x() = Rounded(point.center_w.x() - side * size.y() * 0.42);
      point.center_w.z() = Rounded(point.center_w.z() - toy_size.z() / 2);
    }
    PutMoving("carried_toy", "teddy bear", ShapeKind::kToy, toy_size,
              DrawMaterial(Print::kCloth, random), way, filled);
  }
  if (FindFault(filled)) return false;
  scene = filled;
  return true;
}

}  // namespace

Scene MakePasser(std::uint64_t seed, const ParameterValues& values) {
  Random random({kPasserKey, seed});
  Scene scene;
  PutRoom({-3, -2.6}, {3, 2.4}, Print::kSpeckle, random, scene);
  const Table table = DrawTable(random, {1.3, 1.6}, {0.65, 0.8});
  PutTable("desk", table, DrawMaterial(Print::kWood, random), scene);
  PutClutter(static_cast<int>(values.at("objects")), table, {kPasserKey, seed, 1}, scene);
  Motion& motion = scene.motion;
  motion.target_w = {0, Rounded(-0.05 * table.depth), table.top_z};
  motion.pitch_min_rad = DegToRad(20);
  motion.pitch_max_rad = DegToRad(38);
  int kind = static_cast<int>(values.at("kind"));
  if (kind == kDrawn) kind = 1 + random.Below(3);
  const int times = static_cast<int>(values.at("times"));
  const double speed_m_s = values.at("speed_m_s");
  if (kind == kWalker) {
    PutWalker(table, times, speed_m_s > 0 ? speed_m_s : 0.9, random, scene);
    return scene;
  }
  // Low over the desk when there is room, else over the things on it.
  for (std::uint64_t attempt = 0; attempt < 60; ++attempt) {
    Random hand({kPasserKey, seed, 2, attempt});
    const double height_m = Rounded((kind == kCarriedToy ? .26 : .14) + .012 * double(attempt));
    if (PutHand(table, times, speed_m_s > 0 ? speed_m_s : 0.5, kind == kCarriedToy, height_m,
                hand, scene)) {
      return scene;
    }
  }
  throw io::InputError("family passer",
                       "no way for a hand over the desk; ask for fewer objects");
}

}  // namespace sim
