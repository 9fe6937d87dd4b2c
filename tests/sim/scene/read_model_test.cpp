#include "sim/scene/read_model.h"

#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "sim/scene/read_scene.h"
#include "sim/scene/write_scene.h"
#include "tests/support/temporary_folder.h"

namespace sim {
namespace {

/// A brick of 200 x 100 x 50 mm that turns its sides inside out.
const std::string kBrick_mm =
    "v 0 0 0\nv 200 0 0\nv 200 100 0\nv 0 100 0\nv 0 0 50\nv 200 0 50\nv 200 100 50\n"
    "v 0 100 50\nf 1 2 3 4\nf 8 7 6 5\nf 5 6 2 1\nf 6 7 3 2\nf 7 8 4 3\nf 8 5 1 4\n";

TEST(ModelText, IsReadBackToTheSameOptionsAndPlanes) {
  const test_support::TemporaryFolder folder;
  std::ofstream(folder / "brick.obj") << kBrick_mm;
  const std::string file = (folder / "scene.yaml").string();
  const Scene scene = ParseScene(
      "format: pas-scene/1\nname: own\nobjects:\n  - id: 1\n    name: brick\n"
      "    class: box\n    role: regular\n    mesh: brick.obj\n    center_m: [0, 0, 0.5]\n"
      "    scale: 0.001\n    flip: true\n    flatness_mm: 0.3\n    min_plane_cm2: 75\n"
      "    open_edges: 0.25\n",
      file);
  const Model& brick = *scene.objects.at(0).model;
  EXPECT_DOUBLE_EQ(brick.options.min_plane_m2, 0.0075);
  EXPECT_EQ(brick.planes.size(), 4u) << "its ends of 100 x 50 mm are too small";
  const Scene again = ParseScene(SceneText(scene), file);
  const Model& read = *again.objects.at(0).model;
  EXPECT_EQ(read.options.scale, brick.options.scale);
  EXPECT_EQ(read.options.flip, brick.options.flip);
  EXPECT_EQ(read.options.flatness_m, brick.options.flatness_m);
  EXPECT_EQ(read.options.min_plane_m2, brick.options.min_plane_m2);
  EXPECT_EQ(read.options.open_edges, brick.options.open_edges);
  EXPECT_EQ(read.planes.size(), brick.planes.size());
}

}  // namespace
}  // namespace sim
