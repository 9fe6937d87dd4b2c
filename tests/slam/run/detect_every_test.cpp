#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "slam/run/tracker.h"
#include "tests/support/textured_world.h"

namespace slam {
namespace {

/// Finds one book wherever it is asked, and notes when.
class NotingDetector : public Detector {
 public:
  explicit NotingDetector(std::vector<double>& asked_s) : asked_s_(asked_s) {}
  std::vector<Detection> Detect(double timestamp_s, const cv::Mat3b&) override {
    asked_s_.push_back(timestamp_s);
    Detection book{"book", ClassKind::kRegular, 0.5, {}, false};
    book.box_px = {{10, 20}, {110, 90}};
    return {book};
  }

 private:
  std::vector<double>& asked_s_;
};

class DetectEvery : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(OnThreads, DetectEvery, ::testing::Values(1, 4));

TEST_P(DetectEvery, AsksInEveryNthFrameAndCarriesTheBoxOverTheOthers) {
  constexpr int kEvery = 3, kFrames = 8;
  Config config;
  config.detection.every = kEvery;
  const Camera camera;
  const TexturedCorner corner;
  std::vector<double> asked_s;
  Tracker tracker(camera, config, Variant::kFull, std::make_unique<NotingDetector>(asked_s), 0,
                  GetParam());
  std::vector<double> expected_s;
  for (int i = 0; i < kFrames; ++i) {
    Frame frame = corner.See(camera, Pose{}, i);
    const cv::Mat3b colour(camera.height, camera.width, cv::Vec3b(0, 0, 0));
    const TrackReport report = tracker.TrackFrame(frame, colour);
    const bool asked = i % kEvery == 0;
    if (asked) expected_s.push_back(frame.timestamp_s);
    EXPECT_EQ(frame.detector_asked, asked) << i;
    EXPECT_EQ(report.times[Module::kOd] > 0, asked) << i;
    ASSERT_EQ(frame.detections.size(), 1u) << i;
    EXPECT_EQ(frame.detections[0].class_name, "book");
    EXPECT_EQ(frame.detections[0].compensated, !asked) << i;
  }
  EXPECT_EQ(asked_s, expected_s);
}

}  // namespace
}  // namespace slam
