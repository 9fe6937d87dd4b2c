#include "slam/structure/parallel_planes.h"

#include <gtest/gtest.h>

#include "tests/support/map_surfaces.h"
#include "tests/support/slam_matchers.h"

namespace slam {
namespace {

/// A plane that a turned camera sees facing it, matched with landmark 0.
struct SeenPlaneWithOthers {
  Frame frame;
  Map map;
  ParallelConfig config;

  SeenPlaneWithOthers() {
    frame.T_cw = {ExpSo3({0.3, -0.2, 0.4}), {0.2, 0.1, 0.3}};
    FramePlane plane;
    plane.pi_c = {Eigen::Vector3d(0, 0, -1), 2.0};
    plane.angle_sigma_rad = 0.002;
    plane.area_m2 = 0.1;
    frame.planes = {plane};
    frame.plane_matches = {{PlaneDecision::kMatched, 0, MatchReason::kParameters}};
    Add({0, 0, -1});
  }
  /// @param n_c  the landmark's normal as it should be seen
  int Add(const Eigen::Vector3d& n_c) {
    MapPlane m;
    m.pi_w.n = frame.T_cw.R.transpose() * n_c.normalized();
    m.area_m2 = 1.0;
    m.observations = 50;
    return AddLandmark(map, m);
  }
  PoseProblem Problem() const {
    PoseProblem problem;
    AddParallelPlanes(frame, map, config, problem);
    return problem;
  }
};

TEST(ParallelPlanes, TieAPlaneToThoseNearlyParallelOrAtARightAngleToIt) {
  SeenPlaneWithOthers seen;
  const double off = 0.008;
  const int parallel = seen.Add({off, 0, -1}), opposite = seen.Add({0, off, 1});
  const int right = seen.Add({1, 0, off});
  seen.Add({1, 0, 1});
  const PoseProblem problem = seen.Problem();
  ASSERT_EQ(problem.parallels.size(), 2u);
  EXPECT_THAT(problem.parallels[0].n_w, VectorNear(seen.map.planes.At(parallel).pi_w.n, 1e-12));
  EXPECT_THAT(problem.parallels[1].n_w, VectorNear(seen.map.planes.At(opposite).pi_w.n, 1e-12));
  ASSERT_EQ(problem.perpendiculars.size(), 1u);
  EXPECT_THAT(problem.perpendiculars[0].n_w,
              VectorNear(seen.map.planes.At(right).pi_w.n, 1e-12));
}

TEST(ParallelPlanes, LeaveOutWhatIsFarFromParallelOrMoreThanItsErrorsExplain) {
  SeenPlaneWithOthers seen;
  seen.Add({0.03, 0, -1});  // near enough, but known to be no parallel
  EXPECT_TRUE(seen.Problem().parallels.empty());
  seen.frame.planes[0].angle_sigma_rad = 0.02;
  EXPECT_EQ(seen.Problem().parallels.size(), 1u);
  seen.frame.planes[0].angle_sigma_rad = 0.002;
  seen.frame.planes[0].bend_angle_sigma_rad = 0.02;  // as the sensor may have bent it
  EXPECT_EQ(seen.Problem().parallels.size(), 1u);
  seen.frame.planes[0].bend_angle_sigma_rad = 0.0;
  EXPECT_TRUE(seen.Problem().parallels.empty());
  MapPlane& other = seen.map.planes.At(1);  // as the map may know it
  AddObservation(other.estimate, other.pi_w, Eigen::Vector3d::Zero(), 0.02, 0.01, 1.0);
  EXPECT_EQ(seen.Problem().parallels.size(), 1u);
  seen.Add({0.1, 0, -1});  // too far, however little is known
  seen.frame.planes[0].angle_sigma_rad = 0.2;
  EXPECT_EQ(seen.Problem().parallels.size(), 1u);
}

// Their errors have the frame plane's normal in common, so more of them say no more.
TEST(ParallelPlanes, ManyWeighTogetherAsMuchAsOne) {
  SeenPlaneWithOthers seen;
  seen.Add({0, 0, -1});
  seen.Add({1, 0, 0});
  const PoseProblem one = seen.Problem();
  for (int i = 0; i < 3; ++i) seen.Add({0, 0, 1});
  for (int i = 0; i < 8; ++i) seen.Add({0, 1, 0});
  const PoseProblem many = seen.Problem();
  const auto information = [](const std::vector<DirectionConstraint>& factors) {
    double sum = 0.0;
    for (const DirectionConstraint& c : factors) sum += 1 / (c.sigma_rad * c.sigma_rad);
    return sum;
  };
  ASSERT_EQ(many.parallels.size(), 4u);
  ASSERT_EQ(many.perpendiculars.size(), 9u);
  const double before = information(one.parallels);
  EXPECT_NEAR(information(many.parallels), before, 1e-9 * before);
  EXPECT_NEAR(information(many.perpendiculars), before, 1e-9 * before);
}

// Another plane of the frame has a normal of its own, so it changes nothing.
TEST(ParallelPlanes, OfEachPlaneWeighAsIfTheFrameHadNoOther) {
  SeenPlaneWithOthers seen;
  for (const Eigen::Vector3d& n_c : {Eigen::Vector3d(0, 1, 0), Eigen::Vector3d(0, -1, 0),
                                     Eigen::Vector3d(0, 0, 1), Eigen::Vector3d(1, 0, 0)}) {
    seen.Add(n_c);
  }
  FramePlane side = seen.frame.planes[0];
  side.pi_c.n = {1, 0, 0};
  const PlaneMatch as_side{PlaneDecision::kMatched, seen.Add(side.pi_c.n),
                           MatchReason::kParameters};
  const PoseProblem first = seen.Problem();
  SeenPlaneWithOthers other = seen;
  other.frame.planes = {side};
  other.frame.plane_matches = {as_side};
  const PoseProblem second = other.Problem();
  seen.frame.planes.push_back(side);
  seen.frame.plane_matches.push_back(as_side);
  const PoseProblem both = seen.Problem();

  const auto expect_joined = [](const std::vector<DirectionConstraint>& whole,
                                std::vector<DirectionConstraint> parts,
                                const std::vector<DirectionConstraint>& more) {
    ASSERT_FALSE(parts.empty());
    ASSERT_FALSE(more.empty());
    parts.insert(parts.end(), more.begin(), more.end());
    ASSERT_EQ(whole.size(), parts.size());
    for (std::size_t i = 0; i < parts.size(); ++i) {
      EXPECT_THAT(whole[i].n_w, VectorNear(parts[i].n_w, 1e-12));
      EXPECT_THAT(whole[i].n_c, VectorNear(parts[i].n_c, 1e-12));
      EXPECT_NEAR(whole[i].sigma_rad, parts[i].sigma_rad, 1e-12) << i;
    }
  };
  expect_joined(both.parallels, first.parallels, second.parallels);
  expect_joined(both.perpendiculars, first.perpendiculars, second.perpendiculars);
}

TEST(ParallelPlanes, LeaveOutSmallOnesAndOnesThatWereRarelySeen) {
  SeenPlaneWithOthers seen;
  const int other = seen.Add({0, 0, -1});
  ASSERT_EQ(seen.Problem().parallels.size(), 1u);
  seen.map.planes.At(other).observations = seen.config.min_observations - 1;
  EXPECT_TRUE(seen.Problem().parallels.empty());
  seen.map.planes.At(other).observations = 50;
  seen.frame.planes[0].area_m2 = seen.config.min_area_m2;
  EXPECT_TRUE(seen.Problem().parallels.empty());
}

}  // namespace
}  // namespace slam
