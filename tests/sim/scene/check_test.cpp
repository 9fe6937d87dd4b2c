#include "sim/scene/check.h"

#include <gmock/gmock.h>

#include <cmath>
#include <memory>
#include <utility>

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

TEST(FindFault, SeesAThingThatPassesThroughAWall) {
  Scene scene = TwoBoxes(1);
  scene.objects[0] = BoxObject(1, "wall", Role::kStructure, {0.5, 0, 0.5}, {0.1, 2, 1});
  Object& mover = scene.objects[1];
  mover.way = {{0, {1, 0, 0.5}, 0}, {1, {0, 0, 0.5}, 0}};
  mover.center_w = mover.way[0].center_w;
  const auto fault = FindFault(scene);
  ASSERT_TRUE(fault.has_value());
  EXPECT_EQ(fault->object, 1u);
  EXPECT_THAT(fault->what, HasSubstr("inside 'wall_1'"));
}

TEST(FindFault, AsksThingsToBeOverTheLowestOfSeveralFloors) {
  Scene scene;
  const auto floor_to = [](int id, double x, double top_z) {
    return BoxObject(id, "floor", Role::kStructure, {x, 0, top_z - 0.05}, {2, 2, 0.1});
  };
  for (const double first_z : {0.0, -0.2}) {
    const double low_x = first_z < 0 ? 0 : 3;
    scene.objects = {floor_to(1, 0, first_z), floor_to(2, 3, -0.2 - first_z),
                     BoxObject(3, "book", Role::kRegular, {low_x, 0, -0.19}, {0.2, 0.2, 0.02})};
    EXPECT_FALSE(FindFault(scene).has_value()) << first_z;
    scene.objects[2].center_w = {1.5, 1.5, -0.22};
    const auto fault = FindFault(scene);
    ASSERT_TRUE(fault.has_value());
    EXPECT_THAT(fault->what, HasSubstr("30 mm below the floor"));
  }
}

/// A square frame of one's own, 0.1 high: 0.2 wide outside, 0.1 inside.
Object HollowFrame(int id, const Eigen::Vector3d& center_w) {
  auto model = std::make_shared<Model>();
  model->size = {0.2, 0.2, 0.1};
  for (const double z : {-0.05, 0.05}) {
    for (const double half : {0.05, 0.1}) {
      for (const double x : {-half, half}) {
        for (const double y : {-half, half}) model->vertices_o.emplace_back(x, y, z);
      }
    }
  }
  Object frame = BoxObject(id, "frame", Role::kRegular, center_w, model->size);
  frame.shape = ShapeKind::kMesh;
  frame.model = model;
  return frame;
}

TEST(FindFault, LetsAThingStandInAHollowMeshInWhicheverOrderTheyAreListed) {
  Scene scene;
  scene.objects = {HollowFrame(1, {0, 0, 0.5}),
                   BoxObject(2, "box", Role::kRegular, {0, 0, 0.5}, {0.08, 0.08, 0.2})};
  Scene beside = scene;
  beside.objects[1].center_w = {0.13, 0.13, 0.5};  // it holds a corner of the frame
  for (int order = 0; order < 2; ++order) {
    EXPECT_FALSE(FindFault(scene).has_value()) << order;
    const auto fault = FindFault(beside);
    ASSERT_TRUE(fault.has_value()) << order;
    EXPECT_THAT(fault->what, HasSubstr("10 mm inside each other"));
    std::swap(scene.objects[0], scene.objects[1]);
    std::swap(beside.objects[0], beside.objects[1]);
  }
}

/// A corner of a cube of one's own, whose slanted face is square to z and below or above the rest.
Object TurnedTetrahedron(int id, double face_z, bool face_below) {
  auto model = std::make_shared<Model>();
  model->size = Eigen::Vector3d::Constant(0.3);
  model->vertices_o.assign(4, Eigen::Vector3d::Constant(-0.15));
  for (int axis = 0; axis < 3; ++axis) {
    model->vertices_o[static_cast<std::size_t>(axis)][axis] = 0.15;
  }
  const double to_middle = (face_below ? -1 : 1) * 0.15 / std::sqrt(3.0);
  Object object =
      BoxObject(id, "tetrahedron", Role::kRegular, {0, 0, face_z + to_middle}, model->size);
  object.q_wo.setFromTwoVectors(Eigen::Vector3d::Ones(),
                                Eigen::Vector3d(0, 0, face_below ? -1 : 1));
  object.shape = ShapeKind::kMesh;
  object.model = model;
  return object;
}

TEST(FindFault, TakesATurnedMeshByItsCornersAndNotByItsBox) {
  Scene scene;
  scene.objects = {TurnedTetrahedron(1, 0, true)};
  EXPECT_FALSE(FindFault(scene).has_value());
  scene.objects = {TurnedTetrahedron(1, -0.01, true)};
  const auto fault = FindFault(scene);
  ASSERT_TRUE(fault.has_value());
  EXPECT_THAT(fault->what, HasSubstr("10 mm below the floor"));

  Object floor = TurnedTetrahedron(1, 0, false);
  floor.class_name = "floor";
  scene.objects = {floor, BoxObject(2, "book", Role::kRegular, {0, 0, 0.01}, {0.2, 0.2, 0.02})};
  EXPECT_FALSE(FindFault(scene).has_value());
}

}  // namespace
}  // namespace sim
