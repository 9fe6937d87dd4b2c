#include <gmock/gmock.h>

#include "slam/base/random.h"
#include "slam/structure/manhattan_mixture.h"
#include "slam/structure/manhattan_world.h"
#include "slam/structure/structure.h"
#include "tests/support/map_surfaces.h"
#include "tests/support/plane_world.h"
#include "tests/support/slam_matchers.h"

namespace slam {
namespace {

const Eigen::Matrix3d kAxes_w = ExpSo3({0.4, -0.3, 0.6});
const Pose kT_cw{ExpSo3({0.2, 0.5, -0.1}), {0.1, 0.2, 0.3}};
constexpr double kDegree = M_PI / 180;

/// Landmarks with these normals, and a keyframe and a frame that see all of them.
struct SeenWorld {
  Map map;
  Frame frame;
  ManhattanConfig config;

  explicit SeenWorld(const std::vector<Eigen::Vector3d>& normals_w) {
    map.keyframes.emplace_back();
    map.keyframes[0].T_cw = kT_cw;
    frame.T_cw = kT_cw;
    for (const Eigen::Vector3d& n_w : normals_w) {
      MapPlane m;
      m.pi_w.n = n_w.normalized();
      m.area_m2 = 1.0;
      m.observations = 10;
      FramePlane plane;
      plane.pi_c.n = kT_cw.R * m.pi_w.n;
      plane.angle_sigma_rad = 0.002;
      plane.area_m2 = 0.5;
      frame.planes.push_back(plane);
      frame.plane_matches.push_back(
          {PlaneDecision::kMatched, AddLandmark(map, m), MatchReason::kParameters});
    }
  }
  PoseProblem Problem(StructureMode mode) const {
    PoseProblem problem;
    StructureConfig structure;
    structure.mode = mode;
    AddStructure(frame, map, structure, problem);
    return problem;
  }
  void Learn(StructureMode mode) {
    StructureConfig structure;
    structure.mode = mode;
    LearnStructure(frame, 0, 0.97, structure, map);
  }
};

/// The six sides of a room; those opposite are parallel.
std::vector<Eigen::Vector3d> Room() {
  return {kAxes_w.col(0), -kAxes_w.col(0), kAxes_w.col(1), kAxes_w.col(2), -kAxes_w.col(2)};
}

double AngleOf(const Eigen::Matrix3d& R) { return LogSo3(R).norm(); }

TEST(ManhattanWorld, IsFoundFromNoisyNormalsToWhatTheyAverageTo) {
  Random random{7};
  SeenWorld world({});
  constexpr double kNoise = 0.5 * kDegree;
  for (int i = 0; i < 30; ++i) {
    MapPlane m;
    m.area_m2 = 1.0;
    m.observations = 10;
    const Eigen::Vector3d turn(Normal(random), Normal(random), Normal(random));
    m.pi_w.n = ExpSo3(kNoise * turn) * (i % 2 ? -1.0 : 1.0) * kAxes_w.col(i % 3);
    AddLandmark(world.map, m);
  }
  const auto found = FindManhattanAxes(world.map.planes, world.config);
  ASSERT_TRUE(found);
  // Axes come in the order of the first pair, either way: each is near one of the true.
  for (int k = 0; k < 3; ++k) {
    const double cosine = (kAxes_w.transpose() * found->col(k)).cwiseAbs().maxCoeff();
    EXPECT_LT(std::acos(std::min(1.0, cosine)), 4 * kNoise / std::sqrt(10.0)) << k;
  }
}

TEST(ManhattanWorld, IsNotThereWithOneOrTwoDirectionsOrWithoutRightAngles) {
  const ManhattanConfig config;
  const Eigen::Vector3d a = kAxes_w.col(0), b = kAxes_w.col(1);
  for (const auto& normals :
       std::vector<std::vector<Eigen::Vector3d>>{{},
                                                 {a},
                                                 {a, -a},
                                                 {a, b},
                                                 {a, -a, b},
                                                 {a, a + b, a + 2 * b},
                                                 {a, b, kAxes_w.col(2) + 0.2 * a}}) {
    EXPECT_FALSE(FindManhattanAxes(SeenWorld(normals).map.planes, config)) << normals.size();
  }
  EXPECT_TRUE(FindManhattanAxes(SeenWorld(Room()).map.planes, config));
}

TEST(ManhattanWorld, WaitsForAreaAlongAllThreeAxesAndForLandmarksThatWereSeenOften) {
  SeenWorld world(Room());
  world.map.planes.At(2).area_m2 = 0.1;
  EXPECT_FALSE(FindManhattanAxes(world.map.planes, world.config));
  world.map.planes.At(2).area_m2 = 1.0;
  world.map.planes.At(2).observations = 2;
  EXPECT_FALSE(FindManhattanAxes(world.map.planes, world.config));
}

TEST(ManhattanWorld, GoesByLargePlanesMoreThanBySmallOnes) {
  SeenWorld world(Room());
  for (MapPlane& plane : world.map.planes) plane.area_m2 = 10.0;
  MapPlane small;
  small.pi_w.n = ExpSo3(2 * kDegree * kAxes_w.col(2)) * kAxes_w.col(0);
  small.area_m2 = 0.1;
  small.observations = 10;
  AddLandmark(world.map, small);
  const auto found = FindManhattanAxes(world.map.planes, world.config);
  ASSERT_TRUE(found);
  for (int k = 0; k < 3; ++k) {
    const double cosine = (kAxes_w.transpose() * found->col(k)).cwiseAbs().maxCoeff();
    EXPECT_LT(std::acos(std::min(1.0, cosine)), 0.05 * kDegree) << k;
  }
}

TEST(ManhattanWorld, PullsATurnedFrameBackOntoItsAxes) {
  SeenWorld world(Room());
  world.Learn(StructureMode::kManhattan);
  ASSERT_EQ(world.map.manhattan.size(), 1u);
  world.frame.T_cw.R = ExpSo3({0.01, -0.015, 0.01}) * kT_cw.R;
  const PoseProblem problem = world.Problem(StructureMode::kManhattan);
  ASSERT_EQ(problem.rotations.size(), 1u);
  EXPECT_LT(AngleOf(problem.rotations[0].R_cw * kT_cw.R.transpose()), 1e-6);
  // No axis is known better than how square things are; two axes tell each turn.
  const Eigen::Matrix3d& S = problem.rotations[0].sqrt_information;
  const double most = 2 / std::pow(world.config.axis_sigma_rad, 2);
  EXPECT_LT((S.transpose() * S).trace(), 3 * most);
  EXPECT_GT((S.transpose() * S).trace(), 0.5 * 3 * most);
}

TEST(ManhattanWorld, SaysNothingOfTurnsThatNoPlaneOfTheFrameShows) {
  SeenWorld world(Room());
  world.Learn(StructureMode::kManhattan);
  // A frame of two opposite sides, and one of a plane off all axes.
  world.frame.planes.resize(2);
  const PoseProblem two = world.Problem(StructureMode::kManhattan);
  ASSERT_EQ(two.rotations.size(), 1u);
  EXPECT_LT((two.rotations[0].sqrt_information * kT_cw.R * kAxes_w.col(0)).norm(), 1e-3);
  world.frame.planes.resize(1);
  world.frame.planes[0].pi_c.n = ExpSo3({0.2, 0.2, 0.2}) * world.frame.planes[0].pi_c.n;
  EXPECT_TRUE(world.Problem(StructureMode::kManhattan).rotations.empty());
  world.frame.planes.clear();
  EXPECT_TRUE(world.Problem(StructureMode::kManhattan).rotations.empty());
}

TEST(ManhattanWorld, IgnoresTiltedPlanes) {
  SeenWorld world(Room());
  world.Learn(StructureMode::kManhattan);
  const PoseProblem before = world.Problem(StructureMode::kManhattan);
  FramePlane tilted = world.frame.planes[0];
  tilted.pi_c.n = kT_cw.R * ExpSo3(10 * kDegree * kAxes_w.col(1)) * kAxes_w.col(0);
  world.frame.planes.push_back(tilted);
  world.frame.plane_matches.emplace_back();
  const PoseProblem after = world.Problem(StructureMode::kManhattan);
  EXPECT_EQ(after.rotations.at(0).R_cw, before.rotations.at(0).R_cw);
}

TEST(ManhattanWorld, DoesNotAskPlanesThatAreNotTrusted) {
  SeenWorld world(Room());
  world.Learn(StructureMode::kManhattan);
  const PoseProblem before = world.Problem(StructureMode::kManhattan);
  // Near an axis, large and sharp: what it said would count for more than all the others.
  FramePlane bad = world.frame.planes[0];
  bad.pi_c.n = kT_cw.R * ExpSo3(2 * kDegree * kAxes_w.col(1)) * kAxes_w.col(0);
  bad.angle_sigma_rad = 1e-4, bad.area_m2 = 5.0;
  world.frame.planes.push_back(bad);
  world.frame.plane_matches.emplace_back();
  for (const BadReason why : {BadReason::kFar, BadReason::kInliers, BadReason::kBorder,
                              BadReason::kStructure, BadReason::kUnstructured}) {
    world.frame.planes.back().bad = why;
    const PoseProblem after = world.Problem(StructureMode::kManhattan);
    EXPECT_EQ(after.rotations.at(0).R_cw, before.rotations.at(0).R_cw);
    EXPECT_EQ(after.rotations.at(0).sqrt_information, before.rotations.at(0).sqrt_information);
  }
  world.frame.planes.back().bad.reset();
  const Eigen::Matrix3d R_cw = world.Problem(StructureMode::kManhattan).rotations.at(0).R_cw;
  EXPECT_GT(AngleOf(R_cw * kT_cw.R.transpose()), 0.2 * kDegree) << "it says nothing anyway";
}

// The mean that is most likely: of a sharp plane and one three times less certain, 1 : 9.
TEST(ManhattanWorld, GoesByPlanesOfAnAxisAsWellAsTheyKnowTheirNormals) {
  SeenWorld world({kAxes_w.col(0), kAxes_w.col(0)});
  const double off = 1 * kDegree;
  world.frame.planes[0].angle_sigma_rad = 0.002, world.frame.planes[1].angle_sigma_rad = 0.006;
  world.frame.planes[1].pi_c.n = kT_cw.R * ExpSo3(off * kAxes_w.col(1)) * kAxes_w.col(0);
  const auto axes = SeenAxes(world.frame, kAxes_w, world.config);
  ASSERT_EQ(axes.size(), 1u);
  const Eigen::Vector3d n_c = kT_cw.R * ExpSo3(0.1 * off * kAxes_w.col(1)) * kAxes_w.col(0);
  EXPECT_THAT(axes[0].n_c, VectorNear(n_c, 1e-5));
  const double mean_rad = 0.002 * 0.006 / std::hypot(0.002, 0.006);
  EXPECT_NEAR(axes[0].sigma_rad, std::hypot(mean_rad, world.config.axis_sigma_rad), 1e-9);
}

TEST(ManhattanWorld, IsTheOneThatWasFoundFirst) {
  SeenWorld world(Room());
  world.Learn(StructureMode::kManhattan);
  ASSERT_EQ(world.map.manhattan.size(), 1u);
  const Eigen::Matrix3d found = world.map.manhattan[0].axes_k;
  for (MapPlane& plane : world.map.planes)
    plane.pi_w.n = ExpSo3(2 * kDegree * kAxes_w.col(2)) * plane.pi_w.n;
  world.Learn(StructureMode::kManhattan);
  ASSERT_EQ(world.map.manhattan.size(), 1u);
  EXPECT_EQ(world.map.manhattan[0].axes_k, found);
}

TEST(RotationFromAxes, IsNoneWhereAxesAreSoFarOffThatTheyMayBeConfused) {
  for (const double off_rad : {0.4, 0.6}) {
    std::vector<AxisObservation> axes;
    for (int k = 0; k < 3; ++k)
      axes.push_back({kAxes_w.col(k), kT_cw.R * kAxes_w.col(k), 0.01});
    const Eigen::Vector3d about = Eigen::Vector3d(1, 2, -1).normalized();
    // Each axis is off by less than the turn: it is not at a right angle to it.
    const auto found = RotationFromAxes(axes, ExpSo3(1.1 * off_rad * about) * kT_cw.R);
    ASSERT_EQ(found.has_value(), off_rad < 0.5) << off_rad;
    if (!found) continue;
    EXPECT_LT(AngleOf(found->R_cw * kT_cw.R.transpose()), 1e-8);
  }
}

TEST(ManhattanWorld, TurnsWithTheKeyframeThatHoldsIt) {
  SeenWorld world(Room());
  world.Learn(StructureMode::kManhattan);
  const Eigen::Matrix3d moved = ExpSo3({0.0, 0.02, 0.0});
  world.map.keyframes[0].T_cw.R = moved * kT_cw.R;
  EXPECT_LT(AngleOf(world.Problem(StructureMode::kManhattan).rotations.at(0).R_cw *
                    (moved.transpose() * kT_cw.R).transpose()),
            0.05);
  EXPECT_GT(AngleOf(world.Problem(StructureMode::kManhattan).rotations.at(0).R_cw *
                    kT_cw.R.transpose()),
            0.015);
}

TEST(ManhattanMixture, KnowsTwoPlanesAgainByTheirLandmarksAndGivesTheWholeRotation) {
  const Eigen::Vector3d tilted = ExpSo3({0.3, 0.1, 0.2}) * kAxes_w.col(0);
  SeenWorld world({kAxes_w.col(0), kAxes_w.col(1), tilted});
  EXPECT_TRUE(world.Problem(StructureMode::kMixture).rotations.empty());
  world.Learn(StructureMode::kMixture);
  ASSERT_EQ(world.map.manhattan.size(), 1u);
  EXPECT_THAT(world.map.manhattan[0].landmarks, testing::ElementsAre(0, 1, kNone));
  world.frame.T_cw.R = ExpSo3({0.02, -0.03, 0.01}) * kT_cw.R;
  const PoseProblem problem = world.Problem(StructureMode::kMixture);
  ASSERT_EQ(problem.rotations.size(), 1u);
  EXPECT_LT(AngleOf(problem.rotations[0].R_cw * kT_cw.R.transpose()), 1e-6);
  // With one of the two alone it says nothing.
  world.frame.plane_matches[1] = {};
  EXPECT_TRUE(world.Problem(StructureMode::kMixture).rotations.empty());
}

TEST(ManhattanMixture, StoresTriplesOnceAndTakesTheOneOfMostLandmarks) {
  SeenWorld world({kAxes_w.col(0), kAxes_w.col(1), kAxes_w.col(2)});
  world.Learn(StructureMode::kMixture);
  ASSERT_EQ(world.map.manhattan.size(), 4u);  // three pairs, a triple
  world.Learn(StructureMode::kMixture);
  EXPECT_EQ(world.map.manhattan.size(), 4u);
  for (const ManhattanFrame& frame : world.map.manhattan) EXPECT_EQ(frame.seen, 2);
  EXPECT_EQ(SeenManhattanFrame(world.frame, world.map, world.config).size(), 3u);
  world.frame.planes[2].bad = BadReason::kFar;
  EXPECT_EQ(SeenManhattanFrame(world.frame, world.map, world.config).size(), 2u);
}

TEST(ManhattanMixture, KnowsAFrameAgainWhoseLandmarkWasFusedIntoAnother) {
  SeenWorld world({kAxes_w.col(0), kAxes_w.col(1), kAxes_w.col(0)});
  world.frame.planes[2].bad = BadReason::kFar;  // the same wall as the first, taken for another
  world.Learn(StructureMode::kMixture);
  ASSERT_EQ(world.map.manhattan.size(), 1u);
  world.map.planes.At(0).merged_into = 2;
  world.frame.plane_matches[0].map_plane = 2;
  world.Learn(StructureMode::kMixture);
  ASSERT_EQ(world.map.manhattan.size(), 1u);
  EXPECT_EQ(world.map.manhattan[0].seen, 2);
}

TEST(ManhattanMixture, GoesByTheLargestSegmentOfALandmarkInWhateverOrder) {
  for (const bool large_first : {true, false}) {
    SeenWorld world({kAxes_w.col(0), kAxes_w.col(1)});
    // A second segment of the first landmark, off by more than a right angle may be.
    FramePlane piece = world.frame.planes[0];
    piece.pi_c.n = ExpSo3({0.1, 0.1, 0.1}) * piece.pi_c.n;
    world.frame.planes[0].pixel_count = large_first ? 5000 : 1000;
    piece.pixel_count = large_first ? 1000 : 5000;
    if (!large_first) std::swap(world.frame.planes[0].pi_c, piece.pi_c);
    world.frame.planes.push_back(piece);
    world.frame.plane_matches.push_back(world.frame.plane_matches[0]);
    world.Learn(StructureMode::kMixture);
    EXPECT_EQ(world.map.manhattan.size(), 1u) << large_first;
  }
}

TEST(ManhattanMixture, OfTwoAsLargeBelievesTheOneThatMoreKeyframesSaw) {
  SeenWorld world({kAxes_w.col(0), kAxes_w.col(1)});
  world.Learn(StructureMode::kMixture);
  ASSERT_EQ(world.map.manhattan.size(), 1u);
  const ManhattanFrame& stored = world.map.manhattan[0];
  for (const std::size_t more : {0u, 1u}) {
    SeenWorld other = world;
    other.map.manhattan.assign(2, stored);
    other.map.manhattan[more].seen = 5;
    other.map.manhattan[1 - more].axes_k = ExpSo3({0, 0, 0.02}) * stored.axes_k;
    const auto axes = SeenManhattanFrame(other.frame, other.map, other.config);
    ASSERT_EQ(axes.size(), 2u);
    EXPECT_THAT(axes[0].axis_w, VectorNear(kAxes_w.col(0), 1e-9)) << more;
  }
}

TEST(ManhattanMixture, KeepsTheKeyframeThatSawItFirstAndHowWellThatWasKnown) {
  SeenWorld world({kAxes_w.col(0), kAxes_w.col(1)});
  world.map.keyframes.push_back(world.map.keyframes[0]);
  StructureConfig structure;
  structure.mode = StructureMode::kMixture;
  LearnStructure(world.frame, 1, 0.97, structure, world.map);
  ASSERT_EQ(world.map.manhattan.size(), 1u);
  EXPECT_EQ(world.map.manhattan[0].keyframe, 1);
  const auto sigma = [&](double first_rad) {
    SeenWorld seen({kAxes_w.col(0), kAxes_w.col(1)});
    for (FramePlane& plane : seen.frame.planes) plane.angle_sigma_rad = first_rad;
    seen.Learn(StructureMode::kMixture);
    for (FramePlane& plane : seen.frame.planes) plane.angle_sigma_rad = 0.002;
    return SeenManhattanFrame(seen.frame, seen.map, seen.config).at(0).sigma_rad;
  };
  EXPECT_GT(sigma(0.03), 1.5 * sigma(0.002));
}

TEST(ManhattanMixture, StoresNoParallelNorTiltedPlanes) {
  const Eigen::Vector3d a = kAxes_w.col(0), b = kAxes_w.col(1);
  for (const auto& normals :
       std::vector<std::vector<Eigen::Vector3d>>{{a}, {a, -a}, {a, b + 0.03 * a}, {a, a + b}}) {
    SeenWorld world(normals);
    world.Learn(StructureMode::kMixture);
    EXPECT_TRUE(world.map.manhattan.empty());
  }
}

TEST(Structure, OfNoneAddsAndLearnsNothing) {
  SeenWorld world(Room());
  world.Learn(StructureMode::kFree);
  EXPECT_TRUE(world.map.manhattan.empty());
  const PoseProblem problem = world.Problem(StructureMode::kFree);
  EXPECT_TRUE(problem.parallels.empty() && problem.perpendiculars.empty());
  EXPECT_TRUE(problem.rotations.empty() && problem.planes.empty());
}

}  // namespace
}  // namespace slam
