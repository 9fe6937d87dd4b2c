#include "sim/shapes/drawing.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>

#include "sim/families/families.h"

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

/// The first outline of a thing in the drawing, which is that in the plan: its extent, pixels.
Eigen::Vector2d ExtentInPlan(const std::string& svg, const std::string& name) {
  const std::size_t title = svg.find("<title>" + name);
  const std::size_t at = svg.rfind("points=\"", title) + 8;
  std::string points = svg.substr(at, svg.find('"', at) - at);
  std::replace(points.begin(), points.end(), ',', ' ');
  std::istringstream numbers(points);
  Eigen::AlignedBox2d box;
  for (double x, y; numbers >> x >> y;) box.extend(Eigen::Vector2d(x, y));
  return box.sizes();
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

}  // namespace
}  // namespace sim
