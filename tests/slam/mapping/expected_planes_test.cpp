// What of the map a camera should see.
#include "slam/mapping/expected_planes.h"
#include "tests/support/map_surfaces.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

namespace slam {
namespace {

/// A level face of 0.4 m x 0.3 m, 1 m below a camera that looks straight down at its middle.
MapPlane Face(const PlaneMapConfig& config) {
  MapPlane m;
  m.pi_w = {Eigen::Vector3d(0, 0, -1), 1.0};
  m.centroid_w = {0, 0, 1};
  m.vertices_w = {{-0.2, -0.15, 1}, {0.2, -0.15, 1}, {0.2, 0.15, 1}, {-0.2, 0.15, 1}};
  m.vertex_weights.assign(4, config.min_face_weight);
  m.hull_w = {{-0.1, -0.1, 1}, {0.1, -0.1, 1}, {0.1, 0.1, 1}};
  m.observations = config.min_fused_observations;
  return m;
}

Map MapOf(const MapPlane& plane) {
  Map map;
  AddLandmark(map, plane);
  return map;
}

TEST(ExpectedPlanes, LieWhereTheCameraSeesThem) {
  const PlaneMapConfig config;
  const Camera camera;
  Pose T_cw;
  T_cw.R = Eigen::AngleAxisd(0.2, Eigen::Vector3d(1, 2, 0).normalized()).toRotationMatrix();
  T_cw.t = {0.05, -0.1, 0.3};
  const MapPlane face = Face(config);
  const std::vector<ExpectedPlane> expected = ExpectPlanes(MapOf(face), T_cw, camera, config);
  ASSERT_EQ(expected.size(), 1u);
  ASSERT_EQ(expected[0].outline_px.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    const Eigen::Vector3d corner_c = T_cw.R * face.vertices_w[i] + T_cw.t;
    EXPECT_NEAR(SignedDistance(expected[0].pi_c, corner_c), 0.0, 1e-12);
    const Eigen::Vector2d u(camera.fx * corner_c.x() / corner_c.z() + camera.cx,
                            camera.fy * corner_c.y() / corner_c.z() + camera.cy);
    EXPECT_LT((expected[0].outline_px[i] - u).norm(), 1e-9);
  }
  EXPECT_GT(expected[0].margin_px, 1.0);
}

TEST(ExpectedPlanes, HaveTheirHullForAnOutlineUntilTheirFaceIsKnown) {
  const PlaneMapConfig config;
  MapPlane face = Face(config);
  const Camera camera;
  const double known_px = ExpectPlanes(MapOf(face), Pose(), camera, config).at(0).margin_px;
  face.vertex_weights[1] = 0.5 * config.min_face_weight;
  const ExpectedPlane at = ExpectPlanes(MapOf(face), Pose(), camera, config).at(0);
  ASSERT_EQ(at.outline_px.size(), 3u);
  EXPECT_NEAR(at.outline_px[0].x(), camera.cx - 0.1 * camera.fx, 1e-9);
  EXPECT_GT(at.margin_px, known_px);
}

TEST(ExpectedPlanes, AreFrontsOfLandmarksThatWereSeenOften) {
  const PlaneMapConfig config;
  const Camera camera;
  const auto count = [&](const MapPlane& m) {
    return ExpectPlanes(MapOf(m), Pose(), camera, config).size();
  };
  EXPECT_EQ(count(Face(config)), 1u);
  MapPlane m = Face(config);
  m.pi_w = {-m.pi_w.n, -m.pi_w.d};
  EXPECT_EQ(count(m), 0u) << "its back";
  m = Face(config);
  m.observations = config.min_fused_observations - 1;
  EXPECT_EQ(count(m), 0u) << "hardly seen";
  m = Face(config);
  m = Face(config);
  m.centroid_w.z() = -1.0;
  EXPECT_EQ(count(m), 0u) << "behind the camera";
  Map map;
  map.planes.Add(Face(config));
  EXPECT_TRUE(ExpectPlanes(map, Pose(), camera, config).empty()) << "on trial";
}

TEST(ExpectedPlanes, HaveNoOutlineWhereItCannotBeDrawn) {
  const PlaneMapConfig config;
  const Camera camera;
  MapPlane m = Face(config);
  m.vertices_w[0].z() = -0.5;  // behind the camera
  std::vector<ExpectedPlane> expected = ExpectPlanes(MapOf(m), Pose(), camera, config);
  ASSERT_EQ(expected.size(), 1u) << "others may be told from it";
  EXPECT_TRUE(expected[0].outline_px.empty());
  m = Face(config);
  for (Eigen::Vector3d& corner_w : m.vertices_w) corner_w.x() += 5.0;
  expected = ExpectPlanes(MapOf(m), Pose(), camera, config);
  ASSERT_EQ(expected.size(), 1u);
  EXPECT_TRUE(expected[0].outline_px.empty()) << "beside the image";
}

}  // namespace
}  // namespace slam
