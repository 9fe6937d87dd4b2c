#include "eval/draw/error_picture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numbers>
#include <opencv2/imgproc.hpp>

namespace eval {
namespace {

using ::testing::HasSubstr;

/// Twenty frames on a bend, ten a second, the run equal to its truth.
struct Path {
  Run run;
  Sequence sequence;
};

Path MakePath() {
  Path path;
  path.sequence.synthetic = true;
  for (int i = 0; i < 20; ++i) {
    const double t = 5 + 0.1 * i;
    Pose T_gc;
    T_gc.t = {0.05 * i, 0.01 * i * i, 0.3 * std::sin(0.2 * i)};
    T_gc.R = Eigen::AngleAxisd(0.02 * i, Eigen::Vector3d::UnitY()).toRotationMatrix();
    path.run.trajectory.push_back({t, T_gc});
    path.run.frames.push_back({t, {}, i + 1});
    path.sequence.frames.push_back({t, "", t, "", 0});
  }
  path.sequence.groundtruth = path.run.trajectory;
  return path;
}

void Lose(Run& run, int first, int last) {
  run.trajectory.erase(run.trajectory.begin() + first, run.trajectory.begin() + last + 1);
}

TEST(RoundStep, IsOneTwoOrFiveTimesAPowerOfTen) {
  EXPECT_DOUBLE_EQ(RoundStep(10, 10), 1);
  EXPECT_DOUBLE_EQ(RoundStep(37, 10), 5);
  EXPECT_DOUBLE_EQ(RoundStep(0.18, 10), 0.02);
  EXPECT_DOUBLE_EQ(RoundStep(0, 10), 1);
}

TEST(ErrorsOverTime, VanishForARunThatIsTheTruth) {
  const Path path = MakePath();
  const auto curve = ErrorsOverTime(path.run, path.sequence);
  ASSERT_TRUE(curve.has_value());
  EXPECT_EQ(curve->alignment, ErrorAlignment::kPositions);
  EXPECT_NEAR(curve->duration_s, 1.9, 1e-9);
  EXPECT_TRUE(curve->gaps.empty());
  ASSERT_EQ(curve->samples.size(), 20u);
  for (const ErrorSample& sample : curve->samples) {
    EXPECT_LT(sample.position_mm, 1e-6);
    EXPECT_LT(sample.rotation_deg, 1e-6);
  }
}

TEST(ErrorsOverTime, ShowATurnOfOneFrameInTheRotationErrorAlone) {
  Path path = MakePath();
  constexpr double kTurn_deg = 3;
  Pose& turned = path.run.trajectory[7].T_wc;
  turned.R *= Eigen::AngleAxisd(kTurn_deg * std::numbers::pi / 180, Eigen::Vector3d::UnitX())
                  .toRotationMatrix();
  const auto curve = ErrorsOverTime(path.run, path.sequence);
  ASSERT_TRUE(curve.has_value());
  // The mean rotation takes a twentieth of it.
  EXPECT_NEAR(curve->samples[7].rotation_deg, kTurn_deg * 19 / 20, 0.01);
  EXPECT_NEAR(curve->samples[6].rotation_deg, kTurn_deg / 20, 0.01);
  EXPECT_LT(curve->samples[7].position_mm, 1e-6);
}

/// Errors of three metres and of three millimetres make the same numbers and curves.
TEST(ErrorPicture, SaysWhetherItsNumbersAreMillimetresOrMetres) {
  const Path path = MakePath();
  const auto curve_of = [&](double scale) {
    auto curve = ErrorsOverTime(path.run, path.sequence);
    for (std::size_t i = 0; i < curve->samples.size(); ++i)
      curve->samples[i].position_mm = scale * (1 + static_cast<double>(i % 3));
    return *curve;
  };
  const cv::Mat in_mm = DrawErrors(curve_of(1), {}), in_m = DrawErrors(curve_of(1000), {});
  ASSERT_EQ(in_mm.size(), in_m.size());
  cv::Mat changed;
  cv::cvtColor(cv::Mat(in_mm != in_m), changed, cv::COLOR_BGR2GRAY);
  const cv::Rect where = cv::boundingRect(changed);
  EXPECT_GT(where.area(), 0) << "the unit";
  EXPECT_LT(where.height, 30) << "and nothing else";
}

TEST(ErrorsOverTime, ShadeSpansInWhichTheRunIsLost) {
  Path path = MakePath();
  Lose(path.run, 15, 15);
  Lose(path.run, 4, 7);
  const auto curve = ErrorsOverTime(path.run, path.sequence);
  ASSERT_TRUE(curve.has_value());
  ASSERT_EQ(curve->gaps.size(), 2u);
  EXPECT_EQ(curve->gaps[0].gap, Gap::kLost);
  EXPECT_EQ(curve->gaps[0].frames, 4);
  EXPECT_NEAR(curve->gaps[0].from_s, 0.35, 1e-9);
  EXPECT_NEAR(curve->gaps[0].to_s, 0.75, 1e-9);
  EXPECT_EQ(curve->gaps[1].frames, 1);
  EXPECT_EQ(curve->samples.size(), 15u);
  const cv::Mat whole = DrawErrors(*ErrorsOverTime(MakePath().run, path.sequence), {});
  EXPECT_GT(DrawErrors(*curve, {}).rows, whole.rows) << "the legend says what the shade means";
}

// What the error was before a gap is seen there alone: no line leads from it over the gap.
TEST(ErrorPicture, LeadsNoLineOverASpanWithoutErrors) {
  Path path = MakePath();
  Lose(path.run, 6, 15);
  const auto page = [&](std::size_t peak) {
    auto curve = ErrorsOverTime(path.run, path.sequence);
    for (ErrorSample& sample : curve->samples) sample.position_mm = sample.rotation_deg = 1;
    curve->samples[peak].position_mm = curve->samples[peak].rotation_deg = 3;
    return DrawErrors(*curve, {});
  };
  const cv::Mat last = page(5), last_but_one = page(4);  // frames before the gap
  ASSERT_EQ(last.size(), last_but_one.size());
  cv::Mat changed;
  cv::cvtColor(cv::Mat(last != last_but_one), changed, cv::COLOR_BGR2GRAY);
  const cv::Rect where = cv::boundingRect(changed);
  EXPECT_GT(where.width, 0);
  EXPECT_LT(where.width, 3 * last.cols / 19) << "two of 19 steps, and the width of a dot";
}

TEST(ErrorsOverTime, CountFromTheFirstFrameAlsoOfARunThatWasLostThen) {
  Path path = MakePath();
  Lose(path.run, 0, 4);
  const auto curve = ErrorsOverTime(path.run, path.sequence);
  ASSERT_TRUE(curve.has_value());
  EXPECT_NEAR(curve->samples.front().time_s, 0.5, 1e-9);
  EXPECT_NEAR(curve->samples.back().time_s, curve->duration_s, 1e-9);
}

TEST(ErrorsOverTime, TellWhatWasNotRunFromWhatWasLost) {
  Path path = MakePath();
  Lose(path.run, 10, 19);
  path.run.frames.resize(12);
  path.run.info.interrupted = true;
  const auto curve = ErrorsOverTime(path.run, path.sequence);
  ASSERT_TRUE(curve.has_value());
  ASSERT_EQ(curve->gaps.size(), 2u);
  EXPECT_EQ(curve->gaps[0].gap, Gap::kLost);
  EXPECT_EQ(curve->gaps[0].frames, 2);
  EXPECT_EQ(curve->gaps[1].gap, Gap::kNotRun);
  EXPECT_EQ(curve->gaps[1].frames, 8);
  EXPECT_DOUBLE_EQ(curve->gaps[0].to_s, curve->gaps[1].from_s);
}

TEST(ErrorsOverTime, TellFramesWithoutATruePose) {
  Path path = MakePath();
  auto& truth = *path.sequence.groundtruth;
  truth.erase(truth.begin(), truth.begin() + 5);
  const auto curve = ErrorsOverTime(path.run, path.sequence);
  ASSERT_TRUE(curve.has_value());
  ASSERT_EQ(curve->gaps.size(), 1u);
  EXPECT_EQ(curve->gaps[0].gap, Gap::kNoTruth);
  EXPECT_EQ(curve->gaps[0].frames, 5);
}

TEST(ErrorsOverTime, SayWhyTheRunIsNotAligned) {
  Path nothing = MakePath();
  nothing.run.trajectory.clear();
  EXPECT_EQ(ErrorsOverTime(nothing.run, nothing.sequence)->alignment,
            ErrorAlignment::kNothingTracked);
  Path elsewhere = MakePath();
  for (StampedPose& pose : *elsewhere.sequence.groundtruth) pose.stamp_s += 100;
  const auto curve = ErrorsOverTime(elsewhere.run, elsewhere.sequence);
  EXPECT_EQ(curve->alignment, ErrorAlignment::kNoSharedTime);
  EXPECT_TRUE(curve->samples.empty());
  EXPECT_THAT(Explain(curve->alignment), HasSubstr("no pose of the run has the time"));
  EXPECT_FALSE(DrawErrors(*curve, {}).empty());
}

TEST(ErrorsOverTime, AreTakenAfterAnAlignmentOfPosesWhereTheAteIsNotDefined) {
  Path path = MakePath();
  Lose(path.run, 2, 19);
  const auto curve = ErrorsOverTime(path.run, path.sequence);
  EXPECT_EQ(curve->alignment, ErrorAlignment::kPoses);
  EXPECT_EQ(curve->samples.size(), 2u);
  EXPECT_THAT(Explain(curve->alignment), HasSubstr("the ATE is not defined"));
}

TEST(ErrorsOverTime, AreNotDrawnWhereTheyAreBeyondAnyPath) {
  Path path = MakePath();
  path.run.trajectory[3].T_wc.t.x() = 1e200;
  const auto curve = ErrorsOverTime(path.run, path.sequence);
  EXPECT_EQ(curve->alignment, ErrorAlignment::kNotFinite);
  EXPECT_FALSE(DrawErrors(*curve, {}).empty());
}

TEST(ErrorsOverTime, NeedTruePosesAndTwoFrames) {
  Path path = MakePath();
  path.sequence.frames.resize(1);
  EXPECT_FALSE(ErrorsOverTime(path.run, path.sequence).has_value());
  path = MakePath();
  path.sequence.groundtruth.reset();
  EXPECT_FALSE(ErrorsOverTime(path.run, path.sequence).has_value());
}

}  // namespace
}  // namespace eval
