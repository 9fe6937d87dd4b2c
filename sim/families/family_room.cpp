#include <algorithm>

#include "sim/base/angle.h"
#include "sim/families/filling.h"
#include "sim/families/furniture.h"

namespace sim {
namespace {

constexpr std::uint64_t kOfficeKey = 0x6f666669, kRoomKey = 0x726f6f6d,
                        kCabinetKey = 0x63616269, kWallKey = 0x77616c6c;

/// A shelf with its books; yaw 0 faces -y.
void PutShelf(const Place& place, Random& random, Scene& scene) {
  constexpr int kBoards = 4;
  const double width = DrawLength(random, 0.8, 1.1);
  const double height = DrawLength(random, 1.5, 1.8);
  const Eigen::Vector3d size(width, 0.28, height);
  Put(MakeShelf(size, kBoards, random), place, scene);
  Put(MakeShelfBooks(size, kBoards, random), place, scene);
}

/// A low cupboard in every corner of a room round the origin, with a carton or a plant on it.
void PutCornerCupboards(const Eigen::Vector2d& half, Random& random, Scene& scene) {
  for (const int corner : {0, 1, 2, 3}) {
    const int side = corner % 2 == 0 ? 1 : -1, end = corner < 2 ? 1 : -1;
    const double width = DrawLength(random, 0.45, 0.55), depth = 0.42;
    const double height = DrawLength(random, 0.55, 0.90);
    const Eigen::Vector2d at(Rounded(side * (half.x() - depth / 2 - 0.03)),
                             Rounded(end * (half.y() - width / 2 - 0.03)));
    Put(MakeCabinet({width, depth, height}, random),
        {at.x(), at.y(), 0, side > 0 ? -90.0 : 90.0}, scene);
    const Table top{at, depth, width, height, false};
    FillTable({{side == end ? MakeCarton(random) : MakePlant(random)}}, top, random, scene);
  }
}

Eigen::Vector3d RoundedPoint(double x, double y, double z) {
  return Eigen::Vector3d(x, y, z).unaryExpr(&Rounded);
}

/// Stations on an ellipse about the z axis; the gaze on one `gaze_part` as large.
std::vector<Station> Round(const Eigen::Vector2d& half, double camera_z, double gaze_part,
                           double gaze_z) {
  constexpr int kStations = 12;
  std::vector<Station> stations;
  for (int i = 0; i < kStations; ++i) {
    const SinCos turn = SinCosDeg(360.0 / kStations * i - 90);
    const double x = half.x() * turn.cos, y = half.y() * turn.sin;
    const double bob = 0.05 * SinCosDeg(150.0 * i).sin;
    stations.push_back({RoundedPoint(x, y, camera_z + bob),
                        RoundedPoint(gaze_part * x, gaze_part * y, gaze_z)});
  }
  return stations;
}

}  // namespace

Scene MakeOffice(std::uint64_t seed, const ParameterValues& values) {
  Random random({kOfficeKey, seed});
  Scene scene;
  const double half_x = DrawLength(random, 2.7, 3.1), half_y = DrawLength(random, 2.5, 2.8);
  PutRoom({-half_x, -half_y}, {half_x, half_y}, Print::kSpeckle, random, scene);
  Table table = DrawTable(random, {1.3, 1.5}, {0.65, 0.75});
  const Material wood = DrawMaterial(Print::kWood, random);
  const int things = static_cast<int>(values.at("objects"));
  for (const int side : {-1, 1}) {
    table.turned = side > 0;
    table.center.y() = Rounded(side * (table.depth / 2 + 0.005));
    PutTable(side < 0 ? "desk_a" : "desk_b", table, wood, scene);
    PutClutter(side < 0 ? (things + 1) / 2 : things / 2, table,
               {kOfficeKey, seed, side < 0 ? 1U : 2U}, scene);
  }
  Put(MakeCabinet({0.9, 0.45, 1.1}, random), {Rounded(half_x - 0.24), -0.6, 0, -90}, scene);
  PutShelf({0.4, Rounded(half_y - 0.15), 0, 0}, random, scene);

  scene.motion.preset = "loop";
  scene.motion.target_w = {0, 0, table.top_z};
  const Eigen::Vector2d half(table.width / 2 + 0.60, table.depth + 0.60);
  scene.motion.stations = Round(half, table.top_z + 0.55, 0.3, table.top_z);
  return scene;
}

Scene MakeRoomFamily(std::uint64_t seed, const ParameterValues& values) {
  Random random({kRoomKey, seed});
  Scene scene;
  const double half_x = DrawLength(random, 2.0, 2.4), half_y = DrawLength(random, 1.9, 2.2);
  PutRoom({-half_x, -half_y}, {half_x, half_y}, Print::kSpeckle, random, scene);
  Table table = DrawTable(random, {1.3, 1.6}, {0.65, 0.8});
  table.center = {0, Rounded(half_y - table.depth / 2 - 0.02)};
  PutTable("desk", table, DrawMaterial(Print::kWood, random), scene);
  PutClutter(static_cast<int>(values.at("objects")), table, {kRoomKey, seed, 1}, scene);
  Put(MakeCabinet({0.9, 0.45, 1.1}, random), {Rounded(half_x - 0.24), 0.2, 0, -90}, scene);
  PutShelf({Rounded(0.15 - half_x), -0.3, 0, 90}, random, scene);
  // A low bench with cartons along the wall behind the user.
  Table bench{{0.2, Rounded(0.25 - half_y)}, 1.6, 0.40, 0.45, true};
  PutTable("bench", bench, DrawMaterial(Print::kWood, random), scene);
  Random on_bench({kRoomKey, seed, 2});
  FillTable({{MakeCarton(on_bench)}, {MakeBookStack(3, on_bench)}, {MakeToy(on_bench)}}, bench,
            on_bench, scene);
  Random in_corners({kRoomKey, seed, 3});
  PutCornerCupboards({half_x, half_y}, in_corners, scene);

  scene.motion.preset = "loop";
  scene.motion.speed_m_s = 0.33;
  scene.motion.turn_deg_s = 32;
  scene.motion.target_w = {0, 0, 0.9};
  scene.motion.stations = Round({0.75, 0.70}, 1.35, 2.4, 0.75);
  return scene;
}

Scene MakeCabinetFamily(std::uint64_t seed, const ParameterValues& values) {
  Random random({kCabinetKey, seed});
  Scene scene;
  PutRoom({-3.5, -3.5}, {3.5, 3.5}, Print::kSpeckle, random, scene);
  const Eigen::Vector3d size(values.at("width_m"), values.at("depth_m"), values.at("height_m"));
  const double yaw_deg = Rounded(0.1 * (random.Below(201) - 100));
  Put(MakeCabinet(size, random), {0, 0, 0, yaw_deg}, scene);
  Motion& motion = scene.motion;
  motion.preset = "orbit";
  motion.target_w = RoundedPoint(0, -size.y() / 4, 0.6 * size.z());
  motion.target_spread_m = 0.25;
  const double reach = size.head<2>().norm() / 2;
  motion.distance_min_m = Rounded(reach + 0.8);
  motion.distance_max_m = Rounded(reach + 1.3);
  motion.azimuth_min_rad = DegToRad(-70);
  motion.azimuth_max_rad = DegToRad(70);
  motion.pitch_min_rad = DegToRad(8);
  motion.pitch_max_rad = DegToRad(32);
  return scene;
}

Scene MakeWall(std::uint64_t seed, const ParameterValues& values) {
  constexpr int kPanels = 6;
  constexpr double kThick_m = 0.02, kHeight_m = 1.8;
  Random random({kWallKey, seed});
  Scene scene;
  PutStructure("floor", "floor", {8, 8, 0.1}, {0, -2, -0.05},
               DrawMaterial(Print::kCloth, random), scene);
  PutStructure("wall_back", "wall", {8, 0.1, 2.5}, {0, 1.0, 1.25},
               DrawMaterial(Print::kSpeckle, random), scene);
  const bool zigzag = values.at("structure") > 0;
  const double width = DrawLength(random, 0.50, 0.65);
  const double turn_deg = zigzag ? Rounded(0.1 * (200 + random.Below(150))) : 0;
  const SinCos turn = SinCosDeg(turn_deg);
  const double pitch_m = width * turn.cos + kThick_m * turn.sin + 0.002;
  for (int i = 0; i < kPanels; ++i) {
    Material print = DrawMaterial(i % 2 == 0 ? Print::kCover : Print::kSpeckle, random);
    PutStructure("panel_" + std::to_string(i + 1), "wall", {width, kThick_m, kHeight_m},
                 {pitch_m * (i - (kPanels - 1) / 2.0), 0, kHeight_m / 2}, print, scene);
    scene.objects.back().q_wo =
        QuaternionFromRpyDeg({0, 0, i % 2 == 0 ? turn_deg : Rounded(-turn_deg)});
  }
  Motion& motion = scene.motion;
  const double distance = values.at("distance_m");
  motion.target_w = RoundedPoint(0, -width / 2 * turn.sin, 1.0);
  motion.target_spread_m = 0.4;
  motion.distance_min_m = Rounded(0.80 * distance);
  motion.distance_max_m = Rounded(1.15 * distance);
  motion.azimuth_min_rad = DegToRad(-30);
  motion.azimuth_max_rad = DegToRad(30);
  motion.pitch_min_rad = DegToRad(-5);
  motion.pitch_max_rad = DegToRad(22);
  motion.speed_m_s = 0.17;
  motion.turn_deg_s = 8;
  return scene;
}

}  // namespace sim
