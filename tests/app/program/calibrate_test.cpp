// `pas calibrate`, and `pas slam --depth-warp`, as a user meets them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/support/program.h"

namespace {

using namespace program;
using testing::AllOf;
using testing::HasSubstr;

/// A desk by a Kinect with the sensor file's text.
fs::path Recorded(const TemporaryFolder& folder, const std::string& name,
                  const std::string& sensor, int frames = 190) {
  const fs::path sequence = folder / name;
  std::ofstream(folder / "sensor.yaml") << sensor;
  const std::vector<std::vector<std::string>> commands{
      {Pas(), "-q", "scene", "make", "--family", "desk", "--seed", "503", "-o",
       folder / "desk.yaml", "--force"},
      {Pas(), "-q", "sim", folder / "desk.yaml", "-o", sequence, "--sensor",
       folder / "sensor.yaml", "--seed", "503", "--frames", std::to_string(frames), "--width",
       "320", "--height", "240", "--detector", "none"}};
  for (const auto& command : commands) {
    EXPECT_EQ(Process(command, {}, folder / "errors").Wait().exit_code, 0);
  }
  return sequence;
}
const TemporaryFolder& Recordings() {
  static const TemporaryFolder folder;
  return folder;
}
const fs::path& Bent() {
  static const fs::path path =
      Recorded(Recordings(), "bent", "base: kinect1\nbend_rms: 0.0033\n");
  return path;
}
const fs::path& Clean() {
  static const fs::path path = Recorded(Recordings(), "clean", "base: kinect1-clean\n");
  return path;
}

class CalibrateProgram : public testing::Test {
 protected:
  Outcome Run(const std::vector<std::string>& arguments) const {
    std::vector<std::string> command{Pas(), "-q"};
    command.insert(command.end(), arguments.begin(), arguments.end());
    return Process(command, {}, folder_ / "errors").Wait();
  }
  nlohmann::json Straightening(const std::string& run) const {
    return nlohmann::json::parse(ReadText(folder_ / run / "run.json")).at("depth_warp");
  }
  /// Everything but times.
  std::map<std::string, std::string> BytesOf(const std::string& run) const {
    auto contents = Contents(folder_ / run);
    contents.erase("timing.csv");
    auto json = nlohmann::json::parse(contents.at("run.json"));
    for (const char* key : {"wall_time_s", "peak_memory_mb", "sequence"}) json.erase(key);
    contents["run.json"] = json.dump();
    return contents;
  }
  TemporaryFolder folder_;
};

TEST_F(CalibrateProgram, WritesAWarpThatSlamAppliesFromTheFirstFrameOn) {
  const fs::path warp = folder_ / "warp.yaml", again = folder_ / "again.yaml";
  const fs::path picture = folder_ / "warp.png";
  ASSERT_EQ(Run({"calibrate", Bent(), "-o", warp, "--picture", picture}).exit_code, 0);
  ASSERT_EQ(Run({"calibrate", Bent(), "-o", again}).exit_code, 0);
  EXPECT_EQ(ReadText(warp), ReadText(again));
  EXPECT_TRUE(fs::exists(picture));
  ASSERT_EQ(Run({"slam", Bent(), "-o", folder_ / "run", "--depth-warp", warp}).exit_code, 0);
  EXPECT_EQ(Straightening("run").at("applied"), true);
  EXPECT_EQ(Straightening("run").at("from_frame"), 0);
  EXPECT_NEAR(Straightening("run").at("rms").get<double>(), 0.0027, 0.0008);
}

TEST_F(CalibrateProgram, SlamLearnsBeforehandAndAppliesFromTheFirstFrameOn) {
  ASSERT_EQ(Run({"slam", Bent(), "-o", folder_ / "run", "--depth-warp", "auto"}).exit_code, 0);
  EXPECT_EQ(Straightening("run").at("from_frame"), 0);
  EXPECT_GT(Straightening("run").at("learnt").at("gain"), 0.3);
  // Points alone teach nothing of planes.
  ASSERT_EQ(Run({"slam", Bent(), "-o", folder_ / "points", "--variant", "points"}).exit_code,
            0);
  EXPECT_EQ(Straightening("points").at("applied"), false);
}

TEST_F(CalibrateProgram, SlamLearnsOnTheWayWithTheSameBytesForAnyNumberOfThreads) {
  std::ofstream(folder_ / "once.yaml") << "first_look: {frames: 0}\n";
  for (const char* threads : {"1", "2"}) {
    ASSERT_EQ(
        Run({"slam", Bent(), "-o", folder_ / threads, "--threads", threads, "--depth-warp",
             "auto", "--save-segmentation", "--config", folder_ / "once.yaml"})
            .exit_code,
        0);
  }
  EXPECT_EQ(BytesOf("1"), BytesOf("2"));
  EXPECT_EQ(Straightening("1").at("applied"), true);
  EXPECT_GT(Straightening("1").at("from_frame"), 90);
  EXPECT_GT(Straightening("1").at("learnt").at("gain"), 0.3);
}

TEST_F(CalibrateProgram, AFlatSensorIsLeftAlone) {
  const Outcome outcome = Run({"calibrate", Clean(), "-o", folder_ / "warp.yaml"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.errors, HasSubstr("no warp is written, because"));
  EXPECT_FALSE(fs::exists(folder_ / "warp.yaml"));
  for (const char* mode : {"auto", "off"}) {
    ASSERT_EQ(Run({"slam", Clean(), "-o", folder_ / mode, "--depth-warp", mode}).exit_code, 0);
    EXPECT_EQ(Straightening(mode).at("applied"), false);
  }
  auto learnt = BytesOf("auto"), off = BytesOf("off");
  learnt.erase("run.json"), off.erase("run.json");
  EXPECT_EQ(learnt, off);
}

TEST_F(CalibrateProgram, SaysThatNothingWasTrackedAndWhy) {
  const fs::path sequence = Recorded(folder_, "unit", "base: kinect1\n", 3);
  std::string camera = ReadText(sequence / "camera.yaml");
  const auto at = camera.find("depth_factor: 5000");
  ASSERT_NE(at, std::string::npos) << camera;
  camera.replace(at, 18, "depth_factor: 500000");
  std::ofstream(sequence / "camera.yaml") << camera;
  const Outcome outcome = Run({"calibrate", sequence, "-o", folder_ / "warp.yaml"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.errors,
              AllOf(HasSubstr("depth_factor"), HasSubstr("no frame was tracked")));
}

TEST_F(CalibrateProgram, RefusesAPictureInTheFileOfTheWarpBeforeTheWork) {
  const fs::path one = folder_ / "one";
  const Outcome outcome =
      Run({"calibrate", folder_ / "none", "-o", one, "--picture", one, "--force"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.errors, HasSubstr("would hold two outputs"));
}

TEST_F(CalibrateProgram, CountsTheFramesOfEachPass) {
  const fs::path sequence = Recorded(folder_, "passes", "base: kinect1\n", 3);
  const Outcome outcome = Process({Pas(), "calibrate", sequence, "-o", folder_ / "warp.yaml"},
                                  {}, folder_ / "errors")
                              .Wait();
  for (const char* pass : {"tracking 3/3", "planes 3/3", "planes again 3/3"}) {
    EXPECT_THAT(outcome.errors, HasSubstr(pass));
  }
}

TEST_F(CalibrateProgram, AFileThatIsNoWarpOfThisCameraIsRefusedByName) {
  std::ofstream(folder_ / "warp.yaml")
      << "format: pas-depth-warp/1\nimage: {width: 640, height: 480}\n"
         "cells: {cols: 1, rows: 1}\npattern_ppm: [[0]]\nsigma_ppm: [[0]]\n";
  const fs::path sequence = Recorded(folder_, "short", "base: kinect1\n", 2);
  const Outcome other =
      Run({"slam", sequence, "-o", folder_ / "run", "--depth-warp", folder_ / "warp.yaml"});
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_THAT(other.errors, AllOf(HasSubstr("warp.yaml:2"), HasSubstr("320 x 240")));
  const Outcome missing =
      Run({"slam", sequence, "-o", folder_ / "run", "--depth-warp", folder_ / "none.yaml"});
  EXPECT_EQ(missing.exit_code, 2);
  EXPECT_THAT(missing.errors, AllOf(HasSubstr("none.yaml"), HasSubstr("pas calibrate")));
  EXPECT_FALSE(fs::exists(folder_ / "run"));
}

}  // namespace
