#include "eval/surfaces/depth_views.h"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "eval/surfaces/depth_registration.h"
#include "io/atomic_file.h"
#include "tests/support/image_files.h"
#include "tests/support/refusal.h"
#include "tests/support/temporary_folder.h"

namespace eval {
namespace {

DepthRegistration Kitchen() {
  DepthRegistration registration;
  registration.depth = {640, 480, 585, 585, 320, 240, 30, 1000, {}};
  registration.colour = {640, 480, 525.93, 525.93, 322.43, 236.17, 30, 1000, {}};
  registration.T_colour_depth.t = {-0.0313, 0.0065, 0};
  return registration;
}

TEST(DepthViews, AreSeenFromWhereTheCameraWasWhenDepthWasTaken) {
  Sequence sequence;
  sequence.groundtruth.emplace(2);
  (*sequence.groundtruth)[0].stamp_s = 1.0;
  (*sequence.groundtruth)[1] = {1.1, {Eigen::Matrix3d::Identity(), {1, 0, 0}}};
  sequence.frames = {
      {1.0, "", 1.015, "", 0}, {1.05, "", 1.04, "", 0}, {1.09, "", 1.105, "", 0}};
  const DepthViews views(sequence, Kitchen().colour, std::nullopt);
  ASSERT_EQ(views.size(), 2u) << "the last one's depth was taken after the last pose";
  EXPECT_NEAR(views.PoseOf(0).t.x(), 0.15, 1e-9);
  EXPECT_NEAR(views.PoseOf(1).t.x(), 0.4, 1e-9);
  EXPECT_EQ(views.StampOf(0), 1.0);
}

// The file of the registration tells no unit: TUM has 5000 a metre.
TEST(DepthViews, OfARegisteredCameraAreInTheUnitOfTheRecording) {
  const test_support::TemporaryFolder folder;
  std::filesystem::create_directories(folder / "depth");
  test_support::WriteImageFile(folder / "depth/1.png", cv::Mat1w(60, 80, std::uint16_t(7500)));
  Sequence sequence;
  sequence.folder = folder.path();
  sequence.groundtruth.emplace(1);
  sequence.groundtruth->front().stamp_s = 1.0;
  sequence.frames = {{1.0, "", 1.0, "depth/1.png", 0}};
  const Camera recorded{80, 60, 70, 70, 39.5, 29.5, 30, 5000, {}};
  DepthRegistration registration;
  registration.depth = registration.colour = {80, 60, 70, 70, 39.5, 29.5, 30, 1000, {}};
  for (const bool registered : {false, true}) {
    const DepthViews views(sequence, recorded,
                           registered ? std::optional(registration) : std::nullopt);
    EXPECT_FLOAT_EQ(views.Read(0).depth_m(30, 40), 1.5F) << registered;
  }
}

// 7-Scenes and others write it where nothing was measured; no sensor sees 65 m.
TEST(DepthViews, HoldNothingWhereDepthIsTheLargestNumber) {
  const test_support::TemporaryFolder folder;
  std::filesystem::create_directories(folder / "depth");
  cv::Mat1w stored(60, 80, std::uint16_t(7500));
  stored(30, 40) = 65535, stored(30, 41) = 65534;
  test_support::WriteImageFile(folder / "depth/1.png", stored);
  Sequence sequence;
  sequence.folder = folder.path();
  sequence.groundtruth.emplace(1);
  sequence.groundtruth->front().stamp_s = 1.0;
  sequence.frames = {{1.0, "", 1.0, "depth/1.png", 0}};
  const Camera camera{80, 60, 70, 70, 39.5, 29.5, 30, 5000, {}};
  const cv::Mat1f depth_m = DepthViews(sequence, camera, std::nullopt).Read(0).depth_m;
  EXPECT_EQ(depth_m(30, 40), 0.0F);
  EXPECT_FLOAT_EQ(depth_m(30, 41), 65534 / 5000.0F);
}

TEST(LayOnColour, PutsADepthWhereTheColourCameraSeesItWithoutHoles) {
  const DepthRegistration registration = Kitchen();
  cv::Mat1f depth_m(480, 640, 2.0F);
  depth_m(240, 320) = 1.0F;
  const cv::Mat1f laid_m = LayOnColour(depth_m, registration);
  // The point in the middle, 1 m away: (-0.0313, 0.0065, 1) in the colour camera.
  const int u = int(std::lround(322.43 - 525.93 * 0.0313));
  const int v = int(std::lround(236.17 + 525.93 * 0.0065));
  EXPECT_FLOAT_EQ(laid_m(v, u), 1.0F);
  const cv::Mat1f inside = laid_m(cv::Rect(100, 60, 400, 340));
  EXPECT_EQ(cv::countNonZero(inside), int(inside.total()) - 1)
      << "all but the pixel that the near point hid from the depth camera";
}

TEST(LayOnColour, TellsHowFarItIsFromTheColourCamera) {
  DepthRegistration registration = Kitchen();
  registration.T_colour_depth.t.z() = 0.05;
  const cv::Mat1f laid_m = LayOnColour(cv::Mat1f(480, 640, 2.0F), registration);
  EXPECT_FLOAT_EQ(laid_m(236, 322), 2.05F);
}

TEST(ReadDepthRegistration, ReadsTwoCamerasAndTheWayBetweenThem) {
  const test_support::TemporaryFolder folder;
  const std::filesystem::path path = folder / "registration.yaml";
  const std::string cameras =
      "depth: {width: 640, height: 480, fx: 585, fy: 585, cx: 320, cy: 240}\n"
      "colour: {width: 640, height: 480, fx: 525.93, fy: 525.93, cx: 322.43, cy: 236.17}\n";
  io::WriteFile(path, cameras + "translation: [-0.0313, 0.0065, 0]\nrotation: [0, 0, 0, 1]\n");
  const DepthRegistration registration = ReadDepthRegistration(path);
  EXPECT_EQ(registration.depth.fx, 585);
  EXPECT_EQ(registration.colour.cy, 236.17);
  EXPECT_EQ(registration.T_colour_depth.t.x(), -0.0313);

  io::WriteFile(path, cameras + "translation: [-31.3, 6.5, 0]\n");  // in millimetres
  EXPECT_THAT(test_support::RefusalOf([&] { ReadDepthRegistration(path); }),
              ::testing::HasSubstr(".yaml:3: translation"));
}

TEST(LayOnColour, LeavesNoHolesWhereColourHasMorePixelsThanDepth) {
  DepthRegistration registration;
  registration.depth = {160, 120, 140, 140, 79.5, 59.5, 30, 1000, {}};
  registration.colour = {640, 360, 560, 420, 319.5, 179.5, 30, 1000, {}};
  registration.T_colour_depth.t = {0.02, 0, 0};  // 5.6 pixels of colour at 2 m
  const cv::Mat1f laid_m = LayOnColour(cv::Mat1f(120, 160, 2.0F), registration);
  EXPECT_EQ(cv::countNonZero(laid_m(cv::Rect(10, 2, 620, 356)) == 0), 0);
  cv::Mat1f one_m(120, 160, 0.0F);
  one_m(60, 80) = 2.0F;
  // A pixel of depth is 4 x 3 of colour, or one more each way where it ends between two.
  const cv::Mat covered = LayOnColour(one_m, registration) > 0;
  const cv::Rect box = cv::boundingRect(covered);
  EXPECT_EQ(cv::countNonZero(covered), box.area());
  EXPECT_TRUE(box.width == 4 || box.width == 5) << box.width;
  EXPECT_TRUE(box.height == 3 || box.height == 4) << box.height;
}

TEST(LayOnColour, LeavesOutWhatTheLensWouldFoldBackIntoTheImage) {
  DepthRegistration registration;
  registration.depth = {640, 480, 180, 180, 320, 240, 30, 1000, {}};
  registration.colour = {640, 480, 525, 525, 319.5, 239.5, 30, 1000, {-0.25, 0, 0, 0, 0}};
  // By the model, x / z of 1.7 comes to lie at 0.47, 248 px from the middle.
  cv::Mat1f aside_m(480, 640, 0.0F), ahead_m = aside_m.clone();
  aside_m(240, 320 + 306) = 2.0F;
  ahead_m(240, 320 + 90) = 2.0F;
  EXPECT_EQ(cv::countNonZero(LayOnColour(aside_m, registration)), 0);
  EXPECT_GT(cv::countNonZero(LayOnColour(ahead_m, registration)), 0);
}

}  // namespace
}  // namespace eval
