#include <gmock/gmock.h>

#include <thread>

#include "io/input_error.h"
#include "slam/run/tracker.h"
#include "tests/support/textured_world.h"

namespace slam {
namespace {

using ::testing::StrEq;
using ::testing::ThrowsMessage;

/// Finds one book, fails on the frame it is told to, and notes the thread that asked.
class BookFinder : public Detector {
 public:
  BookFinder(std::thread::id& asked_by, double fails_at_s)
      : asked_by_(asked_by), fails_at_s_(fails_at_s) {}
  std::vector<Detection> Detect(double timestamp_s, const cv::Mat3b& bgr) override {
    asked_by_ = std::this_thread::get_id();
    if (timestamp_s >= fails_at_s_) throw io::InputError("model", "has no answer");
    Detection book{"book", ClassKind::kRegular, 0.5, {}, false};
    book.box_px = {{1, 2}, {bgr.cols / 2.0, bgr.rows / 2.0}};
    return {book};
  }

 private:
  std::thread::id& asked_by_;
  double fails_at_s_;
};

class DetectionBesidePoints : public ::testing::TestWithParam<int> {
 protected:
  Camera camera_;
  TexturedCorner corner_;
  std::thread::id asked_by_;

  Tracker Track(double fails_at_s) {
    return {
        camera_, {},        Variant::kFull, std::make_unique<BookFinder>(asked_by_, fails_at_s),
        0,       GetParam()};
  }
  cv::Mat3b Colour() const {
    return cv::Mat3b(camera_.height, camera_.width, cv::Vec3b(0, 0, 0));
  }
};
INSTANTIATE_TEST_SUITE_P(OnThreads, DetectionBesidePoints, ::testing::Values(1, 4));

TEST_P(DetectionBesidePoints, IsThereWhenTheFrameIsDoneAndOnAThreadOfItsOwn) {
  Tracker tracker = Track(1e9);
  Frame frame = corner_.See(camera_, Pose{}, 0);
  const TrackReport report = tracker.TrackFrame(frame, Colour());
  ASSERT_EQ(frame.detections.size(), 1u);
  EXPECT_EQ(frame.detections[0].class_name, "book");
  EXPECT_TRUE(report.tracked);
  EXPECT_EQ(asked_by_ != std::this_thread::get_id(), GetParam() > 1);
}

TEST_P(DetectionBesidePoints, CarriesItsErrorToTheCaller) {
  Tracker tracker = Track(0.01);
  Frame first = corner_.See(camera_, Pose{}, 0);
  tracker.TrackFrame(first, Colour());
  Frame second = corner_.See(camera_, Pose{}, 1);
  EXPECT_THAT([&] { tracker.TrackFrame(second, Colour()); },
              ThrowsMessage<io::InputError>(StrEq("model: has no answer")));
}

}  // namespace
}  // namespace slam
