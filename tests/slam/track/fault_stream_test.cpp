#include "tests/support/fault_stream.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

#include "slam/base/require.h"
#include "slam/track/run_sequence.h"

// The fault matrix F1 to F16: what a stream does wrong must not crash the system, put a number
// that is not finite into a result, or give a wrong pose for a right one.
namespace slam {
namespace {

constexpr int kFrames = 60;
// Twice what the clean stream comes to, 10 mm at a pixel of 8 mm.
constexpr double kPosition_m = 0.02;

std::string TextOf(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// What a run over a stream came to.
struct Ran {
  RunOutcome outcome;
  std::string trajectory, map;
  std::vector<std::string> states;                ///< by line of frame_planes.jsonl
  std::vector<std::pair<double, Pose>> poses_wc;  ///< (time, pose)
};

Ran RunOn(std::vector<RecordedFrame> frames, Variant variant = Variant::kPoints) {
  const auto folder = std::filesystem::temp_directory_path() /
                      ("pas_fault_stream_" + std::to_string(::getpid()));
  RunOptions options;
  options.sequence = "stream";
  options.run = folder;
  options.variant = variant;
  options.threads = 1;
  options.force = true;
  FaultStream stream(std::move(frames));
  Ran ran;
  ran.outcome = RunLive({stream, SmallCamera(320, 240), nullptr}, options);
  ran.trajectory = TextOf(folder / "trajectory.txt");
  ran.map = TextOf(folder / "map.json");
  std::istringstream lines(TextOf(folder / "frame_planes.jsonl"));
  for (std::string line; std::getline(lines, line);) {
    ran.states.push_back(nlohmann::json::parse(line).at("state"));
  }
  std::istringstream poses(ran.trajectory);
  for (std::string line; std::getline(poses, line);) {
    if (line.empty() || line[0] == '#') continue;
    std::istringstream words(line);
    double s = 0;
    Eigen::Vector3d t;
    Eigen::Quaterniond q;
    words >> s >> t.x() >> t.y() >> t.z() >> q.x() >> q.y() >> q.z() >> q.w();
    EXPECT_TRUE(words) << line;
    EXPECT_TRUE(t.allFinite() && q.coeffs().allFinite()) << line;
    ran.poses_wc.emplace_back(s, Pose{q.toRotationMatrix(), t});
  }
  std::filesystem::remove_all(folder);
  return ran;
}

/// Whether every pose is the one that the hand had at that time.
void ExpectNoWrongPose(const Ran& ran, double tolerance_m = kPosition_m) {
  for (const auto& [s, T_wc] : ran.poses_wc) {
    const int i = static_cast<int>(std::lround((s - 100.0) * 30));
    const Pose truth = SwingingPose(0) * Inverse(SwingingPose(i));
    EXPECT_LT((T_wc.t - truth.t).norm(), tolerance_m) << "frame " << i;
  }
}

const std::vector<RecordedFrame>& Clean() {
  static const std::vector<RecordedFrame> clean = CleanStream(kFrames);
  return clean;
}

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

TEST(FaultStreamF3, AnImageThatCameTwiceIsTheSamePlace) {
  auto stream = Clean();
  RecordedFrame again = stream[30];
  again.timestamp_s += 0.01;
  stream.insert(stream.begin() + 31, again);
  const Ran ran = RunOn(stream);
  ASSERT_EQ(ran.poses_wc.size(), stream.size());
  const Pose T = Inverse(ran.poses_wc[30].second) * ran.poses_wc[31].second;
  EXPECT_LT(T.t.norm(), 1e-3);
  EXPECT_LT(LogSo3(T.R).norm(), 1e-3);
}

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
  for (const int grey : {0, 255}) {
    for (const int count : {1, 10}) {
      const Ran ran = RunOn(Changed(Clean(), 20, count, [&](RecordedFrame& frame) {
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

TEST(FaultStreamF6, DepthThatIsAllZeroNotANumberOrEndlessMakesNoPlane) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN(),
                  kMax = std::numeric_limits<float>::max(),
                  kInf = std::numeric_limits<float>::infinity();
  for (const float value : {0.0f, kNan, kMax, kInf, -1.0f}) {
    for (const Variant variant : {Variant::kPoints, Variant::kFull}) {
      const Ran ran = RunOn(Changed(CleanStream(12), 4, 5,
                                    [&](RecordedFrame& frame) { frame.depth_m.setTo(value); }),
                            variant);
      ExpectNoWrongPose(ran);
      EXPECT_EQ(ran.states.size(), 12u);
    }
  }
}

TEST(FaultStreamF7, NotANumberInDepthIsNoMeasurement) {
  const auto sprinkle = [](float value) {
    return [value](RecordedFrame& frame) {
      Random random{9, static_cast<std::uint64_t>(frame.index)};
      for (float& z : frame.depth_m) {
        if (random.Below(5) == 0) z = value;
      }
    };
  };
  const auto stream = CleanStream(15);
  const Ran zeros = RunOn(Changed(stream, 0, 15, sprinkle(0.0f)), Variant::kFull);
  for (const float value : {std::numeric_limits<float>::quiet_NaN(),
                            std::numeric_limits<float>::infinity(), -2.0f}) {
    const Ran ran = RunOn(Changed(stream, 0, 15, sprinkle(value)), Variant::kFull);
    EXPECT_EQ(ran.trajectory, zeros.trajectory);
    EXPECT_EQ(ran.map, zeros.map);
  }
}

TEST(FaultStreamF10, DepthOfOtherFramesGivesNoNumberThatIsNotFinite) {
  auto stream = Clean();
  for (std::size_t i = 0; i + 10 < stream.size(); ++i) {
    stream[i].depth_m = Clean()[i + 10].depth_m;
  }
  RunOn(stream);  // finite: RunOn looks
}

TEST(FaultStreamF11, AClockThatJumpsAnHourDoesNotThrowTheCamera) {
  auto stream = Clean();
  for (std::size_t i = 30; i < stream.size(); ++i) stream[i].timestamp_s += 3600;
  Ran ran = RunOn(stream);
  EXPECT_EQ(ran.outcome.tracked, kFrames);
  for (auto& [s, T_wc] : ran.poses_wc) s -= s > 3000 ? 3600 : 0;
  ExpectNoWrongPose(ran);
}

TEST(FaultStreamF12, AKidnappedCameraIsLostAndFoundWhenItComesBack) {
  auto stream = Clean();
  const auto elsewhere = CleanStream(20, 77);
  for (std::size_t i = 0; i < 20; ++i) {
    const double s = stream[25 + i].timestamp_s;
    stream[25 + i] = elsewhere[i];
    stream[25 + i].timestamp_s = s;
  }
  const Ran ran = RunOn(stream);
  ExpectNoWrongPose(ran);
  EXPECT_EQ(std::count(ran.states.begin() + 25, ran.states.begin() + 45, "lost"), 20);
  EXPECT_EQ(std::count(ran.states.begin() + 45, ran.states.end(), "lost"), 0);
  // The old map is what it was: nothing was added elsewhere.
  auto shorter = Clean();
  shorter.erase(shorter.begin() + 25, shorter.begin() + 45);
  EXPECT_EQ(ran.outcome.keyframes, RunOn(shorter).outcome.keyframes);
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
    try {
      RunOn(Changed(Clean(), 9, 1, change));
      FAIL() << "it was taken";
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), testing::AllOf(testing::HasSubstr("frame 9"),
                                               testing::HasSubstr("320 x 240")));
    }
  }
}

TEST(FaultStreamF16, BrightnessThatRollsAndNegativesGiveNoWrongPose) {
  const Ran rolled = RunOn(Changed(Clean(), 0, kFrames, [](RecordedFrame& frame) {
    const double gain = std::pow(5.0, std::sin(0.2 * frame.index));
    cv::Mat1b gray;
    frame.gray.convertTo(gray, CV_8U, gain);
    SetColour(frame, gray);
  }));
  ExpectNoWrongPose(rolled, 2 * kPosition_m);
  const Ran negative = RunOn(Changed(Clean(), 30, 30, [](RecordedFrame& frame) {
    cv::Mat1b gray;
    cv::bitwise_not(frame.gray, gray);
    SetColour(frame, gray);
  }));
  ExpectNoWrongPose(negative, 2 * kPosition_m);
}

TEST(RunLive, StopsWhereItIsAskedToAndKeepsWhatItHas) {
  const auto folder = std::filesystem::temp_directory_path() /
                      ("pas_stopped_run_" + std::to_string(::getpid()));
  FaultStream stream(CleanStream(20));
  RunOptions options;
  options.sequence = "stream";
  options.run = folder;
  options.variant = Variant::kPoints;
  options.force = true;
  int done = 0;
  options.progress = [&](int frames, int) { done = frames; };
  options.stop = [&] { return done >= 7; };
  const RunOutcome outcome = RunLive({stream, SmallCamera(320, 240), nullptr}, options);
  EXPECT_TRUE(outcome.stopped);
  EXPECT_EQ(outcome.frames, 7);
  EXPECT_EQ(outcome.tracked, 7);
  const std::string trajectory = TextOf(folder / "trajectory.txt");
  EXPECT_GE(std::count(trajectory.begin(), trajectory.end(), '\n'), 7);
  EXPECT_TRUE(std::filesystem::exists(folder / "map.json"));
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace slam
