#include "slam/calibrate/depth_edges.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

namespace slam {
namespace {

/// A wall at 2 m, and before it a board at 1 m over the pixels of a rectangle.
cv::Mat1f BoardBeforeAWall(const cv::Rect& board) {
  cv::Mat1f depth_m(120, 160, 2.0f);
  depth_m(board) = 1.0f;
  return depth_m;
}

const std::vector<DepthEdge>& Of(const DepthEdges& edges, NearSide side) {
  return edges[static_cast<std::size_t>(side)];
}

TEST(DepthEdges, LieHalfWayToTheNextPixelOnTheirSideOfTheNearThing) {
  const DepthEdges edges = FindDepthEdges(BoardBeforeAWall({40, 30, 50, 60}));
  // 60 rows and 50 columns, every other one, less what has no edge four pixels on.
  for (const NearSide side : {NearSide::kLeft, NearSide::kRight}) {
    EXPECT_NEAR(static_cast<double>(Of(edges, side).size()), 26.0, 1.0);
    for (const DepthEdge& edge : Of(edges, side)) {
      EXPECT_EQ(edge.u_px, side == NearSide::kLeft ? 39.5f : 89.5f);
      EXPECT_EQ(edge.z_m, 1.0f);
    }
  }
  for (const NearSide side : {NearSide::kTop, NearSide::kBottom}) {
    EXPECT_NEAR(static_cast<double>(Of(edges, side).size()), 21.0, 1.0);
    for (const DepthEdge& edge : Of(edges, side)) {
      EXPECT_EQ(edge.v_px, side == NearSide::kTop ? 29.5f : 89.5f);
      EXPECT_EQ(edge.z_m, 1.0f);
    }
  }
}

TEST(DepthEdges, AreWhereTheNearThingEndsThoughAShadowLiesBesideIt) {
  cv::Mat1f depth_m = BoardBeforeAWall({40, 30, 50, 60});
  depth_m(cv::Rect(32, 30, 8, 60)) = 0.0f;   // a shadow of a first Kinect
  depth_m(cv::Rect(90, 30, 30, 60)) = 0.0f;  // and more than that
  const DepthEdges edges = FindDepthEdges(depth_m);
  ASSERT_GT(Of(edges, NearSide::kLeft).size(), 20u);
  for (const DepthEdge& edge : Of(edges, NearSide::kLeft)) {
    EXPECT_EQ(edge.u_px, 39.5f);
    EXPECT_EQ(edge.z_m, 1.0f);
  }
  EXPECT_TRUE(Of(edges, NearSide::kRight).empty());
}

TEST(DepthEdges, AreWhereTheNearThingEndsOnWhicheverSideItsShadowLies) {
  const cv::Mat1f plain_m = BoardBeforeAWall({40, 30, 50, 60});
  const DepthEdges expected = FindDepthEdges(plain_m);
  constexpr int kWidest = 10;
  const cv::Rect shadows[] = {{40 - kWidest, 30, kWidest, 60},
                              {90, 30, kWidest, 60},
                              {40, 30 - kWidest, 50, kWidest},
                              {40, 90, 50, kWidest}};
  for (const NearSide side :
       {NearSide::kLeft, NearSide::kRight, NearSide::kTop, NearSide::kBottom}) {
    cv::Mat1f depth_m = plain_m.clone();
    depth_m(shadows[static_cast<int>(side)]) = 0.0f;
    const DepthEdges edges = FindDepthEdges(depth_m);
    const std::vector<DepthEdge>&found = Of(edges, side), &sharp = Of(expected, side);
    ASSERT_EQ(found.size(), sharp.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
      EXPECT_EQ(found[i].u_px, sharp[i].u_px);
      EXPECT_EQ(found[i].v_px, sharp[i].v_px);
      EXPECT_EQ(found[i].z_m, 1.0f);
    }
  }
}

TEST(DepthEdges, AreNoneOnSlantsSmallStepsSpecksAndDiagonals) {
  cv::Mat1f depth_m(120, 160);
  for (int v = 0; v < 120; ++v) {
    for (int u = 0; u < 160; ++u) depth_m(v, u) = 1.0f + 0.02f * static_cast<float>(u);
  }
  depth_m(cv::Rect(30, 30, 40, 40)) *= 0.96f;
  depth_m(cv::Rect(100, 30, 3, 3)) *= 0.5f;
  const std::vector<cv::Point> diamond{{120, 60}, {140, 80}, {120, 100}, {100, 80}};
  cv::fillConvexPoly(depth_m, diamond, 0.5f);
  for (const auto& side : FindDepthEdges(depth_m)) EXPECT_TRUE(side.empty());
}

}  // namespace
}  // namespace slam
