#include "sim/scene/check.h"

#include <gmock/gmock.h>

#include "tests/sim/support/sim_worlds.h"

namespace sim {
namespace {

using ::testing::HasSubstr;

/// Two flat boxes a step of (x, x) apart.
Scene TwoBoxes(double x) {
  Scene scene;
  scene.objects = {BoxObject(1, "book", Role::kRegular, {0, 0, 0.5}, {0.2, 0.2, 0.02}),
                   BoxObject(2, "book", Role::kRegular, {x, x, 0.5}, {0.2, 0.2, 0.02})};
  return scene;
}

TEST(FindFault, SeesBoxesThatMeetAtTheirCornersAlone) {
  const auto fault = FindFault(TwoBoxes(0.19));
  ASSERT_TRUE(fault.has_value());
  EXPECT_EQ(fault->object, 1u);
  EXPECT_THAT(fault->what, HasSubstr("10 mm inside each other"));
  EXPECT_FALSE(FindFault(TwoBoxes(0.2)).has_value());
}

TEST(FindFault, SeesAThingThatPassesThroughACornerOfAnother) {
  Scene scene = TwoBoxes(1);
  Object& mover = scene.objects[1];
  mover.way = {{0, {1, 0.19, 0.5}, 0}, {1, {0.19, 0.19, 0.5}, 0}};
  mover.center_w = mover.way[0].center_w;
  const auto fault = FindFault(scene);
  ASSERT_TRUE(fault.has_value());
  EXPECT_THAT(fault->what, HasSubstr("inside 'book_1'"));
}

}  // namespace
}  // namespace sim
