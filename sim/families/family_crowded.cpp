#include "io/input_error.h"
#include "sim/families/filling.h"

namespace sim {

Scene MakeCrowdedDesk(std::uint64_t seed, int count) {
  constexpr std::uint64_t kKey = 0x63726f77;
  Random random({kKey, seed});
  Scene scene;
  const Table table = DrawTable(random, {1.8 + 0.02 * (count - 15), 2.4}, {0.9, 1.0});
  PutRoom({-2.6, Rounded(table.depth / 2 + 0.05 - 5)}, {2.6, Rounded(table.depth / 2 + 0.05)},
          Print::kSpeckle, random, scene);
  PutTable("desk", table, DrawMaterial(Print::kWood, random), scene);
  scene.motion.target_w = {0, Rounded(-0.1 * table.depth), table.top_z};
  scene.motion.target_spread_m = 0.5;
  for (std::uint64_t attempt = 0; attempt < 200; ++attempt) {
    Random things({kKey, seed, 1, attempt});
    if (FillTable(DrawClutter(count, things), table, things, scene)) return scene;
  }
  throw io::InputError("family desk", "no room for " + std::to_string(count) +
                                          " objects on the desk of seed " +
                                          std::to_string(seed) + "; ask for fewer");
}

}  // namespace sim
