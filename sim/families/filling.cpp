#include "sim/families/filling.h"

#include <algorithm>

#include "sim/families/layout.h"

namespace sim {
namespace {

constexpr int kTableLayouts = 200;  ///< tried before a thing less is put on the table

Wish DrawSmallThing(Random& random) {
  switch (random.Below(16)) {
    case 0:
      return {MakeTablet(random)};
    case 1:
      return {MakeMouse(random)};
    case 2:
      return {MakeRemote(random)};
    case 3:
      return {MakePhone(random)};
    case 4:
    case 5:
      return {MakeMug(random)};
    case 6:
      return {MakeBottle(random), -0.2, 0.5};
    case 7:
      return {MakeBowl(random)};
    case 8:
      return {MakePaper(random)};
    case 9:
    case 10:
      return {MakeNotebook(random)};
    case 11:
      return {MakeTissueBox(random)};
    case 12:
      return {MakeMousePad(random)};
    default:
      return {MakeBook(random)};
  }
}

}  // namespace

Table DrawTable(Random& random, const std::array<double, 2>& widths_m,
                const std::array<double, 2>& depths_m) {
  Table table;
  table.width = DrawLength(random, widths_m[0], widths_m[1]);
  table.depth = DrawLength(random, depths_m[0], depths_m[1]);
  table.top_z = DrawLength(random, .70, .76);
  return table;
}

void PutTable(const std::string& name, const Table& table, const Material& material,
              Scene& scene) {
  constexpr double kTop_m = 0.03, kSide_m = 0.03;
  const int group = NextGroup(scene);
  const std::size_t first = scene.objects.size();
  PutStructure(name, "dining table", {table.width, table.depth, kTop_m},
               {table.center.x(), table.center.y(), table.top_z - kTop_m / 2}, material, scene);
  const double height = Rounded(table.top_z - kTop_m);
  for (const double at : {-1.0, 1.0}) {
    PutStructure(
        name + (at < 0 ? "_leg_left" : "_leg_right"), "dining table",
        {kSide_m, Rounded(table.depth - 0.1), height},
        {table.center.x() + at * (table.width / 2 - 0.05), table.center.y(), height / 2},
        material, scene);
  }
  for (std::size_t i = first; i < scene.objects.size(); ++i) {
    scene.objects[i].detection_group = group;
  }
}

void PutRoom(const Eigen::Vector2d& low, const Eigen::Vector2d& high, Print print,
             Random& random, Scene& scene) {
  constexpr double kThick_m = 0.1, kHeight_m = 2.5;
  const Eigen::Vector2d size = high - low, middle = (low + high) / 2;
  PutStructure("floor", "floor", {size.x(), size.y(), 0.1}, {middle.x(), middle.y(), -0.05},
               DrawMaterial(Print::kCloth, random), scene);
  for (const double side : {-1.0, 1.0}) {
    const std::string end = side < 0 ? "_low" : "_high";
    PutStructure("wall_x" + end, "wall", {kThick_m, size.y(), kHeight_m},
                 {middle.x() + side * (size.x() + kThick_m) / 2, middle.y(), kHeight_m / 2},
                 DrawMaterial(print, random), scene);
    PutStructure("wall_y" + end, "wall", {size.x(), kThick_m, kHeight_m},
                 {middle.x(), middle.y() + side * (size.y() + kThick_m) / 2, kHeight_m / 2},
                 DrawMaterial(print, random), scene);
  }
}

std::vector<Wish> DrawClutter(int count, Random& random) {
  std::vector<Wish> wishes;
  int left = count;
  if (count >= 3) {
    wishes.push_back({MakeMonitor(random), 0.10, 0.5, 15});
    wishes.push_back({MakeOpenLaptop(random), -0.5, 0.5, 25});
    wishes.push_back({MakeKeycapKeyboard(random), -0.5, 0.2, 12});
    left -= 3;
  }
  if (left >= 6) {
    wishes.push_back({MakePlant(random), 0.0, 0.5});
    wishes.push_back({MakeLamp(random), 0.1, 0.5});
    wishes.push_back({MakeToy(random), -0.2, 0.5});
    wishes.push_back({MakeCarton(random), -0.2, 0.5});
    left -= 4;
  }
  while (left > 0) {
    if (left >= 3 && random.Chance(0.2)) {
      const int books = 2 + random.Below(2);
      wishes.push_back({MakeBookStack(books, random)});
      left -= books;
    } else {
      wishes.push_back(DrawSmallThing(random));
      --left;
    }
  }
  std::stable_sort(wishes.begin(), wishes.end(), [](const Wish& a, const Wish& b) {
    return a.item.footprint.prod() > b.item.footprint.prod();
  });
  return wishes;
}

bool FillTable(const std::vector<Wish>& wishes, const Table& table, Random& random,
               Scene& scene) {
  const double half_x = table.width / 2;
  Layout layout({-half_x, -table.depth / 2}, {half_x, table.depth / 2}, kThingMargin_m);
  Scene filled = scene;
  const double sign = table.turned ? -1 : 1;
  for (const Wish& wish : wishes) {
    const Zone zone{{-half_x, wish.low_part * table.depth},
                    {half_x, wish.high_part * table.depth},
                    wish.max_yaw_deg};
    auto place = layout.Find(wish.item.footprint, zone, kTriesAThing, random);
    if (!place) return false;
    place->x = table.center.x() + sign * place->x;
    place->y = table.center.y() + sign * place->y;
    place->z = table.top_z;
    if (table.turned) place->yaw_deg += place->yaw_deg > 0 ? -180 : 180;
    Put(wish.item, *place, filled);
  }
  scene = filled;
  return true;
}

void PutClutter(int count, const Table& table, std::initializer_list<std::uint64_t> key,
                Scene& scene) {
  Random named(key);
  const std::uint64_t stream = named.Bits();
  for (std::uint64_t attempt = 0; attempt < kTableLayouts && count > 0; ++attempt) {
    const int fewer = std::min(count - 1, static_cast<int>(attempt / 8));
    Random random({stream, attempt});
    if (FillTable(DrawClutter(count - fewer, random), table, random, scene)) return;
  }
}

void DialTexture(double dial, Scene& scene) {
  for (Object& object : scene.objects) {
    for (Material& material : object.faces)
      material.richness = Rounded(material.richness * dial);
  }
}

}  // namespace sim
