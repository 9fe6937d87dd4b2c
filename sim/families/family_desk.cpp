#include <algorithm>
#include <string>

#include "io/input_error.h"
#include "sim/families/filling.h"
#include "sim/families/items.h"
#include "sim/families/layout.h"
#include "sim/families/recipe.h"

namespace sim {
namespace {

constexpr std::uint64_t kDeskKey = 0x6465736b;
constexpr double kHalfView_m = 0.66;   // things stay where the camera looks
constexpr double kClearSide_m = 1.40;  // the side wall leaves the camera its room
constexpr int kMinObjects = 8, kMaxObjects = 14;
constexpr int kDeskLayouts = 400;  // tried before the seed is given up

struct Desk {
  double width, depth, top_z;
};

Desk PutDeskRoom(Random& random, Scene& scene) {
  const Desk desk{DrawLength(random, 1.2, 1.8), DrawLength(random, 0.6, 0.8),
                  DrawLength(random, 0.70, 0.76)};
  const double wall_y = Rounded(desk.depth / 2 + DrawLength(random, 0.02, 0.12));
  const double side_x = Rounded(kClearSide_m + DrawLength(random, 0.0, 0.3));
  const double side = random.Chance(0.5) ? 1 : -1;
  PutStructure("floor", "floor", {6, 6, 0.1}, {0, wall_y - 3, -0.05},
               DrawMaterial(Print::kCloth, random), scene);
  PutStructure("wall_back", "wall", {6, 0.1, 2.5}, {0, wall_y + 0.05, 1.25},
               DrawMaterial(Print::kSpeckle, random), scene);
  PutStructure("wall_side", "wall", {0.1, 6, 2.5}, {side * (side_x + 0.05), wall_y - 3, 1.25},
               DrawMaterial(Print::kSpeckle, random), scene);

  constexpr double kTop_m = 0.03, kLeg_m = 0.03;
  const Material wood = DrawMaterial(Print::kWood, random);
  PutStructure("desk", "dining table", {desk.width, desk.depth, kTop_m},
               {0, 0, desk.top_z - kTop_m / 2}, wood, scene);
  const double leg_height = Rounded(desk.top_z - kTop_m);
  for (const double at : {-1.0, 1.0}) {
    PutStructure(at < 0 ? "desk_leg_left" : "desk_leg_right", "dining table",
                 {kLeg_m, Rounded(desk.depth - 0.1), leg_height},
                 {at * (desk.width / 2 - 0.05), 0, leg_height / 2}, wood, scene);
  }
  for (std::size_t i = scene.objects.size() - 3; i < scene.objects.size(); ++i) {
    scene.objects[i].detection_group = 1;
  }
  return desk;
}

/// The things that every desk has, then small ones until there are `count`.
std::vector<Wish> DrawWishes(int count, Random& random) {
  std::vector<Wish> wishes;
  wishes.push_back({MakeMonitor(random), 0.10, 0.5, 15});
  const bool open = random.Chance(0.7);
  wishes.push_back({open ? MakeOpenLaptop(random) : MakeClosedLaptop(random), -0.5, 0.5, 25});
  wishes.push_back({MakeKeyboard(random), -0.5, 0.2, 12});
  wishes.push_back({MakeCarton(random), -0.2, 0.5, 180});
  const int stacked = std::min(2 + random.Below(2), count - 6);
  wishes.push_back({MakeBookStack(stacked, random)});
  wishes.push_back({MakeToy(random), -0.2, 0.5, 180});
  wishes.push_back({MakePhone(random)});
  int left = count - 6 - stacked;
  if (left >= 4) {
    wishes.push_back({MakeBookStack(2, random)});
    left -= 2;
  }
  for (; left > 0; --left) {
    switch (random.Below(5)) {
      case 0:
        wishes.push_back({MakeTablet(random)});
        break;
      case 1:
        wishes.push_back({MakeMouse(random)});
        break;
      case 2:
        wishes.push_back({MakeRemote(random)});
        break;
      default:
        wishes.push_back({MakeBook(random)});
        break;
    }
  }
  const auto area = [](const Wish& wish) { return wish.item.footprint.prod(); };
  std::stable_sort(wishes.begin(), wishes.end(),
                   [&](const Wish& a, const Wish& b) { return area(a) > area(b); });
  return wishes;
}

/// A tidy desk: 5 to 7 things.
std::vector<Wish> DrawFewWishes(int count, Random& random) {
  std::vector<Wish> wishes{{MakeOpenLaptop(random), -0.5, 0.5, 25},
                           {MakeKeyboard(random), -0.5, 0.2, 12},
                           {MakeBookStack(2, random)},
                           {MakePhone(random)}};
  if (count > 5) wishes.push_back({MakeCarton(random), -0.2, 0.5, 180});
  if (count > 6) wishes.push_back({MakeToy(random), -0.2, 0.5, 180});
  return wishes;
}

bool PutWishes(const std::vector<Wish>& wishes, const Desk& desk, Random& random,
               Scene& scene) {
  const double half_x = std::min(desk.width / 2, kHalfView_m);
  Layout layout({-half_x, -desk.depth / 2}, {half_x, desk.depth / 2}, kThingMargin_m);
  Scene filled = scene;
  for (const Wish& wish : wishes) {
    const Zone zone{{-half_x, wish.low_part * desk.depth},
                    {half_x, wish.high_part * desk.depth},
                    wish.max_yaw_deg};
    auto place = layout.Find(wish.item.footprint, zone, kTriesAThing, random);
    if (!place) return false;
    place->z = desk.top_z;
    Put(wish.item, *place, filled);
  }
  scene = filled;
  return true;
}

}  // namespace

Scene MakeDesk(std::uint64_t seed, const ParameterValues& values) {
  const int wanted = static_cast<int>(values.at("objects"));
  if (wanted > kMaxObjects) return MakeCrowdedDesk(seed, wanted);
  Scene scene;
  Random room({kDeskKey, seed, 0});
  const Desk desk = PutDeskRoom(room, scene);
  scene.motion.target_w = {0, Rounded(-0.05 * desk.depth), desk.top_z};
  const int count = wanted > 0 ? wanted : 8 + room.Below(7);
  for (std::uint64_t attempt = 0; attempt < kDeskLayouts; ++attempt) {
    // Where a full desk has no room at all, the things are drawn anew, then fewer of them.
    const int fewer = wanted > 0 ? 0 : static_cast<int>(attempt / 50);
    Random random({kDeskKey, seed, 1, attempt});
    const std::vector<Wish> wishes =
        count < kMinObjects ? DrawFewWishes(count, random)
                            : DrawWishes(std::max(kMinObjects, count - fewer), random);
    if (PutWishes(wishes, desk, random, scene)) return scene;
  }
  // Not only the family `desk` has one.
  throw io::InputError("objects", "no room for " + std::to_string(count) +
                                      " on the desk of seed " + std::to_string(seed) +
                                      "; ask for fewer");
}

}  // namespace sim
