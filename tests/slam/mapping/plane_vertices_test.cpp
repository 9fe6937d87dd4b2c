#include "slam/mapping/plane_vertices.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/plane_world.h"
#include "tests/support/slam_matchers.h"

namespace slam {
namespace {

TEST(PlaneVertices, AreAveragedWhateverCornerTheObservationStartsWith) {
  MapPlane m;
  m.pi_w = {Eigen::Vector3d::UnitZ(), 0};
  const std::vector<Eigen::Vector3d> truth{{0, 0, 0}, {0.2, 0, 0}, {0.2, 0.1, 0}, {0, 0.1, 0}};
  Random random{5};
  for (std::size_t k = 0; k < 40; ++k) {
    std::vector<Vertex> seen(4);
    for (std::size_t i = 0; i < 4; ++i) {
      const std::size_t from = k % 2 == 0 ? (i + k) % 4 : (8 + k - i) % 4;
      seen[i].p_c = truth[from] + 0.002 * Eigen::Vector3d(Normal(random), Normal(random), 0);
    }
    FuseVertices(m, seen, Pose{}, {});
  }
  ASSERT_EQ(m.vertices_w.size(), 4u);
  for (const Eigen::Vector3d& v_w : m.vertices_w) {
    double nearest = 1.0;
    for (const Eigen::Vector3d& t_w : truth) nearest = std::min(nearest, (t_w - v_w).norm());
    EXPECT_LT(nearest, 0.002);  // 0.3 mm expected of the mean of forty, with a wide margin
  }
}

TEST(PlaneVertices, LeanOnThoseThatAreKnownBetterWithinThePlane) {
  const auto fused_x = [](const Eigen::Matrix3d& covariance_c) {
    MapPlane m;
    m.pi_w = {Eigen::Vector3d::UnitZ(), 0};
    std::vector<Vertex> seen{{{0, 0, 0}}, {{0.3, 0, 0}}, {{0.3, 0.1, 0}}, {{0, 0.1, 0}}};
    FuseVertices(m, seen, Pose{}, {});
    for (Vertex& v : seen) v.p_c.x() += 0.01, v.covariance_c = covariance_c;
    FuseVertices(m, seen, Pose{}, {});
    return m.vertices_w[0].x();
  };
  const Eigen::Matrix3d large = 1e-4 * Eigen::Matrix3d::Identity();
  EXPECT_NEAR(fused_x(Eigen::Matrix3d::Zero()), 0.005, 1e-12);
  EXPECT_NEAR(fused_x(large), 0.01 * (9.0 / 109.0) / (1.0 + 9.0 / 109.0), 1e-12);
  // Depth that is not known says nothing against where the plane's sides meet ...
  const Eigen::Vector3d z = Eigen::Vector3d::UnitZ(), slanted(1, 0, 1);
  EXPECT_NEAR(fused_x(1e-4 * z * z.transpose()), 0.005, 1e-12);
  // ... nor does an error along a slanted ray: the plane says where on it the corner is.
  EXPECT_NEAR(fused_x(1e-4 * slanted * slanted.transpose()), 0.005, 1e-12);
}

TEST(PlaneVertices, StayThroughASingleWrongCornerAndCanBeLeftHoweverOftenTheyWereSeen) {
  MapPlane m;
  m.pi_w = {Eigen::Vector3d::UnitZ(), 0};
  const std::vector<Vertex> usual{{{0, 0, 0}}, {{0.2, 0, 0}}, {{0.2, 0.1, 0}}, {{0, 0.1, 0}}};
  std::vector<Vertex> other = usual;
  other[1].p_c.x() = 0.3;
  for (int i = 0; i < 500; ++i) FuseVertices(m, usual, Pose{}, {});
  FuseVertices(m, other, Pose{}, {});
  EXPECT_THAT(m.vertices_w[1], VectorNear(usual[1].p_c, 1e-9));
  for (int i = 0; i < 40; ++i) FuseVertices(m, other, Pose{}, {});
  EXPECT_THAT(m.vertices_w[1], VectorNear(other[1].p_c, 1e-9));
}

TEST(PlaneVertices, CountAnExtrapolatedCornerAsAQuarterOfASeenOne) {
  MapPlane m;
  m.pi_w = {Eigen::Vector3d::UnitZ(), 0};
  std::vector<Vertex> seen{{{0, 0, 0}}, {{0.2, 0, 0}}, {{0.2, 0.1, 0}}, {{0, 0.1, 0}}};
  FuseVertices(m, seen, Pose{}, {});
  for (Vertex& vertex : seen) vertex.extrapolated = true, vertex.p_c.x() += 0.01;
  FuseVertices(m, seen, Pose{}, {});
  EXPECT_THAT(m.vertices_w[0], VectorNear(Eigen::Vector3d(0.01 * 0.25 / 1.25, 0, 0), 1e-12));
  EXPECT_DOUBLE_EQ(m.vertex_weights[0], 1.25);
}

TEST(PlaneVertices, WeighEachCornerByItsOwnObservationWhereverThatStands) {
  MapPlane m;
  m.pi_w = {Eigen::Vector3d::UnitZ(), 0};
  std::vector<Vertex> seen{{{0, 0, 0}}, {{0.2, 0, 0}}, {{0.2, 0.1, 0}}, {{0, 0.1, 0}}};
  FuseVertices(m, seen, Pose{}, {});
  seen[1].extrapolated = true;
  for (Vertex& vertex : seen) vertex.p_c.x() += 0.01;
  std::reverse(seen.begin(), seen.end());
  FuseVertices(m, seen, Pose{}, {});
  EXPECT_EQ(m.vertex_weights, std::vector<double>({2, 1.25, 2, 2}));
  EXPECT_NEAR(m.vertices_w[1].x(), 0.2 + 0.01 * 0.25 / 1.25, 1e-12);
  EXPECT_NEAR(m.vertices_w[2].x(), 0.2 + 0.01 / 2, 1e-12);
}

TEST(PlaneVertices, AreBorneOutByCornersOfAFaceSeenInPart) {
  MapPlane m;
  m.pi_w = {Eigen::Vector3d::UnitZ(), 0};
  const std::vector<Vertex> whole{{{0, 0, 0}}, {{0.3, 0, 0}}, {{0.3, 0.1, 0}}, {{0, 0.1, 0}}};
  const std::vector<Vertex> part{{{0.31, 0.1, 0.002}}, {{0.1, 0, 0}}};
  FuseVertices(m, part, Pose{}, {});
  EXPECT_TRUE(m.vertices_w.empty());  // a part starts nothing
  FuseVertices(m, whole, Pose{}, {});
  FuseVertices(m, part, Pose{}, {});
  EXPECT_THAT(m.vertices_w[2], VectorNear(Eigen::Vector3d(0.305, 0.1, 0), 1e-12));
  EXPECT_EQ(m.vertex_weights, std::vector<double>({1, 1, 2, 1}));  // the other is at none
  std::vector<Vertex> guessed = part;
  guessed[0].extrapolated = true;
  FuseVertices(m, guessed, Pose{}, {});
  EXPECT_EQ(m.vertex_weights, std::vector<double>({1, 1, 2, 1}));
}

TEST(PlaneVertices, ArePoorlyBorneOutByWhatATurnedCameraKnowsPoorlyWithinThePlane) {
  // The plane's normal is the camera's x; depth, which lies in the plane, is what it errs in.
  Pose T_wc;
  T_wc.R << 0, 1, 0, 0, 0, 1, 1, 0, 0;
  const std::vector<Eigen::Vector3d> corners_w{
      {0, 0, 0}, {0.3, 0, 0}, {0.3, 0.1, 0}, {0, 0.1, 0}};
  for (const std::size_t again : {2u, 4u}) {  // a part of the face, or all of it
    MapPlane m;
    m.pi_w = {Eigen::Vector3d::UnitZ(), 0};
    std::vector<Vertex> seen(4);
    for (std::size_t i = 0; i < 4; ++i) seen[i].p_c = Inverse(T_wc) * corners_w[i];
    FuseVertices(m, seen, T_wc, {});
    seen.resize(again);
    for (Vertex& vertex : seen) {
      vertex.covariance_c(0, 0) = 1e-4;  // which the plane takes away
      vertex.covariance_c(2, 2) = 2e-4;  // 10 mm, as the mean of two directions
    }
    FuseVertices(m, seen, T_wc, {});
    for (std::size_t i = 0; i < 4; ++i)
      EXPECT_NEAR(m.vertex_weights[i], i < again ? 1 + 9.0 / 109.0 : 1, 1e-12) << i;
  }
}

TEST(PlaneVertices, LeaveAWrongStartOnceTheEvidenceIsAgainstIt) {
  MapPlane m;
  m.pi_w = {Eigen::Vector3d::UnitZ(), 0};
  std::vector<Vertex> cut{{{0, 0, 0}}, {{0.1, 0, 0}}, {{0.1, 0.1, 0}}, {{0, 0.1, 0}}};
  std::vector<Vertex> whole{{{0, 0, 0}}, {{0.3, 0, 0}}, {{0.3, 0.1, 0}}, {{0, 0.1, 0}}};
  for (int i = 0; i < 2; ++i) FuseVertices(m, cut, Pose{}, {});
  std::vector<Vertex> from_another_side = whole;  // seen corners start anywhere
  std::rotate(from_another_side.begin(), from_another_side.begin() + 1,
              from_another_side.end());
  for (int i = 0; i < 5; ++i) FuseVertices(m, from_another_side, Pose{}, {});
  EXPECT_THAT(m.vertices_w[1], VectorNear(whole[1].p_c, 1e-9));
  EXPECT_THAT(m.vertices_w[2], VectorNear(whole[2].p_c, 1e-9));
}

}  // namespace
}  // namespace slam
