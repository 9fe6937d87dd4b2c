#include "sim/shapes/drawing.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <memory>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "sim/families/families.h"
#include "tests/sim/support/sim_worlds.h"

namespace sim {
namespace {

TEST(SceneSvg, DrawsEveryThingTwiceAndNamesTheSteps) {
  const Scene scene = MakeScene("stack", 1, {{"step_mm", 12.5}, {"count", 3}});
  const std::string svg = SceneSvg(scene);
  std::size_t outlines = 0;
  for (std::size_t at = svg.find("<title>book_"); at != std::string::npos;
       at = svg.find("<title>book_", at + 1)) {
    ++outlines;
  }
  EXPECT_EQ(outlines, 6u);  // plan and elevation; the floor is left out
  EXPECT_NE(svg.find("book_3 +12.5 mm"), std::string::npos);
  EXPECT_EQ(svg.find("title>floor"), std::string::npos);
  EXPECT_EQ(svg.rfind("</svg>\n"), svg.size() - 7);
  EXPECT_EQ(svg, SceneSvg(scene));
}

TEST(SceneSvg, TellsTheStepOfEveryTopOfAMesh) {
  auto stair = std::make_shared<Model>();
  stair->size = {0.2, 0.1, 0.1};
  for (const auto& [x, z] : {std::pair{-0.1, 0.05}, std::pair{0.0, 0.0}}) {
    const int first = static_cast<int>(stair->vertices_o.size());
    ModelPlane top;
    top.d = -z;
    top.outline_o = {{x, -0.05, z}, {x + 0.1, -0.05, z}, {x + 0.1, 0.05, z}, {x, 0.05, z}};
    stair->vertices_o.insert(stair->vertices_o.end(), top.outline_o.begin(),
                             top.outline_o.end());
    stair->triangles.push_back({first, first + 1, first + 2});
    stair->triangles.push_back({first, first + 2, first + 3});
    stair->plane_of.insert(stair->plane_of.end(), 2, static_cast<int>(stair->planes.size()));
    stair->planes.push_back(top);
  }
  Scene scene;
  scene.objects = {BoxObject(1, "floor", Role::kStructure, {0, 0, -0.05}, {2, 2, 0.1}),
                   BoxObject(2, "stair", Role::kRegular, {0, 0, 0.05}, stair->size)};
  scene.objects[1].shape = ShapeKind::kMesh;
  scene.objects[1].model = stair;
  EXPECT_NE(SceneSvg(scene).find("stair_2 +100 mm, +50 mm<"), std::string::npos);
}

/// Corners of the polygon that has the title at this place of the drawing, pixels.
std::vector<Eigen::Vector2d> CornersBefore(const std::string& svg, std::size_t title) {
  const std::size_t at = svg.rfind("points=\"", title) + 8;
  std::string points = svg.substr(at, svg.find('"', at) - at);
  std::replace(points.begin(), points.end(), ',', ' ');
  std::istringstream numbers(points);
  std::vector<Eigen::Vector2d> corners;
  for (double x, y; numbers >> x >> y;) corners.emplace_back(x, y);
  return corners;
}

/// The first outline of a thing in the drawing, which is that in the plan: its extent, pixels.
Eigen::AlignedBox2d BoxInPlan(const std::string& svg, const std::string& name) {
  Eigen::AlignedBox2d box;
  for (const Eigen::Vector2d& corner : CornersBefore(svg, svg.find("<title>" + name)))
    box.extend(corner);
  return box;
}
Eigen::Vector2d ExtentInPlan(const std::string& svg, const std::string& name) {
  return BoxInPlan(svg, name).sizes();
}

TEST(SceneSvg, DrawsALyingCylinderAsLongAsItIs) {
  Scene scene = MakeScene("stack", 1);
  Object can = scene.objects.back();
  can.name = "can", can.shape = ShapeKind::kCylinder, can.size = {0.1, 0.1, 0.4};
  can.q_wo = Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitX());
  scene.objects.push_back(can);
  can.name = "standing", can.q_wo.setIdentity();
  scene.objects.push_back(can);
  const std::string svg = SceneSvg(scene);
  const double px = 500;  // a metre
  EXPECT_TRUE(ExtentInPlan(svg, "can").isApprox(px * Eigen::Vector2d(0.1, 0.4), 1e-2));
  EXPECT_TRUE(ExtentInPlan(svg, "standing").isApprox(px * Eigen::Vector2d(0.1, 0.1), 1e-2));
}

TEST(SceneSvg, DrawsWhatMovesAsItStandsAtFirst) {
  Scene scene = MakeScene("stack", 1);
  Object arm = scene.objects.back();
  arm.name = "arm", arm.size = {0.1, 0.4, 0.1}, arm.q_wo.setIdentity();
  arm.way = {{0, {0, 0, 2}, 90}, {1, {1, 0, 2}, 90}};
  scene.objects.push_back(arm);
  EXPECT_TRUE(
      ExtentInPlan(SceneSvg(scene), "arm").isApprox(500 * Eigen::Vector2d(0.4, 0.1), 1e-2));
}

TEST(SceneSvg, DrawsWhatIsNearInTheElevationOverWhatIsFar) {
  Scene scene = MakeScene("stack", 1);
  Object near = scene.objects.back();
  near.name = "near", near.center_w.y() -= 1;
  Object far = near;
  far.name = "far", far.center_w.y() += 2;
  for (const bool near_first : {true, false}) {
    scene.objects = {near_first ? near : far, near_first ? far : near};
    const std::string svg = SceneSvg(scene);  // the last outline of each is in the elevation
    EXPECT_GT(svg.rfind("<title>near"), svg.rfind("<title>far")) << near_first;
  }
}

TEST(SceneSvg, DrawsTheStationsWhereTheCameraIs) {
  Scene scene = MakeScene("stack", 1);
  Object mark = scene.objects.back();
  mark.name = "mark", mark.q_wo.setIdentity();
  scene.objects.push_back(mark);
  for (int i = 0; i < 5; ++i) {
    scene.motion.stations.push_back(
        {{std::cos(i), std::sin(2.0 * i), 1 + 0.1 * i}, {0.1 * i, 0.2, 0.5}});
  }
  const std::string svg = SceneSvg(scene), title = "<title>stations of the camera";
  const auto plan = CornersBefore(svg, svg.find(title));
  const auto elevation = CornersBefore(svg, svg.rfind(title));
  ASSERT_EQ(plan.size(), 5u);
  ASSERT_EQ(elevation.size(), 5u);
  const Eigen::Vector2d mark_px = BoxInPlan(svg, "mark").center();
  const Eigen::Vector3d first_w = scene.motion.stations[0].camera_w;
  for (std::size_t i = 0; i < 5; ++i) {
    const Eigen::Vector3d camera_w = scene.motion.stations[i].camera_w;
    // 500 px a metre, written to a tenth; y of the page goes down.
    const Eigen::Vector3d from_mark = 500 * (camera_w - mark.center_w);
    const Eigen::Vector2d in_plan(from_mark.x(), -from_mark.y());
    EXPECT_LT((plan[i] - mark_px - in_plan).norm(), 0.3) << i;
    const Eigen::Vector3d from_first = 500 * (camera_w - first_w);
    const Eigen::Vector2d in_elevation(from_first.x(), -from_first.z());
    EXPECT_LT((elevation[i] - elevation[0] - in_elevation).norm(), 0.3) << i;
  }
}

}  // namespace
}  // namespace sim
