#include "eval/planes/step_scores.h"

#include <gtest/gtest.h>

#include <iterator>
#include <map>

namespace eval {
namespace {

using Eigen::Vector3d;

/// A level face at a height, counter-clockwise seen from above.
TruthPlane Level(int id, double z, std::vector<Vector3d> outline_g) {
  TruthPlane plane;
  plane.id = id;
  plane.pi_g.n = Vector3d::UnitZ();
  plane.pi_g.d = -z;
  for (Vector3d& corner : outline_g) corner.z() = z;
  plane.vertices_g = std::move(outline_g);
  return plane;
}

std::vector<Vector3d> Square(double x, double y, double half) {
  return {{x - half, y - half, 0},
          {x + half, y - half, 0},
          {x + half, y + half, 0},
          {x - half, y + half, 0}};
}

/// A floor, an L-shaped desk 0.7 m over it, with a hole in its long arm.
SceneTruth CornerDesk() {
  SceneTruth scene;
  scene.planes = {
      Level(1, 0, Square(0, 0, 5)),
      Level(2, 0.7,
            {{0, 0, 0}, {2, 0, 0}, {2, 0.8, 0}, {0.8, 0.8, 0}, {0.8, 2, 0}, {0, 2, 0}})};
  std::vector<Vector3d> hole = Square(1.5, 0.4, 0.2);
  for (Vector3d& corner : hole) corner.z() = 0.7;
  scene.planes[1].holes_g = {hole};
  return scene;
}

TEST(StepOf, IsOverTheFaceBelowThoughItsOutlineTurnsInwardsOrHasHoles) {
  const SceneTruth scene = CornerDesk();
  const double over_desk_m = 0.02, over_floor_m = 0.72;
  for (const auto& [x, y, step_m] : {std::tuple(0.4, 1.5, over_desk_m),
                                     {1.1, 0.4, over_desk_m},
                                     {0.4, 0.4, over_desk_m},
                                     {1.5, 1.5, over_floor_m},
                                     {1.5, 0.4, over_floor_m},
                                     {-1.0, 1.0, over_floor_m}}) {
    const TruthPlane book = Level(3, 0.72, Square(x, y, 0.1));
    EXPECT_NEAR(StepOf(book, scene), step_m, 1e-12) << x << ", " << y;
  }
  EXPECT_EQ(StepOf(Level(3, 0.72, Square(9, 9, 0.1)), scene), 0.0) << "over nothing";
}

TEST(StepOf, IsThatToWhatLiesBelowAndNotAbove) {
  SceneTruth scene = CornerDesk();
  scene.planes.push_back(Level(4, 0.742, Square(0.4, 0.4, 0.1)));  // another book on the first
  EXPECT_NEAR(StepOf(Level(3, 0.73, Square(0.4, 0.4, 0.1)), scene), 0.03, 1e-12);
}

TEST(ScoreSteps, CountsTopsOfRegularObjectsAndNotTheDeskOverTheFloor) {
  SceneTruth scene = CornerDesk();
  scene.planes.push_back(Level(3, 0.725, Square(0.4, 0.4, 0.1)));  // a book
  for (const int id : {1, 2, 3}) {
    TruthObject object;
    object.id = id;
    object.role = id == 3 ? Role::kRegular : Role::kStructure;
    object.regular = id == 3;
    scene.objects.push_back(object);
    TruthPlane& top = scene.planes[std::size_t(id - 1)];
    top.object = id;
    top.scored = true;
  }
  DecisionHistory history;
  for (const int frame : {0, 1}) {
    for (const int truth : {1, 2, 3}) {
      history.surfaces.push_back({frame, 0.1 * frame, truth, 2000, true, true, ""});
      history.decisions.push_back(
          {{frame, truth, 10 + truth, 2000}, 0.1 * frame, "", Vector3d::Zero()});
    }
  }
  const std::vector<StepScore> steps = ScoreSteps(history, scene);
  ASSERT_EQ(steps.size(), 1u);
  EXPECT_LE(steps[0].min_mm, 25);
  EXPECT_GT(steps[0].max_mm, 25);
  EXPECT_EQ(steps[0].seen, 2);
  EXPECT_EQ(steps[0].right, 2);
  EXPECT_EQ(steps[0].right_planes, 2);
  EXPECT_EQ(steps[0].wrong_planes, 0);

  // A frame that takes the book for the desk decides, but is not right.
  history.surfaces.push_back({2, 0.2, 3, 2000, true, true, ""});
  history.decisions.push_back({{2, 3, 12, 2000}, 0.2, "", Vector3d::Zero()});
  const std::vector<StepScore> wrong = ScoreSteps(history, scene);
  ASSERT_EQ(wrong.size(), 1u);
  EXPECT_EQ(wrong[0].seen, 3);
  EXPECT_EQ(wrong[0].right, 2);
  EXPECT_EQ(wrong[0].right_planes, 2);
  EXPECT_EQ(wrong[0].wrong_planes, 1);
}

TEST(ScoreSteps, PutATopIntoTheOneClassThatHoldsItsStep) {
  std::map<double, double> classes;  // from, to
  for (double step_mm = 0.51; step_mm < 190; step_mm *= 1.013) {
    SceneTruth scene = CornerDesk();
    TruthPlane& top =
        scene.planes.emplace_back(Level(3, 0.7 + 1e-3 * step_mm, Square(0.4, 0.4, 0.1)));
    top.object = 3;
    top.scored = true;
    TruthObject& book = scene.objects.emplace_back();
    book.id = 3;
    book.regular = true;
    DecisionHistory history;
    history.surfaces.push_back({0, 0.0, 3, 2000, true, true, ""});
    const std::vector<StepScore> steps = ScoreSteps(history, scene);
    ASSERT_EQ(steps.size(), 1u) << step_mm;
    EXPECT_LE(steps[0].min_mm, step_mm);
    EXPECT_GT(steps[0].max_mm, step_mm);
    classes[steps[0].min_mm] = steps[0].max_mm;
  }
  EXPECT_GT(classes.size(), 5u);
  for (auto next = std::next(classes.begin()); next != classes.end(); ++next) {
    EXPECT_EQ(std::prev(next)->second, next->first);
  }
}

}  // namespace
}  // namespace eval
