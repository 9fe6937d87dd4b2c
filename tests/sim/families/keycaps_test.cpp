#include "sim/families/keycaps.h"

#include <gtest/gtest.h>

#include <map>

#include "sim/families/families.h"
#include "sim/scene/geometry.h"
#include "sim/scene/read_scene.h"
#include "sim/scene/write_scene.h"

namespace sim {
namespace {

/// A desk with one keyboard that has blocks of keys. MakeScene refuses what is inside each
/// other.
Scene Desk(double keycaps) {
  return MakeScene("desk", 2, {{"objects", 20}, {"keycaps", keycaps}});
}

bool IsKeyboard(const Object& object) { return object.class_name == "keyboard"; }

TEST(Keycaps, FillTheirBlocksAndLeaveTheRestAsItIs) {
  const Scene blocks = Desk(0), caps = Desk(1);
  ASSERT_GT(caps.objects.size(), blocks.objects.size() + 80);
  const Object* base = nullptr;
  std::size_t in_blocks = 0;
  for (std::size_t i = 0; i < blocks.objects.size(); ++i) {
    const Object& block = blocks.objects[i];
    if (IsKeyboard(block) && base != nullptr) {
      double area = 0;
      for (const Object& cap : caps.objects) {
        if (!IsKeyboard(cap) || DistanceToBox(block, cap.center_w) > 0) continue;
        ++in_blocks;
        area += cap.size.x() * cap.size.y();
        EXPECT_EQ(cap.role, Role::kOther);
        EXPECT_EQ(cap.detection_group, block.detection_group);
        for (const Eigen::Vector3d& corner : Corners(cap)) {
          EXPECT_LT(DistanceToBox(block, corner), 2e-6);
        }
        EXPECT_NEAR(cap.size.x(), 0.016, 0.002);
        EXPECT_NEAR(cap.size.y(), 0.016, 0.0025);
      }
      EXPECT_NEAR(area / (block.size.x() * block.size.y()), 0.71, 0.06);  // (16 / 19)^2
      continue;
    }
    if (IsKeyboard(block)) base = &block;
    EXPECT_EQ(caps.objects[i].name, block.name);
    EXPECT_EQ(caps.objects[i].center_w, block.center_w);
    EXPECT_EQ(caps.objects[i].size, block.size);
  }
  ASSERT_NE(base, nullptr);
  EXPECT_EQ(in_blocks, caps.objects.size() - blocks.objects.size() + 3);
}

TEST(Keycaps, AreReadBackFromTheirFile) {
  const std::string text = SceneText(Desk(1));  // names and ids are unique, or it is refused
  EXPECT_EQ(SceneText(ParseScene(text, "text")), text);
}

TEST(Keycaps, StayAwayUnlessAskedFor) {
  EXPECT_EQ(SceneText(MakeScene("desk", 2, {{"objects", 20}})), SceneText(Desk(0)));
}

}  // namespace
}  // namespace sim
