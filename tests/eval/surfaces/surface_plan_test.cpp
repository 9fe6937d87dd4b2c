#include "eval/surfaces/surface_plan.h"

#include <gtest/gtest.h>

#include "eval/draw/paint.h"
#include "tests/eval/surfaces/boards.h"
#include "tests/support/temporary_folder.h"

namespace eval {
namespace {

using testing::BoardWorld;

/// A level square of 0.4 m, seen from above.
Surface Tile(int id, double x, double y) {
  Surface surface;
  surface.id = id;
  surface.pi_g.n = Eigen::Vector3d::UnitZ();
  surface.chart_g = {{x, y, 0}, Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY()};
  surface.outlines = {{{-0.2, -0.2}, {0.2, -0.2}, {0.2, 0.2}, {-0.2, 0.2}}};
  return surface;
}

/// Where a surface is in the plan, mean over the pixels that are filled with its colour.
Eigen::Vector2d MiddleOf(const cv::Mat& plan, int id) {
  const Colour fill = 0.65 * Colour(250, 250, 250) + 0.35 * ColourOfPlane(id);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int v = 0; v < plan.rows; ++v) {
    for (int u = 0; u < plan.cols; ++u) {
      const cv::Vec3b pixel = plan.at<cv::Vec3b>(v, u);
      double off = 0;
      for (int c = 0; c < 3; ++c) off = std::max(off, std::abs(pixel[c] - fill[c]));
      if (off < 3) sum += Eigen::Vector3d(u, v, 1);
    }
  }
  EXPECT_GT(sum.z(), 20) << id;
  return sum.head<2>() / sum.z();
}

TEST(DrawPlan, IsSeenFromAboveAndNotFromBelow) {
  BoardWorld world;
  world.boards = {{{0, 0, 2}, {-1, 0, 0}, {0, 1, 0}}};
  // The camera looks along the world's y and holds z up.
  world.T_wg = {Eigen::AngleAxisd(-M_PI / 2, Eigen::Vector3d::UnitX()).toRotationMatrix(),
                Eigen::Vector3d::Zero()};
  const test_support::TemporaryFolder folder;
  const Sequence sequence = world.Write(folder.path());
  const DepthViews views(sequence, *sequence.camera, std::nullopt);
  SurfaceFile file;
  file.surfaces = {Tile(1, 0, 1), Tile(2, 2, 1), Tile(3, 0, 2.5)};
  const cv::Mat plan = DrawPlan(file, views, {800, 800});
  const Eigen::Vector2d x = MiddleOf(plan, 2) - MiddleOf(plan, 1),
                        y = MiddleOf(plan, 3) - MiddleOf(plan, 1);
  // From above y is to the left of x; the picture's rows run down.
  EXPECT_LT(x.x() * y.y() - x.y() * y.x(), 0);
  EXPECT_NEAR(x.norm() / y.norm(), 2 / 1.5, 0.05);
}

TEST(DrawPlan, HoldsARowOfSurfacesWhicheverWayItRuns) {
  BoardWorld world;
  world.T_wg = {Eigen::AngleAxisd(-M_PI / 2, Eigen::Vector3d::UnitX()).toRotationMatrix(),
                Eigen::Vector3d::Zero()};
  const test_support::TemporaryFolder folder;
  const Sequence sequence = world.Write(folder.path());
  const DepthViews views(sequence, *sequence.camera, std::nullopt);
  for (const bool along_x : {true, false}) {
    SurfaceFile file;
    for (int id = 1; id <= 3; ++id) {
      const double at_m = 2.0 * (id - 2);
      file.surfaces.push_back(along_x ? Tile(id, at_m, 0) : Tile(id, 0, at_m));
    }
    const cv::Mat plan = DrawPlan(file, views, {500, 500});
    const Eigen::Vector2d second = MiddleOf(plan, 2);
    const double to_first_px = (MiddleOf(plan, 1) - second).norm();
    const double to_third_px = (MiddleOf(plan, 3) - second).norm();
    EXPECT_GT(to_first_px, 100) << along_x;
    EXPECT_NEAR(to_third_px / to_first_px, 1, 0.05) << along_x;
  }
}

}  // namespace
}  // namespace eval
