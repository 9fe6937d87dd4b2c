// `pas slam --live`: what it leaves beside the run, and which seed is whose.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "tests/support/program.h"

namespace {

using namespace program;

class LiveRun : public testing::Test {
 protected:
  static fs::path Scene() { return fs::path(PAS_SOURCE_DIR) / "scenes/ambiguous/desk.yaml"; }

  Outcome Pass(std::vector<std::string> arguments, int frames = 0) const {
    arguments.insert(arguments.begin(), {Pas().string(), "-q"});
    if (frames > 0) {
      arguments.insert(arguments.end(), {"--frames", std::to_string(frames), "--width", "320",
                                         "--height", "240"});
    }
    const Outcome outcome = Process(arguments, {}, folder_ / "errors").Wait();
    EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
    return outcome;
  }
  Outcome Live(const std::string& run, int frames,
               const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments{"slam", "--live", Scene(), "-o", folder_ / run};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return Pass(arguments, frames);
  }
  nlohmann::json Metrics(const std::string& run) const {
    Pass({"eval", folder_ / run});
    nlohmann::json metrics = nlohmann::json::parse(ReadText(folder_ / run / "metrics.json"));
    for (const char* key : {"timing_ms", "run", "sequence"}) metrics.erase(key);
    return metrics;
  }

  TemporaryFolder folder_;
};

TEST_F(LiveRun, IsScoredAsTheRunOnTheFilesOfTheSameSeed) {
  constexpr int kFrames = 12;
  Pass({"sim", Scene(), "-o", folder_ / "seq", "--seed", "5"}, kFrames);
  // Frames that are rendered come once.
  std::ofstream(folder_ / "once.yaml") << "first_look: {frames: 0}\n";
  Pass({"slam", folder_ / "seq", "-o", folder_ / "files", "--seed", "5", "--save-segmentation",
        "--config", folder_ / "once.yaml"});
  Live("live", kFrames, {"--seed", "5", "--save-segmentation"});
  EXPECT_EQ(ReadText(folder_ / "live" / "map.json"), ReadText(folder_ / "files" / "map.json"));
  EXPECT_EQ(Metrics("live"), Metrics("files"));
  EXPECT_EQ(nlohmann::json::parse(ReadText(folder_ / "live" / "run.json"))["sequence"],
            "truth");
  Pass({"check", folder_ / "live"});
  Pass({"check", folder_ / "live/truth"});

  // All but the images, byte for byte.
  const auto live = Contents(folder_ / "live/truth");
  for (const auto& [file, bytes] : Contents(folder_ / "seq")) {
    if (file.starts_with("rgb/") || file.starts_with("depth/") || file == "manifest.json") {
      continue;
    }
    ASSERT_EQ(live.count(file), 1u) << file;
    EXPECT_EQ(live.at(file), bytes) << file;
  }
}

TEST_F(LiveRun, CanBeMovedWithItsTruth) {
  Live("run", 4);
  fs::rename(folder_ / "run", folder_ / "moved");
  Pass({"eval", folder_ / "moved"});
}

TEST_F(LiveRun, IsSeededAsTheTwoCommandsAre) {
  Live("plain", 4, {"--no-truth"});
  Live("defaults", 4, {"--no-truth", "--seed", "0", "--sim-seed", "1"});
  Live("both", 4, {"--no-truth", "--seed", "7"});
  Live("apart", 4, {"--no-truth", "--seed", "7", "--sim-seed", "7"});
  Live("other", 4, {"--no-truth", "--seed", "7", "--sim-seed", "1"});
  const auto poses = [&](const char* run) {
    return ReadText(folder_ / run / "trajectory.txt");
  };
  EXPECT_EQ(poses("plain"), poses("defaults"));
  EXPECT_EQ(poses("both"), poses("apart"));
  EXPECT_NE(poses("both"), poses("other"));
  EXPECT_NE(poses("both"), poses("plain"));
}

TEST_F(LiveRun, LeavesTheTruthOutWhenAsked) {
  Live("run", 2, {"--no-truth"});
  EXPECT_FALSE(fs::exists(folder_ / "run/truth"));
  const auto info = nlohmann::json::parse(ReadText(folder_ / "run/run.json"));
  EXPECT_TRUE(fs::equivalent(folder_ / "run" / info["sequence"].get<std::string>(), Scene()));
}

TEST_F(LiveRun, KeepsTheTruthOfTheFramesItRanWhenASignalStopsIt) {
  constexpr int kFrames = 300;
  const fs::path run = folder_ / "run";
  const Process process({Pas().string(), "slam", "--live", Scene(), "-o", run, "--frames",
                         std::to_string(kFrames), "--width", "320", "--height", "240"},
                        {}, folder_ / "errors");
  while (ReadText(folder_ / "errors").find("slam ") == std::string::npos) {
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  process.Send(SIGINT);
  ASSERT_EQ(process.Wait().exit_code, 128 + SIGINT);
  const int frames = nlohmann::json::parse(ReadText(run / "run.json"))["frames"];
  EXPECT_LT(frames, kFrames);
  for (const char* list : {"truth/associations.txt", "truth/gt/frames.jsonl"}) {
    const std::string text = ReadText(run / list);
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), frames) << list;
  }
  Pass({"check", run / "truth"});
  Pass({"eval", run});
}

TEST_F(LiveRun, NeedsNoMoreMemoryForTheTruthOfMoreFrames) {
  // The estimator itself grows with its map: what is compared is with and without truth. A sensor that
  // bends nothing: the image of a bend is packed once, at the end, in 2 MB, however long the run.
  // The peak of one and the same run differs by 10 MB from time to time (threads, arenas of malloc),
  // so the run is long enough for kept images to show: half of the smallest kind, labels, is allowed.
  constexpr int kFrames = 300;
  constexpr double kLabels_mb = 320 * 240 * sizeof(std::uint16_t) / 1e6;
  const std::vector<std::string> clean{"--sim-sensor", "kinect1-clean"};
  const double with_truth = Live("truth", kFrames, clean).peak_mb;
  const double without = Live("none", kFrames, {clean[0], clean[1], "--no-truth"}).peak_mb;
  EXPECT_LT(with_truth - without, 0.5 * kFrames * kLabels_mb);
}

}  // namespace
