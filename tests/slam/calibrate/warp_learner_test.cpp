// A camera turns in a room of two planes, whose depth is computed in closed form and bent.
#include "slam/calibrate/warp_learner.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "slam/base/random.h"
#include "slam/calibrate/straightener.h"
#include "tests/support/cameras.h"

namespace slam {
namespace {

constexpr int kFrames = 240;
constexpr double kFps = 30.0;

/// p of a device of our own: waves that no prior of ours knows of, 0.33 % rms.
double WavyPattern(double u, double v) {
  const double turn = 2 * std::numbers::pi;
  return 0.0033 * (std::sin(turn * u / 45 + 1) + std::cos(turn * (v / 60 - u / 160)));
}
double Flat(double, double) { return 0.0; }

/// The camera sways to all sides and goes to and fro.
Pose Swaying(int frame) {
  const double t = frame / kFps;
  const Eigen::Vector3d turn(0.15 * std::sin(1.1 * t), 0.3 * std::sin(0.7 * t), 0.05 * t / 8);
  const Eigen::Vector3d place(0.3 * std::sin(0.5 * t), 0.1 * std::sin(0.9 * t), 0.2 * t / 8);
  return Inverse({ExpSo3(turn), place});
}
Pose Still(int) { return {}; }

struct Room {
  bool floor = true;  ///< besides the wall
  std::function<double(double, double)> pattern = WavyPattern;
  BendLaw law = BendLaw::kDepth;
  std::function<Pose(int)> pose = Swaying;
  /// Height of a bump of the wall itself, metres.
  std::function<double(const Eigen::Vector3d& x_w)> bump = [](const Eigen::Vector3d&) {
    return 0.0;
  };
};

/// About normal: the sum of four uniform numbers, of unit variance.
double RoughNormal(Random& random) {
  const double sum =
      random.Uniform() + random.Uniform() + random.Uniform() + random.Uniform() - 2;
  return sum * std::sqrt(3.0);
}

/// Depth and labels of a frame: the wall z = 2 m (1) and the floor y = 0.45 m (2).
Frame FrameOfRoom(const Room& room, int index, const cv::Mat2d& rays) {
  Frame frame;
  frame.index = index;
  frame.timestamp_s = index / kFps;
  frame.T_cw = room.pose(index);
  frame.depth_m.create(rays.size());
  frame.plane_labels.create(rays.size());
  const Pose T_wc = Inverse(frame.T_cw);
  const DepthNoise noise;
  Random random{7, static_cast<std::uint64_t>(index)};
  for (int v = 0; v < rays.rows; ++v) {
    for (int u = 0; u < rays.cols; ++u) {
      const Eigen::Vector3d way = T_wc.R * Eigen::Vector3d(rays(v, u)[0], rays(v, u)[1], 1);
      double z = (2.0 - T_wc.t.z()) / way.z();
      z += room.bump(T_wc.t + z * way);
      std::uint8_t label = 1;
      const double z_floor = (0.45 - T_wc.t.y()) / way.y();
      if (room.floor && z_floor > 0 && z_floor < z) z = z_floor, label = 2;
      const double p = room.pattern(u, v);
      z = room.law == BendLaw::kDepth ? z * (1 + p) : 1 / (1 / z - p / kBendDistance_m);
      frame.depth_m(v, u) = static_cast<float>(z + noise.Sigma(z) * RoughNormal(random));
      frame.plane_labels(v, u) = label;
    }
  }
  return frame;
}

WarpLearner LearntFrom(const Room& room) {
  const Camera camera = SmallCamera();
  const cv::Mat2d rays = PixelRays(camera);
  WarpLearner learner(camera, DepthNoise{}, DepthWarpConfig{});
  for (int i = 0; i < kFrames; ++i) {
    const Frame frame = FrameOfRoom(room, i, rays);
    learner.Observe(frame.timestamp_s, frame.depth_m, frame.plane_labels, frame.T_cw);
  }
  learner.Finish();
  return learner;
}

TEST(WarpLearner, LearnsAPatternFromTwoPlanesToAThirdOfIt) {
  const WarpLearner learner = LearntFrom({});
  EXPECT_TRUE(learner.evidence().worth_it) << learner.evidence().Doubt();
  EXPECT_EQ(learner.evidence().Doubt(), "");
  const DepthWarp warp = learner.Warp();
  Eigen::VectorXd truth(warp.cells.count());
  for (int cell = 0; cell < warp.cells.count(); ++cell) {
    truth[cell] = WavyPattern(warp.cells.CentreU(cell % warp.cells.cols),
                              warp.cells.CentreV(cell / warp.cells.cols));
  }
  truth = WithoutLinearPart(warp.cells, truth);
  EXPECT_LT((warp.pattern - truth).norm(), truth.norm() / 3);
  // Its own idea of the error is no smaller: drift, which this device has none of, is in it.
  const double error = std::sqrt((warp.pattern - truth).squaredNorm() / warp.cells.count());
  const double sigma = std::sqrt(warp.sigma.squaredNorm() / warp.cells.count());
  EXPECT_LT(error, sigma);
}

TEST(WarpLearner, FindsHowTheBendGoesWithTheDistance) {
  for (const BendLaw law : {BendLaw::kDepth, BendLaw::kDisparity}) {
    const WarpLearner learner = LearntFrom({.law = law});
    EXPECT_TRUE(learner.evidence().worth_it);
    EXPECT_EQ(learner.evidence().law, law);
    EXPECT_EQ(learner.Warp().law, law);
  }
}

TEST(WarpLearner, CountsNoFrameTwice) {
  // As when a run meets the frames of its first look once more.
  const cv::Mat2d rays = PixelRays(SmallCamera());
  WarpLearner learner = LearntFrom({});
  const WarpEvidence before = learner.evidence();
  const Eigen::VectorXd pattern = learner.Warp().pattern;
  for (int i = 0; i < kFrames; ++i) {
    const Frame frame = FrameOfRoom({}, i, rays);
    EXPECT_FALSE(learner.Wants(frame.timestamp_s, frame.T_cw));
    learner.Observe(frame.timestamp_s, frame.depth_m, frame.plane_labels, frame.T_cw);
  }
  learner.Finish();
  EXPECT_EQ(learner.evidence().epochs, before.epochs);
  EXPECT_EQ(learner.Warp().pattern, pattern);
}

// What a step aside moves the image by goes with the inverse of the distance.
TEST(WarpLearner, WantsAFrameOnceItsImageHasMovedHoweverFarTheSceneIs) {
  const Camera camera = SmallCamera();
  const cv::Mat1b labels(camera.height, camera.width, std::uint8_t{1});
  for (const double depth_m : {0.5, 1.0, 2.0, 4.0}) {
    WarpLearner learner(camera, DepthNoise{}, DepthWarpConfig{});
    const cv::Mat1f wall_m(camera.height, camera.width, static_cast<float>(depth_m));
    learner.Observe(0, wall_m, labels, Pose{});
    const auto wants = [&](double shift_rad) {
      return learner.Wants(1 / kFps, Inverse({ExpSo3({0, 0, 0}), {shift_rad * depth_m, 0, 0}}));
    };
    EXPECT_FALSE(wants(0.02)) << depth_m;
    EXPECT_TRUE(wants(0.03)) << depth_m;
  }
}

TEST(WarpLearner, WantsNoMoreFramesOfOneEpochThanItUses) {
  constexpr int kMaxViews = 16;
  const Camera camera = SmallCamera();
  const cv::Mat2d rays = PixelRays(camera);
  // So fast that the image has moved in nearly every frame, of which an epoch has 24 and more.
  const Room room{.pose = [](int frame) { return Swaying(6 * frame); }};
  WarpLearner learner(camera, DepthNoise{}, DepthWarpConfig{});
  int wanted = 0;
  for (int i = 0; i < kFrames; ++i) {
    const Frame frame = FrameOfRoom(room, i, rays);
    if (!learner.Wants(frame.timestamp_s, frame.T_cw)) continue;
    ++wanted;
    learner.Observe(frame.timestamp_s, frame.depth_m, frame.plane_labels, frame.T_cw);
  }
  const int closed = learner.evidence().epochs + 1;  // the first is foretold by none
  EXPECT_GT(closed, 4);
  EXPECT_LE(wanted, kMaxViews * (closed + 1));
  EXPECT_GT(wanted, kMaxViews * (closed - 1) / 2);
}

TEST(WarpLearner, HasNoLinearPartWhichViewsOfPlanesDoNotTell) {
  const DepthWarp warp = LearntFrom({}).Warp();
  EXPECT_NEAR(WithoutLinearPart(warp.cells, warp.pattern).norm(), warp.pattern.norm(), 1e-12);
  EXPECT_NEAR(warp.pattern.mean(), 0.0, 1e-12);
}

TEST(WarpLearner, DoesNothingForAFlatSensor) {
  const WarpLearner learner = LearntFrom({.pattern = Flat});
  EXPECT_FALSE(learner.evidence().worth_it);
  EXPECT_THAT(learner.evidence().Doubt(), testing::HasSubstr("flat"));
  EXPECT_LT(learner.Warp().Rms(), 0.0002);
}

TEST(WarpLearner, DoesNothingForACameraThatRests) {
  const WarpLearner learner = LearntFrom({.pose = Still});
  EXPECT_FALSE(learner.evidence().worth_it);
  EXPECT_THAT(learner.evidence().Doubt(), testing::HasSubstr("too few places"));
}

TEST(WarpLearner, DoesNothingForOneWallWhoseOwnBendItCouldBe) {
  const WarpLearner learner = LearntFrom({.floor = false});
  EXPECT_FALSE(learner.evidence().worth_it);
  EXPECT_THAT(learner.evidence().Doubt(), testing::HasSubstr("one surface"));
}

TEST(WarpLearner, DoesNotTakeBumpsOfASceneForTheDevices) {
  const WarpLearner learner =
      LearntFrom({.pattern = Flat, .bump = [](const Eigen::Vector3d& x_w) {
                    return 0.008 * std::sin(8 * x_w.x()) * std::cos(9 * x_w.y());
                  }});
  EXPECT_FALSE(learner.evidence().worth_it);
}

TEST(DepthStraightener, StraightensFromTheFrameOnThatItIsWorthIt) {
  const Camera camera = SmallCamera();
  const cv::Mat2d rays = PixelRays(camera);
  DepthStraightener straightener(camera, DepthNoise{}, {.source = "auto"});
  DepthStraightener off(camera, DepthNoise{}, {.source = "off"});
  for (int i = 0; i < kFrames; ++i) {
    Frame frame = FrameOfRoom({}, i, rays);
    frame.measured = {frame.depth_m, frame.plane_labels};
    frame.depth_m = Straightened(frame.measured.depth_m, straightener.straightening());
    straightener.See(frame);
    EXPECT_EQ(straightener.straightening().pattern.empty(),
              straightener.report().from_frame == kNone)
        << i;
    straightener.Learn(frame);
    EXPECT_TRUE(off.straightening().pattern.empty());
    frame.depth_m = frame.measured.depth_m;
    off.See(frame);
    off.Learn(frame);
  }
  EXPECT_GT(straightener.report().from_frame, 60);
  EXPECT_LT(straightener.report().from_frame, kFrames);
  EXPECT_NEAR(straightener.report().rms, 0.0033, 0.001);
  EXPECT_EQ(off.report().from_frame, kNone);
  EXPECT_FALSE(off.report().evidence.has_value());
}

TEST(DepthStraightener, GoesOnFromWhatIsKnownBefore) {
  const Camera camera = SmallCamera();
  const cv::Mat2d rays = PixelRays(camera);
  const WarpLearner known = LearntFrom({});
  DepthStraightener straightener(camera, DepthNoise{}, {.source = "auto"});
  straightener.StartFrom(known);
  EXPECT_FALSE(straightener.straightening().pattern.empty());
  EXPECT_EQ(straightener.report().evidence->epochs, known.evidence().epochs);
  // What comes later it learns.
  for (int i = 0; i < 2 * kFrames; ++i) {
    Frame frame = FrameOfRoom({}, i, rays);
    frame.measured = {frame.depth_m, frame.plane_labels};
    straightener.Learn(frame);
    if (i < kFrames) {
      EXPECT_EQ(straightener.report().evidence->epochs, known.evidence().epochs);
    }
  }
  EXPECT_GT(straightener.report().evidence->epochs, known.evidence().epochs);
}

// What counts is whether the depth camera stood elsewhere when it measured.
TEST(DepthStraightener, LearnsNothingOfADepthCameraThatRestsThoughColourIsTakenOnTheWay) {
  const Camera camera = SmallCamera();
  const cv::Mat2d rays = PixelRays(camera);
  DepthStraightener straightener(camera, DepthNoise{}, {.source = "auto"});
  for (int i = 0; i < kFrames; ++i) {
    Frame frame = FrameOfRoom({}, i, rays);
    frame.measured = {frame.depth_m, frame.plane_labels};
    frame.depth_late_s = 0.02;
    frame.speed.mean = Log(Inverse(frame.T_cw)) / frame.depth_late_s;
    straightener.Learn(frame);
  }
  EXPECT_TRUE(straightener.straightening().pattern.empty());
  EXPECT_FALSE(straightener.report().evidence && straightener.report().evidence->epochs > 0);
}

TEST(DepthStraightener, KnowsAtLeastWhatItLeaves) {
  const Camera camera = SmallCamera();
  const WarpLearner known = LearntFrom({});
  DepthStraightener straightener(camera, DepthNoise{}, {.source = "auto"});
  EXPECT_EQ(straightener.straightening().left_ratio, 0.0);  // of depth that is left alone
  straightener.StartFrom(known);
  const DepthWarp warp = known.Warp();
  double squares = 0.0;
  for (int cell = 0; cell < warp.cells.count(); ++cell) {
    const double truth = WavyPattern(warp.cells.CentreU(cell % warp.cells.cols),
                                     warp.cells.CentreV(cell / warp.cells.cols));
    squares += (warp.pattern[cell] - truth) * (warp.pattern[cell] - truth);
  }
  const double left = straightener.straightening().left_ratio;
  EXPECT_GT(left, std::sqrt(squares / warp.cells.count()));
  // No less than what changes over time (a quarter of the power), no more than all there was.
  EXPECT_GT(left, 0.5 * 0.0033);
  EXPECT_LT(left, 0.0033);
}

TEST(DepthStraightener, LetsGoOfAWarpThatForetellsNoLonger) {
  const Camera camera = SmallCamera();
  const cv::Mat2d rays = PixelRays(camera);
  DepthStraightener straightener(camera, DepthNoise{}, {.source = "auto"});
  bool applied = false;
  for (int i = 0; i < 2 * kFrames; ++i) {
    // A device that bends, and then one that bends the other way.
    const Room room{.pattern = [&](double u, double v) {
      return (i < kFrames ? 1 : -1) * WavyPattern(u, v);
    }};
    Frame frame = FrameOfRoom(room, i, rays);
    frame.measured = {frame.depth_m, frame.plane_labels};
    straightener.Learn(frame);
    applied = applied || !straightener.straightening().pattern.empty();
  }
  EXPECT_TRUE(applied);
  EXPECT_FALSE(straightener.report().evidence->worth_it);
  EXPECT_TRUE(straightener.straightening().pattern.empty());
}

}  // namespace
}  // namespace slam
