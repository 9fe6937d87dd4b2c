#include "slam/run/run_writer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <opencv2/core.hpp>
#include <sstream>

#include "io/input_error.h"
#include "io/read_file.h"
#include "slam/run/text_number.h"
#include "tests/support/image_files.h"
#include "tests/support/map_surfaces.h"
#include "tests/support/temporary_folder.h"

namespace slam {
namespace {

namespace fs = std::filesystem;
using io::ReadFile;
using nlohmann::json;
using ::testing::ContainsRegex;
using ::testing::ElementsAre;
using ::testing::ThrowsMessage;

std::vector<std::string> Lines(const fs::path& file) {
  std::istringstream stream(ReadFile(file));
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

/// A frame with two planes: one matched, one of which nothing was decided.
Frame SomeFrame(int index) {
  Frame frame;
  frame.index = index;
  frame.timestamp_s = 1305031102.175304 + 0.1 * index;
  frame.gray = cv::Mat1b::zeros(4, 6);
  frame.plane_labels = cv::Mat1b::zeros(4, 6);
  frame.plane_labels(1, 2) = 2;
  frame.T_cw = Exp((Vector6d() << 0.1, -0.2, 0.3, 0.4, 0.5, -0.6).finished());
  FramePlane book;
  book.pi_c = {Eigen::Vector3d(0, 0, -1), 1.0 / 3.0};
  book.centroid_c = {0.1, 0.2, 1.0 / 3.0};
  book.pixel_count = 5210;
  book.inlier_ratio = 0.97;
  book.class_name = "book";
  book.detection = 3;
  book.lines_c = {{{1, 2, 3}, {1, 0, 0}}};
  book.vertices_c = {{{4, 5, 6}, false}, {{7, 8, 9}, true}};
  FramePlane far;
  far.index = 1;
  far.pi_c = {Eigen::Vector3d(0, 0, -1), 8.0};
  far.bad = BadReason::kFar;
  frame.planes = {book, far};
  frame.plane_matches = {{PlaneDecision::kMatched, 17, MatchReason::kRankTest}, {}};
  return frame;
}

Map SomeMap() {
  Map map;
  for (int k = 0; k < 2; ++k) {
    MapPlane plane;
    plane.pi_w = {Eigen::Vector3d(0, 0, 1), -0.75};
    plane.points_w = {{0.1, 0.2, 0.75}, {0.3, 0.4, 0.75}};
    plane.vertices_w = {{1, 2, 3}};
    plane.area_m2 = 0.5;
    plane.observations = 7;
    plane.first_seen_s = 1.5, plane.last_seen_s = 2.5;
    AddLandmark(map, plane);
  }
  map.planes.At(0).class_name = "book";
  map.planes.At(1).status = LandmarkStatus::kMerged;
  map.planes.At(1).merged_into = 0;
  Keyframe kept, culled;
  kept.timestamp_s = 1.5, culled.timestamp_s = 2.0, culled.culled = true;
  map.keyframes = {kept, culled};
  return map;
}

class RunFolder : public ::testing::Test {
 protected:
  RunInfo Info() {
    return {base_ / "seq",        5, "full",        "integrated",         "replay",
            Camera{.fx = 517.25}, 7, "0.1.0 (abc)", {{"a", {{"b", 0.1}}}}};
  }
  void WriteRun(const fs::path& folder, RunWriter::Options options) {
    RunWriter writer(folder, Info(), options);
    std::vector<TimedPose> trajectory;
    for (int i = 0; i < 3; ++i) {
      const Frame frame = SomeFrame(i);
      ModuleTimes times;
      times[Module::kOrb] = 12.5;
      times[Module::kMt] = 99;
      PairRefusals refused;
      for (int k = 0; k <= i; ++k) refused.Add(PairRefusal::kOverlap);
      if (i == 1) refused.Add(PairRefusal::kRankTest);
      writer.WriteFrame({frame, i != 1, times, "", refused});
      if (i != 1) trajectory.push_back({frame.timestamp_s, frame.T_cw});
    }
    writer.Finish(SomeMap(), {}, trajectory);
  }
  std::vector<std::string> Beside() {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(base_))
      names.push_back(entry.path().filename().string());
    std::sort(names.begin(), names.end());
    return names;
  }
  test_support::TemporaryFolder temporary_;
  const fs::path base_ = temporary_.path(), run_ = base_ / "run";
};

TEST_F(RunFolder, NamesTheSequenceRelativeToARunThatIsGivenRelativeToTheCaller) {
  WriteRun(fs::proximate(run_) / "", {});
  EXPECT_EQ(json::parse(ReadFile(run_ / "run.json"))["sequence"], "../seq");
}

TEST_F(RunFolder, SaysInRunJsonWhatWasRun) {
  WriteRun(run_, {});
  const json run = json::parse(ReadFile(run_ / "run.json"));
  EXPECT_EQ(run["format"], "pas-run/1");
  EXPECT_EQ(run["sequence"], "../seq");  // they may be moved together ...
  EXPECT_EQ(run["sequence_absolute"], (base_ / "seq").string());  // ... or the run alone
  EXPECT_EQ(run["camera"]["fx"], 517.25);
  EXPECT_EQ(run["variant"], "full");
  EXPECT_EQ(run["association"], "integrated");
  EXPECT_EQ(run["detector"], "replay");
  EXPECT_EQ(run["seed"], 7);
  EXPECT_EQ(run["version"], "0.1.0 (abc)");
  EXPECT_EQ(run["options"]["a"]["b"], 0.1);
  EXPECT_EQ(run["sequence_frames"], 5);
  EXPECT_EQ(run["interrupted"], false);
  EXPECT_EQ(run["warnings"], json::array());
  EXPECT_EQ(run["frames"], 3);
  EXPECT_EQ(run["tracked"], 2);
  EXPECT_EQ(run["lost"], 1);
  EXPECT_EQ(run["refused_pairs"]["overlap"], 1 + 2 + 3);  // summed over all frames, lost or not
  EXPECT_EQ(run["refused_pairs"]["rank_test"], 1);
  EXPECT_EQ(run["refused_pairs"]["normal_angle"], 0);
  EXPECT_GT(run["wall_time_s"].get<double>(), 0);
  EXPECT_GT(run["peak_memory_mb"].get<double>(), 1);
}

TEST_F(RunFolder, SaysInRunJsonEachNumberOfTheCamera) {
  RunInfo info = Info();
  info.camera = TumCamera("tum1");
  RunWriter(run_, info, {}).Finish(SomeMap(), {}, {});
  // As the benchmark has published them.
  EXPECT_EQ(json::parse(ReadFile(run_ / "run.json"))["camera"],
            json::parse(R"({"width": 640, "height": 480, "fx": 517.306408, "fy": 516.469215,
                "cx": 318.643040, "cy": 255.313989, "k1": 0.262383, "k2": -0.953104,
                "p1": -0.005358, "p2": 0.002628, "k3": 1.163314, "fps": 30.0,
                "depth_factor": 5000.0})"));
}

TEST_F(RunFolder, SaysWhenTheRunWasInterruptedAndWhatItWarnedOf) {
  RunWriter writer(run_, Info(), {});
  writer.WriteFrame({SomeFrame(0), true, {}, "", {}});
  writer.Finish(SomeMap(), {true, {"one", "two"}}, {{SomeFrame(0).timestamp_s, Pose{}}});
  const json run = json::parse(ReadFile(run_ / "run.json"));
  EXPECT_EQ(run["interrupted"], true);
  EXPECT_EQ(run["frames"], 1);
  EXPECT_EQ(run["sequence_frames"], 5);
  EXPECT_EQ(run["warnings"], json({"one", "two"}));
}

TEST_F(RunFolder, NamesASequenceInsideItSoThatItMayBeMoved) {
  RunInfo info = Info();
  info.sequence = run_ / "truth";
  RunWriter writer(run_, info, {});
  writer.Finish(SomeMap(), {}, {});
  EXPECT_EQ(json::parse(ReadFile(run_ / "run.json"))["sequence"], "truth");
}

TEST_F(RunFolder, WritesEveryPlaneOfEveryFrameAsItWasDecided) {
  WriteRun(run_, {});
  const auto lines = Lines(run_ / "frame_planes.jsonl");
  ASSERT_EQ(lines.size(), 3u);
  const json frame = json::parse(lines[0]);
  EXPECT_EQ(frame["timestamp"].get<double>(), 1305031102.175304);
  EXPECT_EQ(frame["planes"][0],
            json::parse(R"({"index": 0, "normal": [0.0, 0.0, -1.0], "d": 0.3333333333333333,
      "centroid": [0.1, 0.2, 0.3333333333333333], "pixels": 5210, "inlier_ratio": 0.97,
      "class": "book", "detection": 3, "bad": null, "lines": [[[1.0, 2.0, 3.0], [1.0, 0.0, 0.0]]],
      "vertices": [[4.0, 5.0, 6.0], [7.0, 8.0, 9.0]], "map_plane": 17, "decision": "matched",
      "by": "ranksum"})"));
  const json& far = frame["planes"][1];
  EXPECT_EQ(far["bad"], "far");
  EXPECT_EQ(far["decision"], "none");
  EXPECT_TRUE(far["class"].is_null() && far["detection"].is_null() &&
              far["map_plane"].is_null() && far["by"].is_null());
}

TEST_F(RunFolder, WritesTrackedPosesFromCameraToWorldToTheLastBit) {
  WriteRun(run_, {});
  std::vector<std::string> lines = Lines(run_ / "trajectory.txt");
  ASSERT_EQ(lines.size(), 3u);  // a comment and two tracked frames of three
  EXPECT_EQ(lines[0][0], '#');
  EXPECT_EQ(lines[1].substr(0, lines[1].find(' ')), "1305031102.175304");
  std::istringstream words(lines[1]);
  double t, x, y, z, qx, qy, qz, qw;
  ASSERT_TRUE(words >> t >> x >> y >> z >> qx >> qy >> qz >> qw);
  const Pose T_wc = Inverse(SomeFrame(0).T_cw);
  EXPECT_EQ(Eigen::Vector3d(x, y, z), T_wc.t);
  constexpr double kRoundOff =
      1e-14;  // matrix to quaternion and back: a few dozen flops near 1
  EXPECT_LT((Eigen::Quaterniond(qw, qx, qy, qz).toRotationMatrix() - T_wc.R).norm(), kRoundOff);
  lines = Lines(run_ / "keyframes.txt");
  ASSERT_EQ(lines.size(), 2u);  // the culled one is absent
  EXPECT_EQ(lines[1], "1.500000 0 0 0 0 0 0 1");
}

TEST_F(RunFolder, WantsAPoseForEachTrackedFrame) {
  RunWriter writer(run_, Info(), {});
  writer.WriteFrame({SomeFrame(0), true, {}, "", {}});
  EXPECT_THROW(writer.Finish(SomeMap(), {}, {}), std::invalid_argument);
  const TimedPose pose{SomeFrame(0).timestamp_s, Pose{}};
  EXPECT_THROW(writer.Finish(SomeMap(), {}, {pose, pose}), std::invalid_argument);
}

TEST_F(RunFolder, HoldsTheMapWithItsMergedPlanesAndItsPoints) {
  WriteRun(run_, {});
  const json map = json::parse(ReadFile(run_ / "map.json"));
  ASSERT_EQ(map["planes"].size(), 2u);
  EXPECT_EQ(map["planes"][0],
            json::parse(R"({"id": 0, "class": "book", "normal": [0.0, 0.0, 1.0], "d": -0.75,
      "area": 0.5, "observations": 7, "first_seen": 1.5, "last_seen": 2.5, "merged_into": null,
      "vertices": [[1.0, 2.0, 3.0]], "hull": []})"));
  EXPECT_EQ(map["planes"][1]["merged_into"], 0);
  EXPECT_TRUE(map["planes"][1]["class"].is_null());
  const auto ply = Lines(run_ / "map.ply");
  EXPECT_EQ(ply[0], "ply");
  EXPECT_THAT(ply, ::testing::Contains("element vertex 2"));  // merged planes stand no more
  EXPECT_THAT(ply, ::testing::Contains("property int plane_id"));
  EXPECT_THAT(ply.back(), ContainsRegex("^0.3 0.4 0.75 [0-9]+ [0-9]+ [0-9]+ 0$"));
}

TEST_F(RunFolder, TimesEveryModule) {
  WriteRun(run_, {});
  const auto lines = Lines(run_ / "timing.csv");
  ASSERT_EQ(lines.size(), 4u);
  EXPECT_EQ(lines[0], "timestamp,orb,od,mdc,epi,pp,da,po,upm,mt");
  EXPECT_EQ(lines[1], "1305031102.175304,12.5,0,0,0,0,0,0,0,99");
}

TEST_F(RunFolder, SavesTheSegmentationWhenAsked) {
  WriteRun(run_, {});
  EXPECT_FALSE(fs::exists(run_ / "segmentation"));
  WriteRun(base_ / "other", {.save_segmentation = true});
  const cv::Mat labels =
      test_support::ReadImageFile(base_ / "other/segmentation/1305031102.175304.png");
  ASSERT_EQ(labels.type(), CV_8UC1);
  EXPECT_EQ(cv::norm(labels, SomeFrame(0).plane_labels, cv::NORM_INF), 0);
}

TEST_F(RunFolder, HasTheSameBytesEachTimeApartFromTimeAndMemory) {
  WriteRun(run_, {});
  WriteRun(base_ / "again", {});
  for (const char* name :
       {"trajectory.txt", "keyframes.txt", "frame_planes.jsonl", "map.json", "map.ply"})
    EXPECT_EQ(ReadFile(run_ / name), ReadFile(base_ / "again" / name)) << name;
  const auto without_costs = [](const fs::path& file) {
    json run = json::parse(ReadFile(file));
    run.erase("wall_time_s");
    run.erase("peak_memory_mb");
    return run.dump();
  };
  EXPECT_EQ(without_costs(run_ / "run.json"), without_costs(base_ / "again/run.json"));
}

TEST_F(RunFolder, SaysWhatEachTrackedPoseIsWorth) {
  RunWriter writer(run_, Info(), {});
  writer.WriteFrame({SomeFrame(0), true, {}, "", {}});  // starts the map: it is the world
  writer.WriteFrame({SomeFrame(1), false, {}, "", {}});
  Frame frame = SomeFrame(2);
  frame.pose_covariance.emplace();
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j)
      (*frame.pose_covariance)(i, j) = 10 * std::min(i, j) + std::max(i, j);
  }
  writer.WriteFrame({frame, true, {}, "", {}});
  writer.Finish(SomeMap(), {},
                {{SomeFrame(0).timestamp_s, Pose{}}, {frame.timestamp_s, frame.T_cw}});
  std::vector<std::string> lines = Lines(run_ / "trajectory_covariance.txt");
  while (!lines.empty() && lines.front()[0] == '#') lines.erase(lines.begin());
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(lines[0],
            StampText(SomeFrame(0).timestamp_s) + " 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0");
  EXPECT_EQ(lines[1], StampText(frame.timestamp_s) +
                          " 0 1 2 3 4 5 11 12 13 14 15 22 23 24 25 33 34 35 44 45 55");
}

TEST_F(RunFolder, IsNeverOverwrittenWithoutForce) {
  WriteRun(run_, {});
  const std::string before = ReadFile(run_ / "run.json");
  EXPECT_THAT([&] { RunWriter(run_, Info(), {}); },
              ThrowsMessage<io::InputError>(ContainsRegex("run: exists already; .*--force")));
  EXPECT_THAT([&] { RunWriter(run_.string() + "/", Info(), {}); },
              ThrowsMessage<io::InputError>(ContainsRegex("exists already")));
  EXPECT_EQ(ReadFile(run_ / "run.json"), before);
}

TEST_F(RunFolder, IsReplacedWithForceOnlyWhenTheNewOneIsWhole) {
  WriteRun(run_, {});
  std::ofstream(run_ / "metrics.json") << "{}";
  {
    RunWriter writer(run_, Info(), {.force = true});
    writer.WriteFrame({SomeFrame(0), true, {}, "", {}});
    EXPECT_TRUE(fs::exists(run_ / "metrics.json"));
  }  // given up
  EXPECT_TRUE(fs::exists(run_ / "metrics.json"));
  EXPECT_EQ(Lines(run_ / "frame_planes.jsonl").size(), 3u);
  WriteRun(run_, {.force = true});
  EXPECT_FALSE(fs::exists(run_ / "metrics.json"));  // it told of the old run
  EXPECT_THAT(Beside(), ElementsAre("run"));
}

TEST_F(RunFolder, LooksCompleteAtNoMomentWhenTheProcessIsKilled) {
  int whole = 0;
  for (int delay_us = 0; delay_us < 30000; delay_us += 1500) {
    const pid_t child = ::fork();
    if (child == 0) {
      WriteRun(run_, {.force = true});
      ::_exit(0);
    }
    ::usleep(static_cast<useconds_t>(delay_us));
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    if (!fs::exists(run_)) continue;
    ++whole;
    EXPECT_EQ(Lines(run_ / "frame_planes.jsonl").size(), 3u);
    EXPECT_EQ(json::parse(ReadFile(run_ / "run.json"))["frames"], 3);
    EXPECT_EQ(json::parse(ReadFile(run_ / "map.json"))["planes"].size(), 2u);
  }
  WriteRun(run_, {.force = true});
  EXPECT_THAT(Beside(), ElementsAre("run")) << "what killed runs left is cleaned up";
}

TEST_F(RunFolder, RefusesWhatMustNotBeWritten) {
  RunWriter writer(run_, Info(), {});
  Frame frame = SomeFrame(0);
  writer.WriteFrame({frame, true, {}, "", {}});
  EXPECT_THROW(writer.WriteFrame({frame, true, {}, "", {}}),
               std::invalid_argument);  // same time
  frame = SomeFrame(1);
  frame.planes[0].pi_c.d = std::nan("");
  EXPECT_THROW(writer.WriteFrame({frame, true, {}, "", {}}), std::invalid_argument);
  frame = SomeFrame(1);
  frame.T_cw.t.x() = std::nan("");
  EXPECT_THROW(writer.WriteFrame({frame, true, {}, "", {}}), std::invalid_argument);
  frame = SomeFrame(1);
  frame.plane_matches.pop_back();
  EXPECT_THROW(writer.WriteFrame({frame, true, {}, "", {}}), std::invalid_argument);
}

}  // namespace
}  // namespace slam
