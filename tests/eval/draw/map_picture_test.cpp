#include "eval/draw/map_picture.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace eval {
namespace {

/// A level square around (x, 0), `side_m` long; the scene's frame is v.
MapScene::Estimate Top(int id, double x, double side_m, const Eigen::Vector3d& n_v) {
  MapScene::Estimate plane;
  plane.id = id;
  plane.pi_v.n = n_v;
  const double h = side_m / 2;
  plane.hull_v = {{x - h, -h, 0}, {x + h, -h, 0}, {x + h, h, 0}, {x - h, h, 0}};
  plane.centre_v = {x, 0, 0};
  plane.area_m2 = side_m * side_m;
  plane.observations = 10;
  return plane;
}

MapScale OneMetre() {
  MapScale scale;
  scale.x0_m = -0.5, scale.y1_m = 0.5;
  scale.pixels_per_m = 600;
  scale.page = {0, 0, 600, 600};
  return scale;
}

TEST(LabelsOfMap, StandNotOverOneAnotherLargePlanesFirst) {
  MapScene scene;
  for (int id = 0; id < 40; ++id) {
    scene.planes.push_back(Top(id, 0.002 * id, 0.05 + 0.01 * id, Eigen::Vector3d::UnitZ()));
  }
  const std::vector<MapLabel> labels = LabelsOfMap(scene, OneMetre());
  ASSERT_GT(labels.size(), 5u);
  EXPECT_EQ(labels.front().id, 39);
  EXPECT_TRUE(std::is_sorted(labels.begin(), labels.end(),
                             [](const MapLabel& a, const MapLabel& b) { return a.id > b.id; }));
  for (std::size_t i = 0; i < labels.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_EQ((labels[i].place & labels[j].place).area(), 0);
    }
  }
}

TEST(LabelsOfMap, NameLevelPlanesBeforeALargerWall) {
  MapScene scene;
  scene.planes = {Top(1, 0, 0.9, Eigen::Vector3d::UnitX()),
                  Top(2, 0, 0.2, Eigen::Vector3d::UnitZ())};
  const std::vector<MapLabel> labels = LabelsOfMap(scene, OneMetre());
  ASSERT_EQ(labels.size(), 2u);
  EXPECT_EQ(labels.front().id, 2);
}

TEST(LabelsOfMap, NameAFloorWhereNoDeskCoversIt) {
  MapScene scene;
  scene.planes = {Top(1, 0, 0.9, Eigen::Vector3d::UnitZ()),
                  Top(2, 0, 0.3, Eigen::Vector3d::UnitZ())};
  scene.planes[1].pi_v.d = -0.7;  // the desk, 0.7 m over the floor
  const std::vector<MapLabel> labels = LabelsOfMap(scene, OneMetre());
  ASSERT_EQ(labels.size(), 2u);
  const cv::Rect2d desk(210, 210, 180, 180);
  EXPECT_EQ(labels[0].id, 1);
  EXPECT_EQ((labels[0].place & desk).area(), 0);
  EXPECT_GT((labels[1].place & desk).area(), 0);
}

TEST(DrawMap, SaysThatNoPlaneWasMapped) {
  const cv::Mat page = DrawMap({}, {"run", "seq", "", "nothing was tracked"});
  EXPECT_FALSE(page.empty());
}

// A face is a ring: the side from its last corner to its first is drawn like the others.
TEST(DrawMap, OutlinesATrueFaceWhicheverCornerComesFirst) {
  MapScene scene;
  scene.on_truth = true;
  scene.planes = {Top(1, 0, 0.9, Eigen::Vector3d::UnitZ())};
  MapScene::Truth face{"book", scene.planes[0].pi_v, Top(2, 0, 0.6, {0, 0, 1}).hull_v};
  scene.truth = {face};
  const RunTitle title{"run", "seq", "", ""};
  const cv::Mat page = DrawMap(scene, title);
  for (int first = 1; first < 4; ++first) {
    std::rotate(face.vertices_v.begin(), face.vertices_v.begin() + 1, face.vertices_v.end());
    scene.truth = {face};
    EXPECT_LT(cv::norm(page, DrawMap(scene, title), cv::NORM_INF), 8) << first;
  }
  scene.truth = {};
  EXPECT_GT(cv::norm(page, DrawMap(scene, title), cv::NORM_INF), 50);
}

TEST(TrueLevelPlane, LiesUnderAPlaneThoughItsOutlineTurnsInwards) {
  MapScene scene;
  MapScene::Truth desk{
      "desk",
      Top(1, 0, 1, {0, 0, 1}).pi_v,
      {{0, 0, 0}, {2, 0, 0}, {2, 0.8, 0}, {0.8, 0.8, 0}, {0.8, 2, 0}, {0, 2, 0}}};
  scene.truth = {desk};
  MapScene::Estimate plane = Top(1, 0, 0.2, {0, 0, 1});
  plane.centre_v = {0.4, 1.5, 0};
  EXPECT_NE(TrueLevelPlane(scene, plane), nullptr);
  plane.centre_v = {1.5, 1.5, 0};
  EXPECT_EQ(TrueLevelPlane(scene, plane), nullptr);
}

TEST(FitMap, TakesNoMoreOfThePageThanThereIs) {
  for (int i = 0; i < 400; ++i) {
    MapScene scene;
    scene.planes = {Top(1, 0, 0.2 + 0.0017 * i, Eigen::Vector3d::UnitZ())};
    for (Eigen::Vector3d& corner : scene.planes[0].hull_v) corner.x() *= 0.3;
    const MapScale scale = FitMap(scene, {0, 0, 1600, 700});
    EXPECT_LE(scale.page.height, 700);
    EXPECT_GE(scale.page.height, 699);
  }
}

TEST(BasePlane, IsTheOneThatOthersStandOnAndNotALowerOneBeside) {
  MapScene scene;
  scene.planes = {Top(1, -0.5, 0.3, Eigen::Vector3d::UnitZ()),
                  Top(2, 0.5, 0.4, Eigen::Vector3d::UnitZ())};
  for (int id = 3; id < 6; ++id) {
    scene.planes.push_back(Top(id, 0.4 + 0.05 * (id - 3), 0.05, Eigen::Vector3d::UnitZ()));
    scene.planes.back().pi_v.d = -0.05;
  }
  scene.planes[0].pi_v.d = 0.2;  // a seat, 0.2 m below the table
  const auto base = BasePlane(scene);
  ASSERT_TRUE(base.has_value());
  EXPECT_EQ(scene.planes[*base].id, 2);
}

}  // namespace
}  // namespace eval
