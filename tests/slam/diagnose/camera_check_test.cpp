#include "slam/diagnose/camera_check.h"

#include <gmock/gmock.h>

#include <functional>

#include "slam/base/random.h"
#include "tests/support/normal_draws.h"

namespace slam {
namespace {

using Way = std::function<Pose(double)>;  ///< T_cw at a time

/// A camera that looks around: 12 degrees to the sides, 8 up and down, with some translation.
Pose LookingAround(double s) {
  const Eigen::Matrix3d R_wc =
      ExpSo3({0.14 * std::sin(1.7 * s), 0.21 * std::sin(2.3 * s), 0.10 * std::sin(1.1 * s)});
  return Inverse(
      Pose{R_wc, {0.15 * std::sin(1.3 * s), 0.1 * std::sin(s), 0.1 * std::sin(0.7 * s)}});
}

struct Defects {
  double position_px = 0.0;  ///< sigma at octave 0
  double depth = 0.0;        ///< sigma, per metre squared
  double wrong_share = 0.0;  ///< of the matches
  double read_out_s = 0.0;   ///< from the first row to the last
};

/// What a tracker that is right makes of points in front of a camera.
std::vector<Frame> TrackedFrames(int frames, const Camera& camera, const Way& way,
                                 const Defects& defects, std::uint64_t seed) {
  constexpr int kPoints = 700;
  std::vector<Eigen::Vector3d> points_w;
  Random scene{seed};
  for (int i = 0; i < kPoints; ++i) {
    const double z = 0.8 + 2.0 * scene.Uniform();
    points_w.emplace_back(2.2 * z * (scene.Uniform() - 0.5), 1.8 * z * (scene.Uniform() - 0.5),
                          z);
  }
  std::vector<Frame> tracked;
  for (int k = 0; k < frames; ++k) {
    Random random{seed, static_cast<std::uint64_t>(k)};
    Frame frame;
    frame.index = k;
    frame.timestamp_s = k / 30.0;
    frame.T_cw = way(frame.timestamp_s);
    for (int i = 0; i < kPoints; ++i) {
      const Eigen::Vector3d& p_w = points_w[static_cast<std::size_t>(i)];
      Eigen::Vector3d p_c = frame.T_cw * p_w;
      for (int again = 0; again < 3 && defects.read_out_s > 0; ++again) {
        const double row = camera.Project(p_c).y() / camera.height - 0.5;
        p_c = way(frame.timestamp_s + row * defects.read_out_s) * p_w;
      }
      PointFeature feature;
      feature.octave = random.Below(4);
      const double sigma_px = defects.position_px * FeatureScale{}.Scale(feature.octave);
      feature.u_px = camera.Project(p_c) +
                     sigma_px * Eigen::Vector2d(BoundedNormal(random), BoundedNormal(random));
      if (random.Uniform() < defects.wrong_share)
        feature.u_px.x() += 30 * BoundedNormal(random);
      feature.depth_m = p_c.z() + defects.depth * p_c.z() * p_c.z() * BoundedNormal(random);
      if (!camera.ImageBox().Contains(feature.u_px)) continue;
      frame.features.push_back(feature);
      frame.map_points.push_back(i);
    }
    tracked.push_back(std::move(frame));
  }
  return tracked;
}

constexpr Defects kNoise{0.5, 0.002, 0.1, 0.0};

Camera Wrong(Intrinsics by) {
  Camera camera;
  camera.fx += by[0], camera.fy += by[1], camera.cx += by[2], camera.cy += by[3];
  return camera;
}

TEST(CameraCheck, FindsTheTrueIntrinsicsFromWrongOnes) {
  const Camera truth;
  CameraCheck check(Wrong({60.0, -25.0, 15.0, -12.0}), FeatureScale{});
  int noticed = 0;
  for (const Frame& frame : TrackedFrames(60, truth, LookingAround, {}, 1)) {
    noticed += check.See(frame);
  }
  EXPECT_EQ(noticed, 1);
  const CameraEstimate estimate = *check.Estimate();
  EXPECT_THAT(estimate.wrong, testing::Each(true));
  // The tracker's first guess is no part of the answer: exact points leave what the prior
  // pulls.
  EXPECT_LT((estimate.found - Intrinsics(525, 525, 319.5, 239.5)).cwiseAbs().maxCoeff(), 0.05);
  EXPECT_THAT(
      check.Warning(),
      testing::AllOf(testing::ContainsRegex("fx is about 525 px .*, not 585, fy is about"),
                     testing::HasSubstr("not 585"), testing::HasSubstr("cx is about"),
                     testing::HasSubstr("not 228"), testing::HasSubstr("camera.yaml")));
}

// A hundredth or two of the focal length is seen, and harms nobody.
TEST(CameraCheck, CallsNothingWrongThatHardlyMattersHoweverSureItIs) {
  CameraCheck check(Wrong({8.0, -8.0, 5.0, -5.0}), FeatureScale{});
  for (const Frame& frame : TrackedFrames(40, Camera{}, LookingAround, {}, 3))
    EXPECT_FALSE(check.See(frame));
  const CameraEstimate estimate = *check.Estimate();
  EXPECT_LT(5 * estimate.sigma.maxCoeff(), 5.0);
  EXPECT_LT((estimate.found - Intrinsics(525, 525, 319.5, 239.5)).norm(), 0.5);
  EXPECT_FALSE(estimate.AnyWrong());
  EXPECT_EQ(check.Warning(), "");
}

TEST(CameraCheck, NamesOnlyWhatIsWrong) {
  CameraCheck check(Wrong({0.0, 0.0, 20.0, 0.0}), FeatureScale{});
  for (const Frame& frame : TrackedFrames(60, Camera{}, LookingAround, kNoise, 2))
    check.See(frame);
  EXPECT_THAT(check.Estimate()->wrong, testing::ElementsAre(false, false, true, false));
  EXPECT_THAT(check.Warning(), testing::Not(testing::HasSubstr("fx")));
}

TEST(CameraCheck, IsSilentAndKnowsItsErrorWithTheRightCameraUnderNoiseAndWrongMatches) {
  constexpr int kRuns = 24;
  double squares = 0.0;
  for (int run = 0; run < kRuns; ++run) {
    const auto seed = 10 + static_cast<std::uint64_t>(run);
    CameraCheck check(Camera{}, FeatureScale{});
    for (const Frame& frame : TrackedFrames(30, Camera{}, LookingAround, kNoise, seed)) {
      EXPECT_FALSE(check.See(frame)) << "seed " << seed;
    }
    const CameraEstimate estimate = *check.Estimate();
    const Intrinsics error = estimate.found - Intrinsics(525, 525, 319.5, 239.5);
    squares += error.cwiseQuotient(estimate.sigma).squaredNorm() / 4;
    EXPECT_TRUE(check.Warning().empty());
  }
  // Pairs share views, and effects that are not there are allowed for: about one, not exactly.
  EXPECT_LT(squares / kRuns, 4.0);
  EXPECT_GT(squares / kRuns, 0.1);
}

TEST(CameraCheck, ARollingShutterIsNoWrongCamera) {
  Defects rolling = kNoise;
  rolling.read_out_s = 0.025;
  for (const std::uint64_t seed : {40u, 41u, 42u, 43u}) {
    CameraCheck check(Camera{}, FeatureScale{});
    for (const Frame& frame : TrackedFrames(90, Camera{}, LookingAround, rolling, seed)) {
      EXPECT_FALSE(check.See(frame));
    }
    EXPECT_LT((check.Estimate()->found - Intrinsics(525, 525, 319.5, 239.5)).norm(), 5.0);
  }
}

TEST(CameraCheck, ComparesNoViewsThatTheShutterWasTakenOutOfByMoreOrLess) {
  for (const double more_s : {0.0, 0.004}) {
    CameraCheck check(Camera{}, FeatureScale{});
    double taken_out_s = 0.0;
    for (Frame& frame : TrackedFrames(60, Camera{}, LookingAround, kNoise, 44)) {
      frame.readout.taken_out_s = taken_out_s += more_s;
      check.See(frame);
    }
    EXPECT_EQ(check.Estimate().has_value(), more_s == 0.0);
  }
}

TEST(CameraCheck, TakesBackWhatLaterViewsDoNotBearOut) {
  // First glances that look like another focal length, as depth of a moving camera may make them.
  CameraCheck check(Camera{}, FeatureScale{});
  const auto glance = [](double s) { return LookingAround(0.5 * s); };
  int noticed = 0;
  for (const Frame& frame : TrackedFrames(16, Wrong({40.0, 40.0, 0, 0}), glance, kNoise, 5)) {
    noticed += check.See(frame);
  }
  EXPECT_EQ(noticed, 1);
  EXPECT_THAT(check.Warning(), testing::HasSubstr("the camera is not what"));
  for (Frame frame : TrackedFrames(240, Camera{}, LookingAround, kNoise, 6)) {
    for (int& id : frame.map_points) id += 1000;  // of another place
    frame.timestamp_s += 10.0;
    EXPECT_FALSE(check.See(frame));
  }
  EXPECT_THAT(check.Warning(), testing::HasSubstr("do not bear it out"));
}

TEST(CameraCheck, WhatIsWrongWithOneViewIsNotBorneOutByAllThatShareIt) {
  // The first view, which the later ones are compared with, is a little wide: ten pairs say by
  // common consent that the centre is 15 px off, and scatter by 1 or 2.
  const Camera camera;
  const auto turning = [](double s) {
    return Inverse(Pose{ExpSo3({0.1 * s, 0.3 * s, 0}), {0.1 * s, 0, 0}});
  };
  for (const std::uint64_t seed : {7u, 8u, 9u, 10u}) {
    CameraCheck check(camera, FeatureScale{});
    std::vector<Frame> frames = TrackedFrames(24, camera, turning, kNoise, seed);
    for (PointFeature& feature : frames.front().features) {
      feature.u_px.x() = camera.cx + 1.01 * (feature.u_px.x() - camera.cx);
    }
    for (const Frame& frame : frames) EXPECT_FALSE(check.See(frame)) << check.Warning();
    EXPECT_LT(check.Estimate()->found[2], camera.cx - 10.0);
  }
}

TEST(CameraCheck, SaysNothingOfAWrongCameraThatHardlyTurns) {
  const auto hardly = [](double s) {
    return Inverse(Pose{ExpSo3({0.012 * std::sin(2 * s), 0.015 * std::sin(3 * s), 0}),
                        {0.3 * std::sin(s), 0.1 * s, 0.1 * std::sin(2 * s)}});
  };
  const Camera wrong = Wrong({30.0, 30.0, 0.0, 0.0});
  CameraCheck check(wrong, FeatureScale{}), turning(wrong, FeatureScale{});
  int noticed = 0;
  for (const Frame& frame : TrackedFrames(90, Camera{}, hardly, kNoise, 3)) {
    noticed += check.See(frame);
  }
  EXPECT_EQ(noticed, 0);
  for (const Frame& frame : TrackedFrames(90, Camera{}, LookingAround, kNoise, 3)) {
    noticed += turning.See(frame);
  }
  EXPECT_EQ(noticed, 1);
}

TEST(CameraCheck, KeepsTheViewsThatAreMostApartHoweverManyComeLater) {
  // Two seconds of wide looks, and then many that turn half as far.
  const auto way = [](double s) {
    const Pose T_wc = Inverse(LookingAround(s));
    return s < 2.0 ? Inverse(T_wc) : Inverse(Pose{ExpSo3(0.5 * LogSo3(T_wc.R)), T_wc.t});
  };
  CameraCheck check(Camera{}, FeatureScale{});
  double wide_rad = 0.0;
  for (const Frame& frame : TrackedFrames(300, Camera{}, way, kNoise, 12)) {
    check.See(frame);
    if (frame.index == 59) wide_rad = check.Estimate()->turn_rad;
  }
  EXPECT_GT(wide_rad, 0.3);
  EXPECT_GE(check.Estimate()->turn_rad, wide_rad);
}

TEST(CameraCheck, KeepsItsViewsOverADarkFrame) {
  std::size_t pairs[2];
  for (const bool dark : {false, true}) {
    CameraCheck check(Camera{}, FeatureScale{});
    for (Frame& frame : TrackedFrames(60, Camera{}, LookingAround, kNoise, 5)) {
      if (frame.index % 20 == 15) {
        if (!dark) continue;
        frame.features.clear(), frame.map_points.clear();  // held by its planes
      }
      check.See(frame);
    }
    pairs[dark] = check.Estimate()->pairs;
  }
  EXPECT_EQ(pairs[true], pairs[false]);
}

}  // namespace
}  // namespace slam
