#include "slam/calibrate/registration_learner.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "slam/base/random.h"
#include "tests/support/slam_matchers.h"

namespace slam {
namespace {

/// How colour shows the boards that hang before a wall.
enum class Print {
  kBoards,  ///< each in a grey of its own
  kRims,    ///< boards whose left and lower rims, 7 pixels wide, stand out more than their ends
  kTopRims,  ///< boards with a rim along their upper ends alone, 3 pixels wide, which stand out less
  kNothing,  ///< none: noise
  kBlinds,   ///< the whole image has stripes of one width
};

struct Recording {
  cv::Point2d shift_px{0, 0};  ///< of colour over depth
  double grown_px = 0.0;       ///< of the boards in depth, on each side
  Print print = Print::kBoards;
  int frames = 40;
  double late_s = 0.0;
  Vector6d speed = Vector6d::Zero();
  bool moves = true;     ///< turns from frame to frame
  double slide_m = 0.0;  ///< aside, from frame to frame
};

/// Fills the part of each pixel that a rectangle covers.
void FillExactly(cv::Mat1f& image, double u0, double v0, double u1, double v1, float value) {
  for (int v = 0; v < image.rows; ++v) {
    for (int u = 0; u < image.cols; ++u) {
      const double across = std::min(u + 0.5, u1) - std::max(u - 0.5, u0);
      const double down = std::min(v + 0.5, v1) - std::max(v - 0.5, v0);
      if (across <= 0 || down <= 0) continue;
      const auto part = static_cast<float>(across * down);
      image(v, u) += part * (value - image(v, u));
    }
  }
}

void LearnMore(const Recording& recording, RegistrationLearner& learner) {
  for (int i = 0; i < recording.frames; ++i) {
    Random random{5, static_cast<std::uint64_t>(i)};
    cv::Mat1f depth_m(480, 640, 2.0f), gray(480, 640, 120.0f);
    for (int k = 0; k < 6; ++k) {  // in two rows, 200 pixels for each
      const double u0 = 40 + 200 * (k % 3) + 60 * random.Uniform(),
                   v0 = 40 + 220 * (k / 3) + 60 * random.Uniform(),
                   u1 = u0 + 40 + 60 * random.Uniform(), v1 = v0 + 40 + 60 * random.Uniform();
      const double grown = recording.grown_px;
      // Depth is of one thing or the other.
      const cv::Point from(static_cast<int>(std::ceil(u0 - grown)),
                           static_cast<int>(std::ceil(v0 - grown))),
          to(static_cast<int>(std::floor(u1 + grown)) + 1,
             static_cast<int>(std::floor(v1 + grown)) + 1);
      depth_m(cv::Rect(from, to)) = 1.0f;
      const cv::Point2d by = recording.shift_px;
      if (recording.print == Print::kRims) {
        constexpr double kRim_px = 7.0;
        FillExactly(gray, u0, v0, u1, v1, 140.0f);
        FillExactly(gray, u0 + kRim_px, v0, u1, v1 - kRim_px, 90.0f);
      }
      if (recording.print == Print::kTopRims) {
        FillExactly(gray, u0, v0, u1, v1, 130.0f);
        FillExactly(gray, u0, v0 + 3.0, u1, v1, 40.0f);
      }
      if (recording.print != Print::kBoards) continue;
      FillExactly(gray, u0 + by.x, v0 + by.y, u1 + by.x, v1 + by.y,
                  static_cast<float>(40 + 160 * random.Uniform()));
    }
    if (recording.print == Print::kBlinds) {
      for (int v = 0; v < 480; ++v) {
        for (int u = 0; u < 640; ++u) gray(v, u) = (u / 3 + v / 3) % 2 ? 60.0f : 180.0f;
      }
    }
    for (float& value : gray) value += 6.0f * (static_cast<float>(random.Uniform()) - 0.5f);
    Frame frame;
    gray.convertTo(frame.gray, CV_8U);
    frame.measured.depth_m = depth_m;
    frame.depth_late_s = recording.late_s, frame.speed.mean = recording.speed;
    const double turn_rad = recording.moves ? 0.03 : 0.0;
    frame.T_cw = {ExpSo3({0, turn_rad * i, 0}), {recording.slide_m * i, 0, 0}};
    learner.Learn(frame);
  }
}

RegistrationLearner Learn(const Recording& recording, double edge_growth_px = 4.0,
                          const RegistrationConfig& config = {}, const Camera& camera = {}) {
  RegistrationLearner learner(camera, edge_growth_px, config);
  LearnMore(recording, learner);
  return learner;
}

TEST(RegistrationLearner, FindsHowFarColourLiesBesideDepth) {
  for (const cv::Point2d shift : {cv::Point2d(2.0, -1.5), {-3.3, 1.0}, {1.2, 3.5}}) {
    Camera camera;
    camera.fy = 0.7 * camera.fx;  // neither stands for the other
    const RegistrationLearner learner = Learn({.shift_px = shift}, 4.0, {}, camera);
    ASSERT_TRUE(learner.estimate());
    const RegistrationEstimate& found = *learner.estimate();
    EXPECT_TRUE(found.clear);
    EXPECT_NEAR(found.shift_px.x(), shift.x, 0.2);
    EXPECT_NEAR(found.shift_px.y(), shift.y, 0.2);
    EXPECT_LT(found.sigma_px.maxCoeff(), 0.2);
    // What the camera of colour sees at u the other sees at u - shift.
    const Eigen::Vector2d u(camera.cx, camera.cy);
    const Eigen::Vector2d there = camera.Project(learner.R_dc() * camera.Backproject(u, 1.0));
    EXPECT_LT((u - there - Eigen::Vector2d(shift.x, shift.y)).norm(), 0.3);
  }
}

TEST(RegistrationLearner, DoesNotTakeWhatDepthMakesWiderForAShift) {
  const RegistrationLearner learner = Learn({.shift_px = {1.5, 0.0}, .grown_px = 2.0});
  ASSERT_TRUE(learner.estimate());
  EXPECT_NEAR(learner.estimate()->grown_px, 2.0, 0.25);
  EXPECT_NEAR(learner.estimate()->shift_px.x(), 1.5, 0.2);
  EXPECT_EQ(learner.estimate()->applied_px.y(), 0.0);
}

TEST(RegistrationLearner, LeavesWhatIsLessThanAPixel) {
  const RegistrationLearner learner = Learn({.shift_px = {0.4, -0.4}});
  ASSERT_TRUE(learner.estimate());
  EXPECT_TRUE(learner.estimate()->applied_px.isZero(0.0));
  EXPECT_TRUE(learner.R_dc().isIdentity(0.0));
}

TEST(RegistrationLearner, LeavesWhatTheMotionBetweenTheImagesExplains) {
  // The board at 1 m moves by 3 pixels, 5.7 mm, from the colour image to the depth image.
  Recording recording{.shift_px = {3.0, 0.0}, .late_s = 0.02};
  recording.speed[0] = -3.0 / Camera{}.fx / recording.late_s;
  const RegistrationLearner learner = Learn(recording);
  ASSERT_TRUE(learner.estimate());
  EXPECT_NEAR(learner.estimate()->shift_px.x(), 0.0, 0.2);
  EXPECT_TRUE(learner.R_dc().isIdentity(0.0));
}

TEST(RegistrationLearner, LeavesWhatIsNotClear) {
  for (const Print print : {Print::kNothing, Print::kBlinds}) {
    const RegistrationLearner learner = Learn({.print = print});
    ASSERT_TRUE(learner.estimate());
    EXPECT_FALSE(learner.estimate()->clear);
    EXPECT_TRUE(learner.R_dc().isIdentity(0.0));
  }
}

// The ends of two sides and the rims inside of the two others lie as if depth were 3.5 pixels wider, and
// as far aside. No structured light makes things so much wider.
TEST(RegistrationLearner, TakesNoRimsForAShiftOfASensorThatMakesNothingMuchWider) {
  const RegistrationLearner any = Learn({.print = Print::kRims}),
                            kinect1 = Learn({.print = Print::kRims}, 1.5);
  ASSERT_TRUE(any.estimate() && kinect1.estimate());
  EXPECT_GT(any.estimate()->shift_px.norm(), 4.0);
  EXPECT_LT(kinect1.estimate()->shift_px.norm(), 0.5);
  // The rims explain as much as the ends do: edges tell too little here, whatever the sensor.
  EXPECT_FALSE(kinect1.estimate()->clear);
  EXPECT_TRUE(kinect1.R_dc().isIdentity(0.0));
}

TEST(RegistrationLearner, TakesNoRimOfOneSideForAShift) {
  // Upper ends seem 3 pixels lower: half of that is a shift, half a growth that left and right ends
  // do not show. All epochs agree.
  const RegistrationLearner learner = Learn({.print = Print::kTopRims});
  ASSERT_TRUE(learner.estimate());
  EXPECT_TRUE(learner.estimate()->clear);
  EXPECT_GT(learner.estimate()->shift_px.y(), 1.0);
  EXPECT_GT(learner.estimate()->sigma_px.y(), 1.0);
  EXPECT_TRUE(learner.R_dc().isIdentity(0.0));
}

TEST(RegistrationLearner, LearnsNothingWhileTheCameraStands) {
  EXPECT_FALSE(Learn({.shift_px = {3.0, 0.0}, .moves = false}).estimate());
}

TEST(RegistrationLearner, LearnsAsMuchFromACameraThatSlidesAsFromOneThatTurns) {
  // At 1 m 3 cm aside move the image by as much as 0.03 radians do: 16 pixels.
  const RegistrationLearner turning = Learn({.shift_px = {2.0, -1.5}, .frames = 10});
  const RegistrationLearner sliding =
      Learn({.shift_px = {2.0, -1.5}, .frames = 10, .moves = false, .slide_m = 0.03});
  ASSERT_TRUE(turning.estimate() && sliding.estimate());
  EXPECT_EQ(sliding.estimate()->epochs, turning.estimate()->epochs);
  EXPECT_TRUE(sliding.estimate()->clear);
  EXPECT_NEAR(sliding.estimate()->shift_px.x(), 2.0, 0.2);
  EXPECT_NEAR(sliding.estimate()->shift_px.y(), -1.5, 0.2);
}

TEST(RegistrationLearner, LearnsNothingFromAFrameOrTwo) {
  EXPECT_FALSE(Learn({.shift_px = {3.0, 0.0}, .frames = 2}).estimate());
}

TEST(RegistrationLearner, StaysAsItIsOnceItIsHeld) {
  RegistrationLearner held = Learn({.shift_px = {3.0, 0.0}}), free = held;
  held.Hold();
  const Eigen::Vector2d before_px = held.estimate()->shift_px;
  for (RegistrationLearner* learner : {&held, &free})
    LearnMore({.shift_px = {-2.0, 2.0}}, *learner);
  EXPECT_EQ(held.estimate()->shift_px, before_px);
  EXPECT_NE(free.estimate()->shift_px, before_px);
}

TEST(RegistrationLearner, CanBeForbidden) {
  EXPECT_FALSE(Learn({.shift_px = {3.0, 0.0}}, 4.0, {.learn = false}).estimate());
}

}  // namespace
}  // namespace slam
