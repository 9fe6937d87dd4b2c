#include "eval/draw/run_gauge.h"

#include "eval/draw/map_drawing.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

namespace eval {
namespace {

constexpr double kTurnRoundOff = 1e-9;

TEST(AlignByPoses, RecoversTheMotionOfAStraightPath) {
  Eigen::Isometry3d T_wg(Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, 2, 0.5).normalized()));
  T_wg.translation() << 1, 2, -1;
  Trajectory truth, run;
  for (int i = 0; i < 4; ++i) {
    const Pose T_gc{Eigen::Matrix3d::Identity(), Eigen::Vector3d(0.1 * i, 0, 0)};
    truth.push_back({i * 0.1, T_gc});
    run.push_back({i * 0.1, Pose{T_wg.linear(), T_wg.translation()} * T_gc});
  }
  const auto T_gw = AlignByPoses(run, truth, true);
  ASSERT_TRUE(T_gw.has_value());
  EXPECT_LT((T_gw->R - T_wg.linear().transpose()).norm(), 1e-12);
  EXPECT_LT((*T_gw * run[3].T_wc.t - truth[3].T_wc.t).norm(), 1e-12);
  EXPECT_FALSE(AlignByPoses(run, {}, true).has_value());
}

/// A camera that looks at 30 degrees down on a desk in a world whose y axis points down, as that
/// of a recording whose first frame is its world: a run and its truth in that world.
struct CameraWorld {
  Run run;
  Sequence sequence;
  Eigen::Vector3d up_w;
};

CameraWorld MakeCameraWorld() {
  constexpr double kPitch_rad = 0.52;
  CameraWorld made;
  made.up_w = {0, -std::cos(kPitch_rad), -std::sin(kPitch_rad)};
  for (int i = 0; i < 3; ++i) {
    Pose T_wc;
    T_wc.t = Eigen::Vector3d(0.1 * i, 0.02 * i * i, 0);
    made.run.trajectory.push_back({0.1 * i, T_wc});
    made.sequence.frames.push_back({0.1 * i, "", 0.1 * i, "", 0});
  }
  made.sequence.groundtruth = made.run.trajectory;
  const Eigen::Vector3d wall_w(0, std::sin(kPitch_rad), -std::cos(kPitch_rad));
  made.run.map.resize(2);
  made.run.map[0].id = 0, made.run.map[0].area_m2 = 9, made.run.map[0].observations = 3;
  made.run.map[0].pi_w.n = wall_w, made.run.map[0].pi_w.d = 3;
  made.run.map[1].id = 1, made.run.map[1].area_m2 = 1, made.run.map[1].observations = 3;
  made.run.map[1].pi_w.n = made.up_w, made.run.map[1].pi_w.d = 1;
  return made;
}

TEST(ChooseMapGauge, TurnsATruthWhoseZAxisIsNotUpUntilTheDeskIsLevel) {
  const CameraWorld world = MakeCameraWorld();
  const MapGauge gauge = ChooseMapGauge(world.run, world.sequence);
  EXPECT_TRUE(gauge.on_truth);
  EXPECT_TRUE(gauge.levelled);
  EXPECT_LT((gauge.T_vw.R * world.up_w - Eigen::Vector3d::UnitZ()).norm(), kTurnRoundOff);
  // Run and truth are turned alike.
  const Eigen::Vector3d p = world.run.trajectory[2].T_wc.t;
  EXPECT_LT((gauge.T_vw * p - gauge.T_vg * p).norm(), kTurnRoundOff);
}

TEST(CollectMap, DrawsThePathOfTheTruthTurnedAsTheRunIs) {
  const CameraWorld world = MakeCameraWorld();
  const MapScene scene = CollectMap(world.run, world.sequence);
  ASSERT_EQ(scene.truth_path_v.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_LT((scene.truth_path_v[i] - scene.run_path_v[i]).norm(), 1e-9) << i;
}

// Motion capture is switched on before the camera, and off after it.
TEST(CollectMap, DrawsThePathOfTheTruthFromTheFirstFrameToTheLastAlone) {
  CameraWorld world = MakeCameraWorld();
  const MapScene during = CollectMap(world.run, world.sequence);
  Trajectory& truth = *world.sequence.groundtruth;
  Pose far;
  far.t = {7, 8, 9};
  truth.insert(truth.begin(), {truth.front().stamp_s - 1, far});
  truth.push_back({truth.back().stamp_s + 1, far});
  const MapScene scene = CollectMap(world.run, world.sequence);
  ASSERT_EQ(scene.truth_path_v.size(), during.truth_path_v.size());
  for (std::size_t i = 0; i < scene.truth_path_v.size(); ++i)
    EXPECT_LT((scene.truth_path_v[i] - during.truth_path_v[i]).norm(), 1e-9) << i;
}

TEST(ChooseMapGauge, TurnsRunAndTruthAlikeWhereTheRunBeginsElsewhere) {
  CameraWorld world = MakeCameraWorld();
  const Pose T_gw{Eigen::AngleAxisd(0.4, Eigen::Vector3d(1, 2, -1).normalized()).matrix(),
                  {1, -2, 3}};
  for (StampedPose& pose : *world.sequence.groundtruth) pose.T_wc = T_gw * pose.T_wc;
  const MapGauge gauge = ChooseMapGauge(world.run, world.sequence);
  EXPECT_TRUE(gauge.levelled);
  for (std::size_t i = 0; i < 3; ++i) {
    const Eigen::Vector3d drawn = gauge.T_vw * world.run.trajectory[i].T_wc.t;
    EXPECT_LT((drawn - gauge.T_vg * (*world.sequence.groundtruth)[i].T_wc.t).norm(), 1e-9) << i;
  }
  EXPECT_LT((gauge.T_vw.R * world.up_w - Eigen::Vector3d::UnitZ()).norm(), kTurnRoundOff);
}

TEST(ChooseMapGauge, KeepsATruthInWhichTheDeskIsLevel) {
  CameraWorld world = MakeCameraWorld();
  Pose T_gw;
  T_gw.R = Eigen::Quaterniond::FromTwoVectors(world.up_w, Eigen::Vector3d::UnitZ())
               .toRotationMatrix();
  for (StampedPose& pose : *world.sequence.groundtruth) pose.T_wc = T_gw * pose.T_wc;
  const MapGauge gauge = ChooseMapGauge(world.run, world.sequence);
  EXPECT_FALSE(gauge.levelled);
  EXPECT_TRUE(gauge.T_vg.R.isIdentity());
}

TEST(ChooseMapGauge, LevelsTheDeskAndNotTheLargerWallWithoutATruth) {
  CameraWorld world = MakeCameraWorld();
  world.sequence.groundtruth.reset();
  const MapGauge gauge = ChooseMapGauge(world.run, world.sequence);
  EXPECT_FALSE(gauge.on_truth);
  EXPECT_LT((gauge.T_vw.R * world.up_w - Eigen::Vector3d::UnitZ()).norm(), kTurnRoundOff);
}

// It is no plane of the final map any more; what was wrong with it may be its tilt.
TEST(ChooseMapGauge, LevelsNoPlaneThatWasMergedIntoAnother) {
  CameraWorld world = MakeCameraWorld();
  world.sequence.groundtruth.reset();
  RunMapPlane merged = world.run.map[1];
  merged.id = 2, merged.area_m2 = 4, merged.merged_into = 1;
  merged.pi_w.n = Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitX()) * merged.pi_w.n;
  world.run.map.push_back(merged);
  const MapGauge gauge = ChooseMapGauge(world.run, world.sequence);
  EXPECT_LT((gauge.T_vw.R * world.up_w - Eigen::Vector3d::UnitZ()).norm(), kTurnRoundOff);
}

}  // namespace
}  // namespace eval
