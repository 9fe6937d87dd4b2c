#include "eval/export/bop.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "tests/eval/check/small_world.h"

namespace eval {
namespace {

using namespace small_world;

// Two tables with a book each, and the books differ in size alone: who draws a model over an image
// has to see the book of that image.
TEST(ExportBop, GivesThingsOfOneNameButOtherSizesModelsOfTheirOwn) {
  const TemporaryFolder folder;
  World worlds[] = {MakeWorld(64, 48, 1), MakeWorld(64, 48, 1)};
  worlds[1].objects[1].size = {0.18, 0.12, 0.04};
  worlds[1].faces.clear();
  AddFaces(worlds[1]);
  WriteSequence(folder / "a", worlds[0]);
  WriteSequence(folder / "b", worlds[1]);
  const ExportSummary summary = ExportBop({folder / "a", folder / "b"}, folder / "out", {});
  EXPECT_EQ(summary.kinds, 4) << "two books, one keyboard, one bear";

  const json models = json::parse(ReadText(folder / "out/models/models_info.json"));
  for (const int scene : {0, 1}) {
    const World& world = worlds[scene];
    const fs::path place = folder / ("out/train/00000" + std::to_string(scene));
    const json gt = json::parse(ReadText(place / "scene_gt.json"))["0"];
    ASSERT_EQ(gt.size(), 3u);
    for (const json& pose : gt) {
      const std::vector<double> t_mm = pose["cam_t_m2c"];
      const Vector3d center = world.views[0].T_wc * Vector3d(Vector3d(t_mm.data()) / 1000);
      const auto object =
          std::find_if(world.objects.begin(), world.objects.end(),
                       [&](const BoxObject& o) { return (o.center - center).norm() < 1e-6; });
      ASSERT_NE(object, world.objects.end());
      const json& model = models.at(std::to_string(pose["obj_id"].get<int>()));
      const Vector3d size_mm(model["size_x"].get<double>(), model["size_y"].get<double>(),
                             model["size_z"].get<double>());
      EXPECT_LT((size_mm - 1000 * object->size).norm(), 1e-6)
          << "the " << object->class_name << " of scene " << scene;
    }
  }
}

}  // namespace
}  // namespace eval
