#include <algorithm>

#include "io/input_error.h"
#include "sim/base/angle.h"
#include "sim/families/filling.h"

namespace sim {
namespace {

constexpr std::uint64_t kCoplanarKey = 0x636f706c, kTiltedKey = 0x74696c74;

Table PutTableInRoom(double width, double depth, Random& random, Scene& scene) {
  PutRoom({-3, -3}, {3, 3}, Print::kSpeckle, random, scene);
  Table table;
  table.width = width;
  table.depth = depth;
  table.top_z = DrawLength(random, .70, .76);
  PutTable("desk", table, DrawMaterial(Print::kWood, random), scene);
  scene.motion.target_w = {0, 0, table.top_z};
  scene.motion.target_spread_m = 0.2;
  return table;
}

Part DressedBox(const std::string& class_name, const Eigen::Vector3d& size, double x,
                Random& random) {
  Part part = BoxPart(class_name, size.unaryExpr(&Rounded), Rounded(x), 0, 0);
  Dress(part.object, random);
  return part;
}

/// Two things of different classes side by side, tops at heights h and h + step.
Item MakePair(double gap_m, double step_m, Random& random) {
  struct Kind {
    const char *left, *right;
    double low, high;  // height, metres
  };
  static constexpr Kind kKinds[] = {{"book", "laptop", .015, .025},
                                    {"cell phone", "tablet", .007, .009},
                                    {"book", "keyboard", .012, .030},
                                    {"remote", "book", .016, .024},
                                    {"box", "book", .040, .055}};
  const Kind& kind = kKinds[random.Below(5)];
  const double height = DrawLength(random, kind.low, kind.high);
  const double left = DrawLength(random, .12, .18), right = DrawLength(random, .12, .18);
  const double left_depth = DrawLength(random, .14, .20);
  const double right_depth = DrawLength(random, .14, .20);
  const double width = left + gap_m + right;
  Item pair;
  pair.footprint = {width, std::max(left_depth, right_depth)};
  pair.parts.push_back(
      DressedBox(kind.left, {left, left_depth, height}, (left - width) / 2, random));
  pair.parts.push_back(DressedBox(kind.right, {right, right_depth, height + step_m},
                                  (width - right) / 2, random));
  return pair;
}

/// A book with one edge on the table, its underside on the near edge of what lies under it.
/// Its weight falls between the two, so it stays.
Item MakeLeaningBook(double lift_m, Random& random) {
  const double length = DrawLength(random, .18, .27), width = DrawLength(random, .13, .19);
  const double thickness = DrawLength(random, .010, .030);
  const bool phone = lift_m == 0 && random.Chance(0.4);
  const double drawn_m =
      phone ? DrawLength(random, .007, .010) : DrawLength(random, .012, .045);
  const double lift = lift_m > 0 ? lift_m : drawn_m;
  const double reach = length * random.Between(0.62, 0.88);
  const double tilt_deg = Rounded(RadToDeg(AsinRad(lift / reach)));
  const SinCos tilt = SinCosDeg(tilt_deg);
  const double near = lift * tilt.cos / tilt.sin;  // where the underside is `lift` high
  const double under = phone ? .072 : DrawLength(random, .12, .16);
  const double low = -thickness * tilt.sin;
  const double high = std::max(length * tilt.cos, near + under);
  const double middle = (low + high) / 2;

  Item item;
  item.footprint = {high - low, std::max(width, .16)};
  item.parts.push_back(DressedBox(phone ? "cell phone" : "book", {under, .15, lift},
                                  near + under / 2 - middle, random));
  Part book = DressedBox("book", {length, width, thickness}, 0, random);
  const Eigen::Vector3d along(tilt.cos, 0, tilt.sin), normal(-tilt.sin, 0, tilt.cos);
  book.object.center_w = along * book.object.size.x() / 2 + normal * book.object.size.z() / 2 -
                         Eigen::Vector3d(middle, 0, 0);
  book.rpy_deg.y() = -tilt_deg;
  item.parts.push_back(book);
  return item;
}

template <typename MakeItem>
Scene MakeOnDesk(std::uint64_t family, std::uint64_t seed, int count, const MakeItem& make) {
  Random room({family, seed});
  Scene scene;
  const Table table = PutTableInRoom(1.5, 0.8, room, scene);
  for (std::uint64_t attempt = 0; attempt < 200; ++attempt) {
    Random random({family, seed, 1, attempt});
    std::vector<Wish> wishes;
    wishes.reserve(static_cast<std::size_t>(count) + 2);
    for (int i = 0; i < count; ++i) wishes.push_back({make(random)});
    wishes.push_back({MakeMug(random)});
    wishes.push_back({MakePlant(random), 0.1, 0.5});
    std::stable_sort(wishes.begin(), wishes.end(), [](const Wish& a, const Wish& b) {
      return a.item.footprint.prod() > b.item.footprint.prod();
    });
    if (FillTable(wishes, table, random, scene)) return scene;
  }
  throw io::InputError("--set count=" + std::to_string(count),
                       "does not fit on the desk; ask for fewer");
}

}  // namespace

Scene MakeCoplanar(std::uint64_t seed, const ParameterValues& values) {
  return MakeOnDesk(
      kCoplanarKey, seed, static_cast<int>(values.at("count")), [&](Random& random) {
        return MakePair(values.at("gap_mm") / 1000, values.at("step_mm") / 1000, random);
      });
}

Scene MakeTilted(std::uint64_t seed, const ParameterValues& values) {
  return MakeOnDesk(
      kTiltedKey, seed, static_cast<int>(values.at("count")),
      [&](Random& random) { return MakeLeaningBook(values.at("lift_mm") / 1000, random); });
}

Scene MakeBoards(std::uint64_t seed, const ParameterValues& values) {
  constexpr std::uint64_t kBoardKey = 0x626f6172;
  Random room({kBoardKey, seed});
  Scene scene;
  const Table table = PutTableInRoom(1.0, 0.8, room, scene);
  Motion& motion = scene.motion;
  motion.preset = "orbit";
  motion.target_w.z() = Rounded(table.top_z + 0.15);
  motion.target_spread_m = 0.1;
  motion.distance_min_m = 1.05;
  motion.distance_max_m = 1.35;
  motion.azimuth_min_rad = -kPi;
  motion.azimuth_max_rad = kPi;
  motion.pitch_min_rad = DegToRad(12);
  motion.pitch_max_rad = DegToRad(30);
  const int count = static_cast<int>(values.at("count"));
  const double thickness_m = values.at("thickness_mm") / 1000;
  for (std::uint64_t attempt = 0; attempt < 200; ++attempt) {
    Random random({kBoardKey, seed, 1, attempt});
    std::vector<Wish> wishes{{MakeMonitor(random), -0.3, 0.3}};
    for (int i = 1; i < count; ++i) {
      const bool tablet = i == 1;
      wishes.push_back(
          {tablet ? MakeUprightTablet(random) : MakeUprightBoard(thickness_m, random)});
    }
    if (FillTable(wishes, table, random, scene)) return scene;
  }
  throw io::InputError("--set count=" + std::to_string(count),
                       "does not fit on the desk; ask for fewer");
}

}  // namespace sim
