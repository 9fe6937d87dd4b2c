#include "slam/places/pose_graph.h"

#include <gmock/gmock.h>

#include <cmath>

#include "slam/base/random.h"
#include "tests/support/slam_matchers.h"

namespace slam {
namespace {

Pose AnyPose(Random& random, double m, double rad) {
  Vector6d xi;
  for (int i = 0; i < 6; ++i) xi[i] = (2 * random.Uniform() - 1) * (i < 3 ? m : rad);
  return Exp(xi);
}

/// Poses on a walk, and edges between neighbours and every fifth.
struct Walk {
  std::vector<Pose> truth;
  std::vector<PoseEdge> edges;
};

Walk AnyWalk(int count) {
  Walk walk;
  Random random{31};
  walk.truth.push_back(Pose{});
  for (int i = 1; i < count; ++i) {
    walk.truth.push_back(AnyPose(random, 0.3, 0.4) * walk.truth.back());
  }
  for (int i = 0; i < count; ++i) {
    for (const int step : {1, 5}) {
      if (i + step >= count) continue;
      const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(i + step);
      walk.edges.push_back({i, i + step, walk.truth[a] * Inverse(walk.truth[b])});
    }
  }
  return walk;
}

TEST(PoseGraph, FindsTheTruthWhenAllEdgesAgree) {
  const Walk walk = AnyWalk(30);
  std::vector<Pose> poses = walk.truth;
  Random random{7};
  for (std::size_t i = 1; i < poses.size(); ++i) {
    poses[i] = AnyPose(random, 0.1, 0.1) * poses[i];
  }
  ASSERT_TRUE(OptimisePoseGraph(poses, walk.edges));
  for (std::size_t i = 0; i < poses.size(); ++i) {
    EXPECT_THAT(poses[i], PoseNear(walk.truth[i], 1e-6, 1e-6));
  }
}

// The error of a loop of equal edges is shared equally: pencil and paper.
TEST(PoseGraph, SpreadsTheErrorOfALoopEvenly) {
  std::vector<Pose> poses(4);
  for (int i = 0; i < 4; ++i) poses[static_cast<std::size_t>(i)].t.x() = -i;
  std::vector<PoseEdge> edges;
  for (int i = 0; i < 3; ++i) edges.push_back({i, i + 1, Pose{}});
  for (PoseEdge& edge : edges) edge.T_ij = Pose{Eigen::Matrix3d::Identity(), {1.0, 0, 0}};
  // The last one says 2.8 m from the first to the last instead of 3: 0.05 m for each edge.
  edges.push_back({0, 3, Pose{Eigen::Matrix3d::Identity(), {2.8, 0, 0}}});
  ASSERT_TRUE(OptimisePoseGraph(poses, edges));
  EXPECT_NEAR(poses[1].t.x(), -0.95, 1e-6);
  EXPECT_NEAR(poses[2].t.x(), -1.90, 1e-6);
  EXPECT_NEAR(poses[3].t.x(), -2.85, 1e-6);
}

TEST(PoseGraph, TheFirstPoseStaysAndTheLooseOnesToo) {
  Walk walk = AnyWalk(6);
  std::vector<Pose> poses = walk.truth;
  poses.push_back(Pose{ExpSo3({0, 1, 0}), {5, 5, 5}});
  const Pose loose = poses.back();
  poses[3].t.x() += 0.2;
  ASSERT_TRUE(OptimisePoseGraph(poses, walk.edges));
  EXPECT_EQ(poses[0].t, walk.truth[0].t);
  EXPECT_THAT(poses.back(), PoseNear(loose, 1e-12, 1e-12));
}

TEST(PoseGraph, OfNothingIsSolved) {
  std::vector<Pose> none;
  EXPECT_TRUE(OptimisePoseGraph(none, {}));
  EXPECT_TRUE(none.empty());
}

TEST(PoseGraph, LeavesThePosesAsTheyAreWhenAnEdgeIsNoNumber) {
  Walk walk = AnyWalk(6);
  std::vector<Pose> poses = walk.truth;
  poses[3].t.x() += 0.2;
  const std::vector<Pose> before = poses;
  walk.edges[2].T_ij.t.y() = std::nan("");
  EXPECT_FALSE(OptimisePoseGraph(poses, walk.edges));
  for (std::size_t i = 0; i < poses.size(); ++i) {
    EXPECT_EQ(poses[i].t, before[i].t) << i;
    EXPECT_EQ(poses[i].R, before[i].R) << i;
  }
}

TEST(PoseGraph, AnEdgeToNowhereIsRefused) {
  std::vector<Pose> poses(2);
  EXPECT_THROW(OptimisePoseGraph(poses, {{0, 2, {}}}), std::invalid_argument);
  EXPECT_THROW(OptimisePoseGraph(poses, {{1, 1, {}}}), std::invalid_argument);
}

}  // namespace
}  // namespace slam
