#include "tests/support/fault_stream.h"
#include "io/input_error.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/support/refusal.h"
#include "tests/support/stream_run.h"
#include "tests/support/temporary_folder.h"

// The fault matrix F1 to F18: what a stream does wrong must not crash the system, put a number
// that is not finite into a result, or give a wrong pose for a right one.
namespace slam {
namespace {

using test_support::RefusalOf;

TEST(FaultStream, WithoutAFaultEveryFrameIsTracked) {
  const Ran ran = RunOn(Clean());
  EXPECT_EQ(ran.outcome.tracked, kFrames);
  EXPECT_TRUE(ran.outcome.warnings.empty());
  EXPECT_THAT(ran.states, testing::Each("tracking"));
  ExpectNoWrongPose(ran);
}

TEST(FaultStreamF1, MissingFramesAreBridgedOrSaidLost) {
  for (const int count : {1, 5, 30}) {
    auto stream = Clean();
    stream.erase(stream.begin() + 20, stream.begin() + 20 + count);
    const Ran ran = RunOn(stream);
    ExpectNoWrongPose(ran);
    EXPECT_EQ(ran.states.back(), "tracking");
    EXPECT_GE(ran.outcome.tracked, static_cast<int>(stream.size()) - 2);
  }
}

TEST(FaultStreamF2, TheSecondOfTwoFramesOfOneTimeIsLeftOut) {
  const Ran clean = RunOn(Clean());
  auto stream = Clean();
  for (const int at : {50, 31, 30, 7}) {
    stream.insert(stream.begin() + at, stream[static_cast<std::size_t>(at)]);
  }
  const Ran ran = RunOn(stream);
  EXPECT_EQ(ran.trajectory, clean.trajectory);
  EXPECT_EQ(ran.map, clean.map);
  ASSERT_EQ(ran.outcome.warnings.size(), 1u);
  EXPECT_THAT(ran.outcome.warnings[0], testing::HasSubstr("4 frames"));
}

// F3, an image that came twice: repeated_frame_test.cpp.

TEST(FaultStreamF4, FramesOutOfOrderAreLeftOutAndCounted) {
  auto swapped = Clean();
  std::swap(swapped[20], swapped[21]);
  auto shuffled = Clean();
  std::reverse(shuffled.begin() + 30, shuffled.begin() + 35);
  auto back = Clean();
  for (int i = 40; i < 45; ++i) back[static_cast<std::size_t>(i)].timestamp_s -= 10;
  int expected[] = {1, 4, 5}, n = 0;
  for (const auto& stream : {swapped, shuffled, back}) {
    const Ran ran = RunOn(stream);
    ExpectNoWrongPose(ran);
    ASSERT_EQ(ran.outcome.warnings.size(), 1u);
    const int left_out = expected[n++];
    EXPECT_THAT(ran.outcome.warnings[0],
                testing::HasSubstr(std::to_string(left_out) + " frame"));
    EXPECT_EQ(ran.states.size(), stream.size() - static_cast<std::size_t>(left_out));
  }
}

TEST(FaultStreamF5, BlackAndSaturatedImagesAreLostAndTheCameraIsFoundAgain) {
  const auto stream = CleanStream(85);
  for (const int grey : {0, 255}) {
    for (const int count : {1, 10, 60}) {
      const Ran ran = RunOn(Changed(stream, 20, count, [&](RecordedFrame& frame) {
        SetColour(frame, cv::Mat1b(frame.gray.size(), static_cast<std::uint8_t>(grey)));
      }));
      ExpectNoWrongPose(ran);
      for (int i = 20; i < 20 + count; ++i) {
        EXPECT_EQ(ran.states[static_cast<std::size_t>(i)], "lost");
      }
      EXPECT_EQ(ran.states[static_cast<std::size_t>(20 + count)], "relocalised");
      EXPECT_EQ(ran.states.back(), "tracking");
    }
  }
}

TEST(FaultStreamF5, AStreamThatIsBlackFromTheStartInitialisesLater) {
  const Ran ran = RunOn(Changed(Clean(), 0, 10, [](RecordedFrame& frame) {
    SetColour(frame, cv::Mat1b(frame.gray.size(), 0));
  }));
  EXPECT_EQ(ran.states[0], "initialising");
  EXPECT_EQ(ran.states[10], "tracking");
}

TEST(FaultStreamF6, WithDepthThatIsAllZeroNotANumberOrEndlessPointsCarryOn) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN(),
                  kMax = std::numeric_limits<float>::max(),
                  kInf = std::numeric_limits<float>::infinity();
  const auto stream = CleanStream(17);
  for (const float value : {0.0f, kNan, kMax, kInf, -1.0f}) {
    for (const Variant variant : {Variant::kPoints, Variant::kFull}) {
      const Ran ran = RunOn(
          Changed(stream, 4, 10, [&](RecordedFrame& frame) { frame.depth_m.setTo(value); }),
          variant);
      ExpectNoWrongPose(ran);
      ASSERT_EQ(ran.states.size(), 17u);
      for (std::size_t i = 4; i < 17; ++i)
        EXPECT_EQ(ran.states[i], "tracking") << value;  // by points
      for (std::size_t i = 4; i < 14; ++i) EXPECT_EQ(Measured(ran.planes[i]), "[]") << value;
    }
  }
}

TEST(FaultStreamF7, NotANumberInDepthIsNoMeasurement) {
  const auto stream = CleanStream(10);
  for (const int percent : {1, 20, 80}) {
    const auto sprinkled = [&](float value) {
      return RunOn(Changed(stream, 0, 10,
                           [&](RecordedFrame& frame) {
                             Random random{9, static_cast<std::uint64_t>(frame.index)};
                             for (float& z : frame.depth_m) {
                               if (random.Below(100) < percent) z = value;
                             }
                           }),
                   Variant::kFull);
    };
    const Ran zeros = sprinkled(0.0f);
    EXPECT_EQ(zeros.outcome.tracked, 10) << percent;
    ExpectNoWrongPose(zeros);
    for (const float value : {std::numeric_limits<float>::quiet_NaN(),
                              std::numeric_limits<float>::infinity(), -2.0f}) {
      const Ran ran = sprinkled(value);
      EXPECT_EQ(ran.trajectory, zeros.trajectory) << percent;
      EXPECT_EQ(ran.map, zeros.map) << percent;
    }
  }
}

RunOptions PointsAlone() {
  RunOptions options;
  options.variant = Variant::kPoints;
  return options;
}

// F8, a camera that is not the one said: wrong_camera_test.cpp.

TEST(FaultStreamF9, DepthOfAnotherUnitIsSaid) {
  for (const double scale : {0.2, 5.0, 1000.0}) {
    const Ran ran = RunOn(
        Changed(CleanStream(10), 0, 10, [&](RecordedFrame& frame) { frame.depth_m *= scale; }));
    ASSERT_EQ(ran.outcome.warnings.size(), 1u) << scale;
    EXPECT_THAT(ran.outcome.warnings[0],
                testing::AllOf(testing::HasSubstr("of 10 frames"),
                               testing::HasSubstr(scale < 1 ? "nearer" : "beyond"),
                               testing::HasSubstr("depth_factor")));
    if (scale == 1000.0) {
      EXPECT_EQ(ran.outcome.tracked, 0);
    }
  }
}

TEST(FaultStreamF10, DepthOfOtherFramesIsSaid) {
  for (const int late : {-10, -3, 3, 20}) {
    std::vector<RecordedFrame> stream;
    for (int i = 0; i < kFrames; ++i) {
      if (i + late < 0 || i + late >= kFrames) continue;
      stream.push_back(Clean()[static_cast<std::size_t>(i)]);
      stream.back().depth_m = Clean()[static_cast<std::size_t>(i + late)].depth_m;
    }
    const Ran ran = RunOn(stream);  // finite: RunOn looks
    EXPECT_THAT(ran.outcome.warnings,
                testing::ElementsAre(testing::HasSubstr("depth seems to be taken ")))
        << late;
  }
}

TEST(FaultStreamF11, AClockThatJumpsAnHourDoesNotThrowTheCamera) {
  auto stream = Clean();
  for (std::size_t i = 30; i < stream.size(); ++i) stream[i].timestamp_s += 3600;
  Ran ran = RunOn(stream);
  EXPECT_EQ(ran.outcome.tracked, kFrames);
  for (auto& [s, T_wc] : ran.poses_wc) s -= s > 3000 ? 3600 : 0;
  ExpectNoWrongPose(ran);
}

// F12 and F13, a camera that is set down elsewhere: kidnapped_test.cpp.

/// A stream whose file `at` cannot be read.
class BrokenStream : public FaultStream {
 public:
  BrokenStream(std::vector<RecordedFrame> frames, int at)
      : FaultStream(std::move(frames)), at_(at) {}
  RecordedFrame Read(int i) override {
    if (i == at_) throw io::InputError("rgb/7.png", "the image is truncated");
    return FaultStream::Read(i);
  }

 private:
  int at_;
};

// Which files cannot be read, and what is said of them: sequence_reader_test.cpp.
TEST(FaultStreamF14, AFileThatCannotBeReadEndsTheRunWithItsPathAndLeavesNoRun) {
  const test_support::TemporaryFolder folder;
  for (const bool async : {false, true}) {
    RunOptions options = PointsAlone();
    options.config.async_mapping = async;
    options.sequence = "stream";
    options.run = folder / "run";
    BrokenStream stream(CleanStream(10), 7);
    EXPECT_THAT(RefusalOf([&] {
                  RunLive({stream, CameraOfSize(320, 240), nullptr}, options);
                }),
                testing::HasSubstr("rgb/7.png"));
    EXPECT_FALSE(std::filesystem::exists(options.run));
  }
}

TEST(FaultStreamF15, AnImageOfAnotherSizeIsRefusedByItsFrame) {
  const auto smaller = [](RecordedFrame& frame) {
    cv::Mat half;
    cv::resize(frame.gray, half, {}, 0.5, 0.5);
    SetColour(frame, half);
  };
  const auto half_depth = [](RecordedFrame& frame) {
    frame.depth_m = frame.depth_m.rowRange(0, 100).clone();
  };
  for (const auto& change : {std::function<void(RecordedFrame&)>(smaller),
                             std::function<void(RecordedFrame&)>(half_depth)}) {
    EXPECT_THAT(RefusalOf([&] { RunOn(Changed(Clean(), 9, 1, change)); }),
                testing::AllOf(testing::HasSubstr("frame 9"), testing::HasSubstr("320 x 240")));
  }
}

// F16, brightness and negatives: colour_fault_test.cpp. F18, too near or too little: extreme_view_test.cpp.

TEST(RunLive, StopsWhereItIsAskedToAndKeepsWhatItHas) {
  RunOptions options;
  int done = 0;
  options.progress = [&](const char*, int frames, int) { done = frames; };
  options.stop = [&] { return done >= 7; };
  const Ran ran = RunStream(CleanStream(20), options);
  EXPECT_TRUE(ran.outcome.stopped);
  // The eighth was begun while the seventh was tracked.
  EXPECT_EQ(ran.outcome.frames, 8);
  EXPECT_EQ(ran.outcome.tracked, 8);
  EXPECT_EQ(ran.poses_wc.size(), 8u);
  EXPECT_FALSE(ran.map.empty());
}

/// Counts the frames that are read: the truth of a live run holds as many.
class CountedStream : public FaultStream {
 public:
  using FaultStream::FaultStream;
  RecordedFrame Read(int i) override {
    ++read;
    return FaultStream::Read(i);
  }
  int read = 0;
};

TEST(RunLive, RunsEveryFrameThatItReadsWhereverItStops) {
  const test_support::TemporaryFolder folder;
  for (const int threads : {1, 2}) {
    for (const int stop_at : {1, 4, 8, 9, 100}) {
      RunOptions options;
      options.run = folder / "run";
      options.sequence = "stream";
      options.force = true;
      options.threads = threads;
      options.variant = Variant::kPoints;
      int done = 0;
      options.progress = [&](const char*, int frames, int) { done = frames; };
      options.stop = [&] { return done >= stop_at; };
      CountedStream stream(CleanStream(10));
      const RunOutcome outcome = RunLive({stream, CameraOfSize(320, 240), nullptr}, options);
      EXPECT_EQ(outcome.frames, std::min(stop_at + 1, 10)) << threads;
      EXPECT_EQ(stream.read, outcome.frames) << threads << ", " << stop_at;
      EXPECT_EQ(outcome.stopped, outcome.frames < 10) << stop_at;
    }
  }
}

}  // namespace
}  // namespace slam
