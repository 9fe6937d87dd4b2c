#include "sim/shapes/steps.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/base/angle.h"
#include "sim/families/families.h"

namespace sim {
namespace {

constexpr double kFile_mm = 2e-3;  // made scenes are rounded to the micrometre

Object Box(int id, const Eigen::Vector3d& size, double x, double y, double bottom_z) {
  Object box;
  box.id = id;
  box.role = Role::kRegular;
  box.size = size;
  box.center_w = {x, y, bottom_z + size.z() / 2};
  return box;
}

Scene TableAnd(const std::vector<Object>& objects) {
  Scene scene;
  scene.objects.push_back(Box(1, {1.4, 0.7, 0.03}, 0, 0, 0.70));
  scene.objects[0].role = Role::kStructure;
  scene.objects.insert(scene.objects.end(), objects.begin(), objects.end());
  return scene;
}

std::vector<TopStep> StepsOf(const Scene& scene) { return TopSteps(scene, ScenePlanes(scene)); }

TEST(TopSteps, MeasureABookOverTheTable) {
  const auto steps = StepsOf(TableAnd({Box(2, {0.15, 0.2, 0.02}, 0.1, 0.1, 0.73)}));
  ASSERT_EQ(steps.size(), 1u);
  EXPECT_EQ(steps[0].object, 2);
  EXPECT_EQ(steps[0].below_object, 1);
  EXPECT_EQ(steps[0].plane, 12);
  EXPECT_NEAR(steps[0].step_mm, 20, 1e-9);
}

TEST(TopSteps, TakeTheHighestSurfaceUnderAnOverhang) {
  // The upper book lies half on the lower one; the table is under its other half.
  const auto steps = StepsOf(TableAnd(
      {Box(2, {0.2, 0.2, 0.030}, 0, 0, 0.73), Box(3, {0.2, 0.2, 0.012}, 0.1, 0, 0.76)}));
  ASSERT_EQ(steps.size(), 2u);
  EXPECT_NEAR(steps[0].step_mm, 30, 1e-9);
  EXPECT_EQ(steps[1].below_object, 2);
  EXPECT_NEAR(steps[1].step_mm, 12, 1e-9);
}

TEST(TopSteps, AreToTheNearestSurfaceBelowWhereverItStandsInTheList) {
  Scene scene = TableAnd(
      {Box(2, {0.2, 0.2, 0.030}, 0, 0, 0.73), Box(3, {0.2, 0.2, 0.012}, 0.1, 0, 0.76)});
  std::swap(scene.objects[0], scene.objects[1]);  // the table after the book that lies on it
  const auto steps = StepsOf(scene);
  ASSERT_EQ(steps.size(), 2u);
  for (const TopStep& step : steps) {
    EXPECT_EQ(step.below_object, step.object - 1);
    EXPECT_NEAR(step.step_mm, step.object == 2 ? 30 : 12, 1e-9);
  }
}

TEST(TopSteps, IgnoreNeighboursThatOnlyTouch) {
  const auto steps = StepsOf(
      TableAnd({Box(2, {0.2, 0.2, 0.03}, 0, 0, 0.73), Box(3, {0.2, 0.2, 0.05}, 0.2, 0, 0.73)}));
  ASSERT_EQ(steps.size(), 2u);
  EXPECT_EQ(steps[0].below_object, 1);
  EXPECT_EQ(steps[1].below_object, 1);
  EXPECT_NEAR(steps[1].step_mm, 50, 1e-9);
}

// Thinner than what counts as touching, it still lies over the book and not under it.
TEST(TopSteps, OfABookUnderAThinSheetAreOverTheTable) {
  const auto steps = StepsOf(TableAnd(
      {Box(2, {0.15, 0.2, 0.02}, 0, 0, 0.73), Box(3, {0.1, 0.1, 0.00008}, 0, 0, 0.75)}));
  ASSERT_EQ(steps.size(), 2u);
  EXPECT_EQ(steps[0].below_object, 1);
  EXPECT_NEAR(steps[0].step_mm, 20, 1e-9);
  EXPECT_EQ(steps[1].below_object, 2);
  EXPECT_NEAR(steps[1].step_mm, 0.08, 1e-9);
}

TEST(TopSteps, DoNotDependOnHowABookIsTurned) {
  Object book = Box(2, {0.15, 0.2, 0.02}, 0.1, 0.1, 0.73);
  book.q_wo = QuaternionFromRpyDeg({0, 0, 33});
  EXPECT_NEAR(StepsOf(TableAnd({book}))[0].step_mm, 20, 1e-9);
  book.q_wo = QuaternionFromRpyDeg({180, 0, 33});  // on its face: another face is the top
  const auto steps = StepsOf(TableAnd({book}));
  ASSERT_EQ(steps.size(), 1u);
  EXPECT_EQ(steps[0].plane, 11);
  EXPECT_NEAR(steps[0].step_mm, 20, 1e-9);
}

// Along the normal of a tilted top the table is nearest under its low edge, 20 mm cos(tilt) up.
TEST(TopSteps, OfATiltedBookAreThoseOfItsLowEdge) {
  const double tilt = DegToRad(5);
  for (const double sign : {1.0, -1.0}) {
    Object book = Box(2, {0.2, 0.2, 0.02}, 0.1, 0.1, 0.73);
    book.q_wo = QuaternionFromRpyDeg({sign * 5, 0, 0});
    book.center_w.z() = 0.73 + 0.1 * std::sin(tilt) + 0.01 * std::cos(tilt);
    const auto steps = StepsOf(TableAnd({book}));
    ASSERT_EQ(steps.size(), 1u);
    EXPECT_EQ(steps[0].below_object, 1);
    EXPECT_NEAR(steps[0].step_mm, 20 * std::cos(tilt) * std::cos(tilt), 1e-9);
  }
}

TEST(TopSteps, AreThoseThePlatesWereAskedFor) {
  for (const double step_mm : {0.0, 3.0, 20.0, 55.5}) {
    const auto steps = StepsOf(MakeScene("plates", 7, {{"step_mm", step_mm}}));
    ASSERT_EQ(steps.size(), 2u);
    EXPECT_NEAR(steps[1].step_mm - steps[0].step_mm, step_mm, kFile_mm);
  }
}

TEST(TopSteps, AreEqualInAStack) {
  const auto steps = StepsOf(MakeScene("stack", 5, {{"step_mm", 12}, {"count", 5}}));
  ASSERT_EQ(steps.size(), 5u);
  for (const TopStep& step : steps) EXPECT_NEAR(step.step_mm, 12, kFile_mm);
}

}  // namespace
}  // namespace sim
