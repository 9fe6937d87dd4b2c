#include "slam/segment/edges/plane_edges.h"

#include <gtest/gtest.h>

#include <map>

#include "slam/segment/plane_segments.h"
#include "tests/support/closed_form_depth.h"
#include "tests/support/depth_planes.h"

namespace slam {
namespace {

/// A horizontal plate seen from above at 1 m, fronto-parallel, over a floor 1.2 m below it.
struct PlateView {
  explicit PlateView(closed_form::World extra = {}) {
    world.boxes = {{{0, 0, 0}, {0.4, 0.3, 0.02}, 0.0, ""},
                   {{0, 0, -1.2}, {9, 9, 0.02}, 0.0, ""}};
    world.boxes.insert(world.boxes.end(), extra.boxes.begin(), extra.boxes.end());
    view = closed_form::Render(world, camera, closed_form::LookAt({0, 0, 1.01}, {0, 0, 0}));
  }
  /// Edge points of the plate by kind.
  std::map<EdgeKind, int> Kinds(const cv::Mat1f& depth_m) {
    frame = closed_form::MakeFrame(depth_m);
    ExtractPlanes(frame, PixelRays(camera), {});
    std::map<EdgeKind, int> kinds;
    for (const FramePlane& plane : frame.planes) {
      if (std::abs(plane.pi_c.d - 1.0) > 0.01) continue;
      for (const EdgePoint& e : plane.edge_points) ++kinds[e.kind];
    }
    return kinds;
  }
  Camera camera;
  closed_form::World world;
  closed_form::View view;
  Frame frame;
};

TEST(PlaneEdges, AreTheSurfacesOwnWhereAStepGoesDown) {
  PlateView plate;
  const auto kinds = plate.Kinds(plate.view.depth_m);
  ASSERT_EQ(kinds.count(EdgeKind::kSurface), 1u);
  EXPECT_EQ(kinds.size(), 1u);
  // Perimeter 2 (210 + 157.5) px, every second pixel.
  EXPECT_NEAR(kinds.at(EdgeKind::kSurface), 367, 15);
}

TEST(PlaneEdges, AreOccludedWhereSomethingNearerHidesTheRest) {
  PlateView plate({{{{0.15, 0.0, 0.3}, {0.1, 0.6, 0.02}, 0.0, ""}}});
  const auto kinds = plate.Kinds(plate.view.depth_m);
  ASSERT_EQ(kinds.count(EdgeKind::kOccluded), 1u);
  EXPECT_NEAR(kinds.at(EdgeKind::kOccluded), 157 / 2, 6);  // one short side
}

TEST(PlaneEdges, AreMissingWhereNothingIsMeasured) {
  PlateView plate;
  cv::Mat1f depth_m = plate.view.depth_m.clone();
  depth_m.colRange(0, 320).setTo(0.0f);
  const auto kinds = plate.Kinds(depth_m);
  ASSERT_EQ(kinds.count(EdgeKind::kMissing), 1u);
  EXPECT_NEAR(kinds.at(EdgeKind::kMissing), 157 / 2, 6);
}

// The projector does not reach what lies just behind the edge of a near thing.
TEST(PlaneEdges, AreOccludedWhereAShadowWithoutDepthLiesBeforeTheNearerThing) {
  PlateView plate({{{{0.15, 0.0, 0.3}, {0.1, 0.6, 0.02}, 0.0, ""}}});
  cv::Mat1f depth_m = plate.view.depth_m.clone();
  const double edge_u = plate.camera.cx + plate.camera.fx * 0.1 / 0.7;
  for (int v = 0; v < depth_m.rows; ++v) {
    for (int u = 0; u < depth_m.cols; ++u) {
      const bool on_plate = plate.view.face(v, u) == closed_form::FaceId(0, closed_form::kTop);
      if (on_plate && u > edge_u - 16.0) depth_m(v, u) = 0.0f;
    }
  }
  const auto kinds = plate.Kinds(depth_m);
  EXPECT_EQ(kinds.count(EdgeKind::kMissing), 0u);
  ASSERT_EQ(kinds.count(EdgeKind::kOccluded), 1u);
  EXPECT_NEAR(kinds.at(EdgeKind::kOccluded), 157 / 2, 6);  // one short side
}

TEST(PlaneEdges, AreTheBorderWhereTheImageEnds) {
  PlateView plate;
  Frame frame;
  Camera camera = plate.camera;
  camera.width = 320;  // the left half of the image
  frame = closed_form::MakeFrame(plate.view.depth_m.colRange(0, 320).clone());
  ExtractPlanes(frame, PixelRays(camera), {});
  int border = 0;
  for (const FramePlane& plane : frame.planes) {
    if (std::abs(plane.pi_c.d - 1.0) > 0.01) continue;
    for (const EdgePoint& e : plane.edge_points) border += e.kind == EdgeKind::kBorder ? 1 : 0;
  }
  EXPECT_NEAR(border, 157 / 2, 6);
}

TEST(PlaneEdges, AreTheSurfacesOwnAtAConcaveCrease) {
  // A desk meets a wall: the desk ends there, nothing hides it.
  closed_form::World world = closed_form::Desk();
  world.boxes.push_back({{0, 0.3, 0.5}, {3.0, 0.2, 1.0}, 0.0, ""});
  const Camera camera;
  const closed_form::View view =
      closed_form::Render(world, camera, closed_form::LookAt({0, -0.6, 0.6}, {0, 0.1, 0}));
  Frame frame = closed_form::MakeFrame(view.depth_m);
  ExtractPlanes(frame, PixelRays(camera), {});
  int occluded = 0, surface = 0;
  for (const EdgePoint& e : frame.planes.at(0).edge_points) {
    occluded += e.kind == EdgeKind::kOccluded ? 1 : 0;
    surface += e.kind == EdgeKind::kSurface ? 1 : 0;
  }
  EXPECT_GT(surface, 20);
  EXPECT_LT(occluded, surface / 10);
}

TEST(PlaneEdges, AreNotTheSurfacesOwnWhereASmallThingStandsOnItAcrossItsWidth) {
  // A long box lies across a longer plate near its far end: a concave crease, but not an end.
  closed_form::World world = closed_form::Desk();
  world.boxes.push_back({{0, 0, 0.02}, {0.2, 0.5, 0.04}, 0.0, ""});
  world.boxes.push_back({{0, 0.2, 0.06}, {0.5, 0.05, 0.04}, 0.0, ""});
  const Camera camera;
  const Pose T_cw = closed_form::LookAt({0, -0.6, 0.7}, {0, 0, 0});
  const closed_form::View view = closed_form::Render(world, camera, T_cw);
  Frame frame = closed_form::MakeFrame(view.depth_m);
  ExtractPlanes(frame, PixelRays(camera), {});
  int of_plate = 0, occluded = 0, wrong = 0;
  for (const FramePlane& plane : frame.planes) {
    for (const EdgePoint& e : plane.edge_points) {
      if (view.face(int(e.u_px.y()), int(e.u_px.x())) != closed_form::FaceId(1, 5)) continue;
      ++of_plate;
      // The foot of what lies across is at y = 0.175; the plate's own end is at 0.25.
      const Eigen::Vector3d p_w = Inverse(T_cw) * e.p_c;
      if (p_w.y() < 0.165 || p_w.y() > 0.2 || std::abs(p_w.x()) > 0.09) continue;
      (e.kind == EdgeKind::kSurface ? wrong : occluded)++;
    }
  }
  EXPECT_GT(of_plate, 200);
  EXPECT_GT(occluded, 30);
  EXPECT_EQ(wrong, 0);
}

TEST(PlaneEdges, SayHowLargeTheStepIs) {
  // 1.2 m down at 1 m, and next to nothing where another plate lies 10 mm lower beside it.
  PlateView plate({{{{0.4, 0.0, -0.01}, {0.4, 0.3, 0.02}, 0.0, ""}}});
  plate.Kinds(plate.view.depth_m);
  float thin = 0.0f, deep = 0.0f;
  for (const FramePlane& plane : plate.frame.planes) {
    if (std::abs(plane.pi_c.d - 1.0) > 0.004) continue;
    for (const EdgePoint& e : plane.edge_points) {
      if (std::abs(e.p_c.y()) > 0.1) continue;
      (e.p_c.x() > 0.15 ? thin : deep) = e.step_sigmas;
    }
  }
  const double sigma_m = DepthNoise{}.Sigma(1.0);
  EXPECT_NEAR(static_cast<double>(thin), 0.01 / sigma_m, 0.2 * 0.01 / sigma_m);
  EXPECT_GT(deep, 50.0f);
}

}  // namespace
}  // namespace slam
