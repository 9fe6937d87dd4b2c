// Where a surface ends whose corners are known.
#include "slam/mapping/plane_face.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "slam/mapping/plane_observation.h"
#include "tests/support/plane_world.h"

namespace slam {
namespace {

/// A level face of 0.4 m x 0.3 m about the origin, corners seen `weight` times, either way
/// round.
MapPlane FaceWithCorners(double weight, bool reversed = false) {
  MapPlane m;
  m.pi_w = {Eigen::Vector3d(0, 0, 1), 0.0};
  m.vertices_w = {{-0.2, -0.15, 0}, {0.2, -0.15, 0}, {0.2, 0.15, 0}, {-0.2, 0.15, 0}};
  if (reversed) std::reverse(m.vertices_w.begin(), m.vertices_w.end());
  m.vertex_weights.assign(4, weight);
  return m;
}

TEST(FaceOfAMapPlane, IsKnownWhenEveryCornerHasBeenSeenOften) {
  const PlaneMapConfig config;
  EXPECT_TRUE(KnowsItsFace(FaceWithCorners(config.min_face_weight), config));
  EXPECT_FALSE(KnowsItsFace(FaceWithCorners(config.min_face_weight - 0.25), config));
  MapPlane m = FaceWithCorners(20);
  m.vertex_weights[2] = 1;  // hidden mostly
  EXPECT_FALSE(KnowsItsFace(m, config));
  m = FaceWithCorners(20);
  m.vertices_w.pop_back();
  EXPECT_FALSE(KnowsItsFace(m, config));
  EXPECT_FALSE(KnowsItsFace(MapPlane{}, config));
}

TEST(FaceOfAMapPlane, KeepsWhatLiesOnItAndNothingBeyond) {
  const PlaneMapConfig config;
  for (const bool reversed : {false, true}) {
    MapPlane m = FaceWithCorners(20, reversed);
    const double inside = 0.2 + 0.9 * config.face_margin_m;
    const double outside = 0.2 + 1.1 * config.face_margin_m;
    m.points_w = {{0, 0, 0},        {inside, 0.1, 0.003}, {outside, 0.1, 0},
                  {-outside, 0, 0}, {0, 0.6, 0},          {0.19, -0.14, 0}};
    KeepWhatLiesOnFace(m, config);
    ASSERT_EQ(m.points_w.size(), 3u) << reversed;
    EXPECT_DOUBLE_EQ(m.points_w[1].x(), inside);
    EXPECT_DOUBLE_EQ(m.points_w[2].x(), 0.19);
  }
}

TEST(FaceOfAMapPlane, EndsTheOutlineOnceItIsKnown) {
  PlaneWorld world;
  world.Add({0, 0, 0}, {0.2, 0, 0}, {0, 0.15, 0}, "book");
  const Frame frame =
      See(world, LookAt({0.1, -0.5, 0.6}, {0, 0, 0}), SmallCamera(), {}, Random{4}).frame;
  ASSERT_EQ(frame.planes.size(), 1u);
  const PlaneMapConfig config;
  const auto observed = [&](double corner_weight) {
    MapPlane m = StartPlane(frame.planes[0], frame);
    m.vertices_w = FaceWithCorners(0).vertices_w;
    m.vertex_weights.assign(4, corner_weight);
    m.hull_w = {{-0.2, -0.15, 0}, {0.5, 0.1, 0}, {-0.2, 0.15, 0}};  // of a stray segment, once
    ObservePlane(m, frame.planes[0], frame, config);
    return m;
  };
  const MapPlane known = observed(config.min_face_weight), unknown = observed(0.0);
  EXPECT_NEAR(known.area_m2, 0.4 * 0.3, 0.012);
  for (const Eigen::Vector3d& p_w : known.hull_w) EXPECT_LT(p_w.x(), 0.23);
  EXPECT_GT(unknown.area_m2, 0.4 * 0.3 + 0.03);
}

TEST(FaceOfAMapPlane, IsToldOfInTheEndByCornersThatWereBorneOut) {
  MapPlane m = FaceWithCorners(5);
  m.vertex_weights[1] = 0.9;
  m.vertex_weights[3] = 0.25;
  const MapPlane before = m;
  ForgetDoubtfulCorners(m, {});
  ASSERT_EQ(m.vertices_w.size(), 2u);
  EXPECT_EQ(m.vertices_w[0], before.vertices_w[0]);
  EXPECT_EQ(m.vertices_w[1], before.vertices_w[2]);
  EXPECT_EQ(m.vertex_weights, std::vector<double>({5, 5}));
}

}  // namespace
}  // namespace slam
