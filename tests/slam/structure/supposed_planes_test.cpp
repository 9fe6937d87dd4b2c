#include "slam/structure/supposed_planes.h"

#include <gtest/gtest.h>

#include "slam/mapping/plane_motion.h"
#include "slam/places/carry_map.h"
#include "slam/structure/structure.h"
#include "tests/support/map_surfaces.h"
#include "tests/support/slam_matchers.h"

namespace slam {
namespace {

/// A board 0.4 m wide, seen from above, whose right edge is a line.
struct SeenBoard {
  Pose T_cw{ExpSo3({0.3, -0.2, 0.4}), {0.2, 0.1, 0.3}};
  Frame frame;
  Map map;
  SupposedConfig config;

  SeenBoard() {
    frame.T_cw = T_cw;
    FramePlane plane;
    plane.pi_c = {Eigen::Vector3d(0, 0, -1), 1.5};
    plane.centroid_c = {0, 0, 1.5};
    plane.lines_c = {{{0.2, -0.3, 1.5}, Eigen::Vector3d::UnitY()}};
    frame.planes = {plane};
    frame.plane_matches = {{PlaneDecision::kMatched, 0, MatchReason::kParameters}};
    MapPlane landmark;
    landmark.pi_w = Transform(Inverse(T_cw), plane.pi_c);
    AddLandmark(map, landmark);
  }
  void Learn(int times) {
    for (int i = 0; i < times; ++i, ++frame.index)
      LearnSupposedPlanes(frame, 0.97, config, map);
  }
  std::vector<PlaneConstraint> Constraints() const {
    PoseProblem problem;
    AddSupposedPlanes(frame, map, config, problem);
    return problem.planes;
  }
  std::vector<SupposedPlane>& Supposed() { return map.planes.At(0).supposed; }
};

TEST(SupposedPlanes, HoldThePoseOnceAFewFramesHaveSeenThem) {
  SeenBoard board;
  board.Learn(board.config.min_observations - 1);
  ASSERT_EQ(board.Supposed().size(), 1u);
  EXPECT_TRUE(board.Constraints().empty());
  board.Learn(1);
  const auto constraints = board.Constraints();
  ASSERT_EQ(constraints.size(), 1u);
  const Plane side_c{Eigen::Vector3d::UnitX(), -0.2};
  EXPECT_THAT(constraints[0].pi_c, PlaneNear(side_c, 1e-9, 1e-9));
  EXPECT_THAT(constraints[0].pi_w,
              PlaneNear(Transform(Inverse(board.T_cw), side_c), 1e-9, 1e-9));
  EXPECT_GT(constraints[0].offset_sigma_m, board.config.offset_sigma_m);
}

TEST(SupposedPlanes, HoldThePoseAtOnceWhereTheMapBegan) {
  for (const bool began : {true, false}) {
    SeenBoard board;
    Keyframe first;
    first.frame_index = began ? board.frame.index : board.frame.index - 1;
    board.map.keyframes = {first};
    board.frame.plane_matches[0].decision = PlaneDecision::kNew;
    board.Learn(1);
    ASSERT_EQ(board.Supposed().size(), 1u);
    board.frame.plane_matches[0].decision = PlaneDecision::kMatched;
    EXPECT_EQ(board.Constraints().size(), began ? 1u : 0u);
  }
}

TEST(SupposedPlanes, AreLeftAloneByEdgesElsewhereAndByUntrustedPlanes) {
  SeenBoard board;
  board.Learn(5);
  FramePlane& plane = board.frame.planes[0];
  plane.lines_c[0].P.x() += 0.05;  // beyond the bound
  EXPECT_TRUE(board.Constraints().empty());
  board.Learn(1);
  EXPECT_EQ(board.Supposed().size(), 2u);
  plane.lines_c[0].P.x() -= 0.05;
  plane.bad = BadReason::kFar;
  EXPECT_TRUE(board.Constraints().empty());
}

TEST(SupposedPlanes, OfTwoNearAnEdgeHoldItByTheNearer) {
  SeenBoard board;
  board.config.max_offset_m = 0.005;  // to learn two
  FramePlane& plane = board.frame.planes[0];
  plane.lines_c.push_back(plane.lines_c[0]);
  plane.lines_c[1].P.x() += 0.02;
  board.Learn(5);
  ASSERT_EQ(board.Supposed().size(), 2u);
  board.config = {};  // either is near enough
  const auto constraints = board.Constraints();
  ASSERT_EQ(constraints.size(), 2u);
  for (const PlaneConstraint& c : constraints)
    EXPECT_THAT(c.pi_w, PlaneNear(Transform(Inverse(board.T_cw), c.pi_c), 1e-9, 1e-9));
}

TEST(SupposedPlanes, OfAFewFramesAreForgotten) {
  SeenBoard board;
  board.Learn(1);
  board.frame.index += board.config.max_misses + 2;
  board.frame.planes[0].lines_c.clear();
  board.Learn(1);
  EXPECT_TRUE(board.Supposed().empty());
}

TEST(SupposedPlanes, CountAFrameOnceHoweverManyLinesRunAlongTheEdge) {
  SeenBoard board;
  const Line line = board.frame.planes[0].lines_c[0];
  board.frame.planes[0].lines_c = {line, line};
  board.Learn(2);
  ASSERT_EQ(board.Supposed().size(), 1u);
  EXPECT_EQ(board.Supposed()[0].observations, 2);
}

TEST(SupposedPlanes, AreLearntByTheLandmarkThatItsOwnBecame) {
  SeenBoard board;
  MapPlane other = board.map.planes.At(0);
  const int id = AddLandmark(board.map, other);
  board.map.planes.At(0).status = LandmarkStatus::kMerged;
  board.map.planes.At(0).merged_into = id;
  board.Learn(1);
  EXPECT_TRUE(board.Supposed().empty());
  EXPECT_EQ(board.map.planes.At(id).supposed.size(), 1u);
}

TEST(SupposedPlanes, AreLearntWhereTheyHoldThePoseAlwaysOrWhenPointsFail) {
  for (const bool always : {true, false}) {
    for (const bool edges_alone : {true, false}) {
      SeenBoard board;
      StructureConfig structure;
      structure.mode = always ? StructureMode::kSupposed : StructureMode::kFree;
      structure.edges_alone = edges_alone;
      LearnStructure(board.frame, std::nullopt, 0.97, structure, board.map);
      EXPECT_EQ(board.Supposed().size(), always || edges_alone ? 1u : 0u);
    }
  }
}

TEST(SupposedPlanes, AreNotLearntFromPlanesThatAreNotTrusted) {
  SeenBoard board;
  board.frame.planes[0].bad = BadReason::kBorder;
  board.Learn(5);
  EXPECT_TRUE(board.Supposed().empty());
}

TEST(SupposedPlanes, HoldThePoseOnceInWhateverMode) {
  for (const StructureMode mode :
       {StructureMode::kFree, StructureMode::kParallel, StructureMode::kManhattan,
        StructureMode::kMixture, StructureMode::kSupposed}) {
    for (const bool edges_alone : {true, false}) {
      SeenBoard board;
      board.Learn(5);
      StructureConfig structure;
      structure.mode = mode;
      structure.edges_alone = edges_alone;
      PoseProblem problem;
      AddStructure(board.frame, board.map, structure, problem);
      AddEdgesAlone(board.frame, board.map, structure, problem);
      const bool held = edges_alone || mode == StructureMode::kSupposed;
      EXPECT_EQ(problem.planes.size(), held ? 1u : 0u) << static_cast<int>(mode);
    }
  }
}

TEST(SupposedPlanes, KnowTheirDirectionNoBetterThanAnEdgeTellsIt) {
  SeenBoard board;
  board.config.angle_sigma_rad = 0.05;
  board.Learn(100);
  const auto constraints = board.Constraints();
  ASSERT_EQ(constraints.size(), 1u);
  EXPECT_GT(constraints[0].angle_sigma_rad, 0.05);
  EXPECT_LT(constraints[0].angle_sigma_rad, 0.06);  // of 100 frames the map knows more
}

TEST(SupposedPlanes, MoveWithTheirLandmark) {
  SeenBoard board;
  board.Learn(5);
  const Pose T_new_old{ExpSo3({0.1, 0.2, -0.3}), {1, 2, 3}};
  const std::vector<PlaneConstraint> before = board.Constraints();
  MovePlane(board.map.planes.At(0), T_new_old);
  board.frame.T_cw = board.T_cw * Inverse(T_new_old);
  const auto after = board.Constraints();
  ASSERT_EQ(after.size(), 1u);
  EXPECT_THAT(after[0].pi_w, PlaneNear(Transform(T_new_old, before[0].pi_w), 1e-9, 1e-9));
  EXPECT_NEAR(after[0].offset_sigma_m, before[0].offset_sigma_m, 1e-9);
}

TEST(SupposedPlanes, AreCarriedWithTheKeyframeThatFirstSawTheirEdge) {
  // The landmark is older than the edge, and other keyframes have seen both since.
  SeenBoard board;
  for (const int frame : {0, 10, 20, 30}) {
    Keyframe keyframe;
    keyframe.id = static_cast<int>(board.map.keyframes.size());
    keyframe.frame_index = frame;
    keyframe.T_cw = board.T_cw;
    board.map.keyframes.push_back(keyframe);
  }
  for (const int frame : {10, 20, 30}) {
    board.frame.index = frame;
    board.Learn(1);
  }
  ASSERT_EQ(board.Supposed().size(), 1u);
  const Plane before = board.Supposed()[0].pi_w;
  // A closed loop moves the later ones, each differently.
  const std::vector<Pose> poses = KeyframePoses(board.map);
  const Pose T_new_old{ExpSo3({0.02, -0.05, 0.03}), {0.1, -0.2, 0.3}};
  Pose moved;
  for (std::size_t k = 1; k < board.map.keyframes.size(); ++k) {
    moved = T_new_old * moved;
    board.map.keyframes[k].T_cw = board.T_cw * Inverse(moved);
  }
  CarryPlanes(board.map, poses);
  ASSERT_EQ(board.Supposed().size(), 1u);
  EXPECT_THAT(board.Supposed()[0].pi_w, PlaneNear(Transform(T_new_old, before), 1e-9, 1e-9));
}

TEST(SupposedPlanes, AreNoBetterKnownInTheWorldThanTheCameraThatSawThem) {
  // The camera may be 0.3 m off along the normal of the edge's plane, whichever way it is turned.
  SeenBoard board;
  board.frame.pose_covariance = Matrix6d::Zero();
  (*board.frame.pose_covariance)(0, 0) = 0.09;
  board.Learn(20);
  ASSERT_EQ(board.Constraints().size(), 1u);
  const PlaneConstraint constraint = board.Constraints()[0];
  EXPECT_NEAR(constraint.world_variance_m2, 0.09, 1e-9);
  EXPECT_LT(constraint.offset_sigma_m, 0.03);  // towards the camera it is
}

}  // namespace
}  // namespace slam
