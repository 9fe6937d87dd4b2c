#include "slam/calibrate/rolling_learner.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "slam/base/index.h"
#include "slam/base/random.h"
#include "tests/support/plane_world.h"

namespace slam {
namespace {

constexpr int kPoints = 300;

struct Shutter {
  double read_s = 0.0;  ///< negative: the last row first
  int frames = 120;
  double speed = 1.0;     ///< 0: the camera stands
  bool same_way = false;  ///< each frame moves as the keyframe did that made the points
  bool keyframe_moves = false;
  Pose T_wk = {};  ///< of that keyframe
  double keyframe_taken_out_s = 0.0;
};

Vector6d SpeedOf(Random& random) {
  Vector6d speed;
  for (int k = 0; k < 3; ++k) speed[k] = 0.3 * Normal(random);
  for (int k = 3; k < 6; ++k) speed[k] = 0.5 * Normal(random);
  return speed;
}

/// Where a point shows that the camera of the middle row sees at x_c.
Eigen::Vector2d Seen(const Camera& camera, double read_s, const Vector6d& speed,
                     const Eigen::Vector3d& x_c) {
  Eigen::Vector2d u_px = camera.Project(x_c);
  for (int k = 0; k < 5; ++k)
    u_px = camera.Project(Exp(camera.RowShare(u_px.y()) * read_s * speed) * x_c);
  return u_px;
}

/// Points, and where one keyframe placed them, with what the shutter made of them there.
struct PlacedPoints {
  std::vector<Eigen::Vector3d> true_c;
  Map map;
};

PlacedPoints Place(const Camera& camera, const Shutter& shutter, const Vector6d& speed) {
  PlacedPoints points;
  Map& map = points.map;
  map.keyframes.resize(1);
  Keyframe& keyframe = map.keyframes[0];
  keyframe.id = 0;
  keyframe.T_cw = Inverse(shutter.T_wk);
  keyframe.readout.speed = speed;
  keyframe.readout.taken_out_s = shutter.keyframe_taken_out_s;
  const double left_s = shutter.read_s - shutter.keyframe_taken_out_s;
  Random random{3};
  for (int i = 0; i < kPoints; ++i) {
    const double z_m = 1.0 + 2.0 * random.Uniform();
    const Eigen::Vector3d x_c =
        camera.Backproject({40 + 560 * random.Uniform(), 40 + 400 * random.Uniform()}, z_m);
    MapPoint point;
    point.p_w = shutter.T_wk * camera.Backproject(Seen(camera, left_s, speed, x_c), z_m);
    point.observations[0] = i;
    map.points.push_back(point);
    points.true_c.push_back(x_c);
  }
  return points;
}

RollingLearner LearnShutter(const Shutter& shutter, const RollingConfig& config = {}) {
  const Camera camera;
  const FeatureScale scale;
  Random random{7};
  const Vector6d first = SpeedOf(random);
  const Vector6d keyframe_speed = shutter.same_way || shutter.keyframe_moves
                                      ? Vector6d(shutter.speed * first)
                                      : Vector6d(Vector6d::Zero());
  const PlacedPoints points = Place(camera, shutter, keyframe_speed);
  RollingLearner learner(camera, scale, config);
  for (int i = 0; i < shutter.frames; ++i) {
    const Vector6d any = SpeedOf(random);
    Frame frame;
    frame.speed.mean = shutter.speed * (shutter.same_way ? first : any);
    frame.readout = learner.ReadoutAt(frame.speed.mean);
    // Where the camera is is known but for what tracking makes of a wrong shutter.
    frame.T_cw = Exp(0.001 * Vector6d(SpeedOf(random))) * Inverse(shutter.T_wk);
    const double left_s = shutter.read_s - frame.readout.taken_out_s;
    for (int k = 0; k < kPoints; ++k) {
      PointFeature feature;
      feature.u_px = Seen(camera, left_s, frame.speed.mean, points.true_c[Index(k)]) +
                     Eigen::Vector2d(0.7 * Normal(random), 0.7 * Normal(random));
      frame.features.push_back(feature);
      frame.map_points.push_back(k);
    }
    learner.Learn(frame, points.map);
  }
  return learner;
}

TEST(RollingLearner, TellsTheTimeFromTheFirstRowToTheLast) {
  for (const double read_s : {0.026, 0.01, -0.02, 0.033}) {
    const auto estimate = LearnShutter({.read_s = read_s}).estimate();
    ASSERT_TRUE(estimate) << read_s;
    EXPECT_NEAR(estimate->read_s, read_s, 0.001);
    // As of a mean: epochs that scatter by 3 ms, of which there are twenty at most.
    EXPECT_LT(estimate->sigma_s, 0.0015);
    EXPECT_NEAR(estimate->applied_s, read_s, 0.1 * std::abs(read_s) + 0.001);
  }
}

TEST(RollingLearner, TellsItHoweverTheWorldIsTurned) {
  const auto read_s = [](const Eigen::Vector3d& turn) {
    const Pose T_wk{ExpSo3(turn), {1, -2, 0.5}};
    const auto estimate =
        LearnShutter({.read_s = 0.026, .keyframe_moves = true, .T_wk = T_wk}).estimate();
    return estimate ? estimate->read_s : 0.0;
  };
  const double at_home_s = read_s({0, 0, 0});
  EXPECT_NEAR(at_home_s, 0.026, 0.002);
  for (const Eigen::Vector3d& turn :
       {Eigen::Vector3d(0.5, 1.2, -0.4), Eigen::Vector3d(0, 3, 0)})
    EXPECT_NEAR(read_s(turn), at_home_s, 1e-6) << turn.transpose();
}

TEST(RollingLearner, TellsItHoweverMuchOfItWasTakenOutOfTheMap) {
  // None, half, all, and too much.
  for (const double taken_out_s : {0.0, 0.013, 0.026, 0.04}) {
    const auto estimate =
        LearnShutter(
            {.read_s = 0.026, .keyframe_moves = true, .keyframe_taken_out_s = taken_out_s})
            .estimate();
    ASSERT_TRUE(estimate) << taken_out_s;
    EXPECT_NEAR(estimate->read_s, 0.026, 0.002) << taken_out_s;
  }
}

TEST(RollingLearner, LeavesAGlobalShutterAlone) {
  const auto estimate = LearnShutter({.read_s = 0.0}).estimate();
  ASSERT_TRUE(estimate);
  EXPECT_LT(std::abs(estimate->applied_s), 0.0005);
}

TEST(RollingLearner, LearnsNothingFromACameraThatStands) {
  EXPECT_FALSE(LearnShutter({.read_s = 0.03, .speed = 0.0}).estimate());
}

TEST(RollingLearner, LearnsNothingWhereTheMapHasTheSameError) {
  EXPECT_FALSE(LearnShutter({.read_s = 0.03, .same_way = true}).estimate());
}

TEST(RollingLearner, TellsARowByThePlaceBetweenFirstAndLast) {
  const RollingLearner learner = LearnShutter({.read_s = 0.03});
  Vector6d speed = Vector6d::Zero();
  speed[0] = 1.0;
  const Readout readout = learner.ReadoutAt(speed);
  const Camera camera;
  EXPECT_NEAR(readout.T_rc(camera.RowShare(camera.height - 1)).t.x(), 0.015, 0.001);
  EXPECT_EQ(readout.T_rc(camera.RowShare((camera.height - 1) / 2.0)).t.x(), 0.0);
}

TEST(RollingLearner, SaysHowWellItIsKnown) {
  const Camera camera;
  const FeatureScale scale;
  const RollingConfig config;
  const Vector6d speed = Vector6d::Ones();
  EXPECT_EQ(RollingLearner(camera, scale, config).ReadoutAt(speed).sigma_s, config.usual_s);
  EXPECT_EQ(RollingLearner(camera, scale, {.learn = false}).ReadoutAt(speed).sigma_s, 0.0);
  const RollingLearner learner = LearnShutter({.read_s = 0.03});
  EXPECT_EQ(learner.ReadoutAt(speed).sigma_s, learner.estimate()->sigma_s);
  EXPECT_LT(learner.estimate()->sigma_s, config.usual_s / 2);
}

TEST(RollingLearner, MayBeForbidden) {
  RollingConfig config;
  config.learn = false;
  EXPECT_FALSE(LearnShutter({.read_s = 0.03}, config).estimate());
}

}  // namespace
}  // namespace slam
