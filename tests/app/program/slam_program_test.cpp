// `pas slam` as a user meets it: stopped by signals, on doubtful input, with printed settings.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <set>
#include <thread>

#include "tests/support/image_files.h"
#include "tests/support/program.h"

namespace {

using namespace program;
using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

constexpr int kFrames = 90;

class SlamProgram : public testing::Test {
 protected:
  fs::path Record(int frames) const {
    const fs::path sequence = folder_ / "seq";
    const fs::path scene = fs::path(PAS_SOURCE_DIR) / "scenes/ambiguous/desk.yaml";
    EXPECT_EQ(Run({Pas(), "-q", "sim", scene, "-o", sequence, "--sensor", "kinect1-clean",
                   "--frames", std::to_string(frames), "--width", "320", "--height", "240"})
                  .exit_code,
              0);
    return sequence;
  }
  std::vector<std::string> Command(const fs::path& sequence, const std::string& run,
                                   const std::vector<std::string>& more = {}) const {
    std::vector<std::string> command{Pas(), "slam", sequence, "-o", folder_ / run};
    command.insert(command.end(), more.begin(), more.end());
    return command;
  }
  Outcome Run(const std::vector<std::string>& command) const {
    return Process(command, {}, folder_ / "errors").Wait();
  }
  /// Sends the signal once the first tenth of the frames is done.
  Outcome Interrupted(const std::vector<std::string>& command, int signal) const {
    const Process process(command, {}, folder_ / "errors");
    while (ReadText(folder_ / "errors").find("slam ") == std::string::npos) {
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    process.Send(signal);
    return process.Wait();
  }
  nlohmann::json RunJson(const std::string& run) const {
    return nlohmann::json::parse(ReadText(folder_ / run / "run.json"));
  }
  /// Frames from `first` on are black and have no depth.
  static void Blacken(const fs::path& sequence, int first) {
    std::istringstream lines(ReadText(sequence / "associations.txt"));
    std::string t, rgb, t_depth, depth;
    for (int i = 0; lines >> t >> rgb >> t_depth >> depth; ++i) {
      if (i < first) continue;
      test_support::WriteImageFile(sequence / rgb, cv::Mat3b(240, 320, cv::Vec3b()));
      test_support::WriteImageFile(sequence / depth, cv::Mat1w(240, 320, ushort{0}));
    }
  }

  TemporaryFolder folder_;
};

TEST_F(SlamProgram, KeepsTheRunThatASignalStops) {
  // Without a first look, in which there is nothing to keep yet.
  const fs::path settings = folder_ / "no_look.yaml";
  std::ofstream(settings) << "first_look: {frames: 0}\n";
  const fs::path sequence = Record(kFrames);
  for (const char* mapping : {"sync", "async"}) {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
      const std::string run = std::string(mapping) + std::to_string(signal);
      const Outcome outcome = Interrupted(
          Command(sequence, run, {"--mapping", mapping, "--config", settings}), signal);
      EXPECT_EQ(outcome.exit_code, 128 + signal) << run << outcome.errors;
      EXPECT_THAT(outcome.errors, ContainsRegex("interrupted after [0-9]+ of 90 frames"));
      const nlohmann::json told = RunJson(run);
      EXPECT_EQ(told["interrupted"], true) << run;
      EXPECT_EQ(told["sequence_frames"], kFrames);
      EXPECT_LT(told["frames"], kFrames);
      EXPECT_GE(told["frames"], kFrames / 10);
      EXPECT_EQ(Run({Pas(), "-q", "check", folder_ / run}).exit_code, 0);
    }
  }
}

TEST_F(SlamProgram, CountsTheFramesOfTheFirstLookByThemselves) {
  const Outcome outcome = Run(Command(Record(12), "run"));
  EXPECT_THAT(outcome.errors, AllOf(HasSubstr("first look 12/12"), HasSubstr("slam 12/12"),
                                    Not(HasSubstr("/24"))));
}

TEST_F(SlamProgram, LeavesASignalAloneThatIsIgnored) {
  std::vector<std::string> command = Command(Record(kFrames), "run");
  command.insert(command.begin(), "/usr/bin/nohup");
  EXPECT_EQ(Interrupted(command, SIGHUP).exit_code, 0);
  EXPECT_EQ(RunJson("run")["frames"], kFrames);
  EXPECT_EQ(RunJson("run")["interrupted"], false);
}

TEST_F(SlamProgram, GivesTheSameBytesWithItsOwnSettingsPrintedAndRead) {
  const fs::path sequence = Record(20);
  ASSERT_EQ(Run(Command(sequence, "plain", {"-q"})).exit_code, 0);
  for (const char* print : {"config", "slam --print-config"}) {
    const std::string file = folder_ / "settings.yaml";
    ASSERT_EQ(Run({"/bin/sh", "-c", Pas().string() + " " + print + " > " + file}).exit_code, 0);
    fs::remove_all(folder_ / "printed");
    ASSERT_EQ(Run(Command(sequence, "printed", {"-q", "--config", file})).exit_code, 0);
    for (const char* name : {"map.json", "trajectory.txt", "frame_planes.jsonl"}) {
      EXPECT_EQ(ReadText(folder_ / "plain" / name), ReadText(folder_ / "printed" / name))
          << print << " " << name;
    }
    EXPECT_EQ(RunJson("plain")["options"], RunJson("printed")["options"]);
  }
}

// A file of all settings that named a sensor would overrule what the recording tells.
TEST_F(SlamProgram, PrintsSettingsThatLeaveTheSensorToTheRecording) {
  const auto config = [&](const std::string& options) {
    const std::string file = folder_ / "config.yaml";
    Run({"/bin/sh", "-c", Pas().string() + " config " + options + " > " + file});
    return ReadText(file);
  };
  const std::string any = config("");
  for (const char* line : {"\n  # model: kinect1", "\n  # noise:", "\n    # floor_m: 0.0012",
                           "\n  max_depth_m: 10", "\nsensor:"}) {
    EXPECT_THAT(any, HasSubstr(line));
  }
  EXPECT_THAT(config("--sensor azure"), HasSubstr("\n  model: azure"));
  EXPECT_THAT(config("--sensor azure"), HasSubstr("\n    floor_m: 0.0022"));
}

TEST_F(SlamProgram, PrintsTheSettingsWithWhatTheOptionsSay) {
  const auto printed = [&](const std::string& options) {
    const fs::path file = folder_ / "settings.yaml";
    EXPECT_EQ(Run({"/bin/sh", "-c", Pas().string() + " " + options + " > " + file.string()})
                  .exit_code,
              0);
    return ReadText(file);
  };
  std::ofstream(folder_ / "same.yaml")
      << "loop_closing: {enabled: true}\ndetection: {every: 5}\nmapping: {async: true}\n"
         "depth_warp: {source: \"off\"}\nstructure: {mode: manhattan}\n"
         "plane_extraction: {segmentation: ahc}\n";
  EXPECT_EQ(printed("slam --print-config --loop-closing --detect-every 5 --mapping async "
                    "--depth-warp off --structure manhattan --segmentation ahc"),
            printed("config --sensor kinect1 --config " + (folder_ / "same.yaml").string()));
}

TEST_F(SlamProgram, FailsWhenTheCameraEndsLostForMoreThanHalf) {
  const fs::path sequence = Record(30);
  Blacken(sequence, 10);
  const Outcome outcome = Run(Command(sequence, "run"));
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(
      outcome.errors,
      AllOf(ContainsRegex("warning: 20 of 30 frames are not tracked; the camera is lost "
                          "since frame 10 .0.333333 s. and was not found again"),
            HasSubstr("lost for more than half of")));
}

TEST_F(SlamProgram, WarnsWhenTheCameraEndsLostForLess) {
  const fs::path sequence = Record(30);
  Blacken(sequence, 20);
  const Outcome outcome = Run(Command(sequence, "run"));
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.errors,
              HasSubstr("warning: 10 of 30 frames are not tracked; the camera"));
}

TEST_F(SlamProgram, TellsOfDoubtfulInputInWarningsAndInTheRun) {
  const fs::path sequence = Record(12);
  std::string camera = ReadText(sequence / "camera.yaml");
  camera.erase(camera.find("fps:"),
               camera.find('\n', camera.find("fps:")) + 1 - camera.find("fps:"));
  std::ofstream(sequence / "camera.yaml") << camera;
  std::string manifest = ReadText(sequence / "manifest.json");
  const std::string complete = "\"complete\": true";
  manifest.replace(manifest.find(complete), complete.size(), "\"complete\": false");
  std::ofstream(sequence / "manifest.json") << manifest;
  const std::string all = ReadText(sequence / "associations.txt");
  std::ofstream(sequence / "associations.txt")
      << all.substr(0, all.rfind('\n', all.size() - 2) + 1);

  const Outcome outcome = Run(Command(sequence, "run", {"-q"}));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  const nlohmann::json warnings = RunJson("run")["warnings"];
  ASSERT_EQ(warnings.size(), 3u) << warnings;
  for (const auto& warning : warnings) {
    EXPECT_THAT(outcome.errors, HasSubstr("pas: warning: " + warning.get<std::string>()));
    EXPECT_THAT(warning.get<std::string>(), Not(HasSubstr(folder_ / "")));
  }
  EXPECT_THAT(warnings[0], HasSubstr("camera.yaml: key `fps` is missing"));
  EXPECT_THAT(warnings[1], HasSubstr("manifest.json does not say complete: true"));
  EXPECT_THAT(warnings[2], HasSubstr("1 of 12 lines of detections.jsonl"));
}

TEST_F(SlamProgram, TakesTheSegmentationOfTheOptionOverThatOfTheFile) {
  const fs::path sequence = Record(3), file = folder_ / "settings.yaml";
  std::ofstream(file) << "plane_extraction: {segmentation: ours}\n";
  const auto taken = [&](const char* name, std::vector<std::string> options) {
    options.insert(options.begin(), {"-q", "--config", file});
    EXPECT_EQ(Run(Command(sequence, name, options)).exit_code, 0) << name;
    return RunJson(name)["options"]["plane_extraction"]["segmentation"];
  };
  EXPECT_EQ(taken("file", {}), "ours");
  EXPECT_EQ(taken("option", {"--segmentation", "ahc"}), "ahc");
}

TEST_F(SlamProgram, TakesTheStructureOfTheOptionElseOfTheFileAndRefusesAnUnknownOne) {
  const fs::path sequence = Record(20);
  const Outcome unknown = Run(Command(sequence, "unknown", {"--structure", "atlanta"}));
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_THAT(unknown.errors, HasSubstr("none, parallel, manhattan, mixture or supposed"));
  const fs::path file = folder_ / "settings.yaml", wrong = folder_ / "wrong.yaml";
  std::ofstream(wrong) << "structure: {mode: atlanta}\n";
  const Outcome in_file = Run(Command(sequence, "unknown", {"--config", wrong}));
  EXPECT_EQ(in_file.exit_code, 2);
  EXPECT_THAT(in_file.errors, HasSubstr("manhattan"));

  std::ofstream(file) << "structure: {mode: none}\n";
  const auto run = [&](const char* name, std::vector<std::string> options) {
    options.insert(options.begin(), "-q");
    EXPECT_EQ(Run(Command(sequence, name, options)).exit_code, 0) << name;
    return ReadText(folder_ / name / "trajectory.txt");
  };
  const std::string parallel = run("plain", {}), none = run("file", {"--config", file});
  EXPECT_EQ(run("option", {"--structure", "none"}), none);
  EXPECT_EQ(run("over", {"--config", file, "--structure", "parallel"}), parallel);
  EXPECT_NE(none, parallel);
  EXPECT_EQ(RunJson("option")["options"]["structure"]["mode"], "none");
}

TEST_F(SlamProgram, TakesTheRuleOfAssociationOfTheOptionElseOfTheFile) {
  const fs::path sequence = Record(20);
  const Outcome unknown = Run(Command(sequence, "unknown", {"--association", "orb"}));
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_THAT(unknown.errors, HasSubstr("planar-slam or sp-slam"));
  const Outcome of_points =
      Run(Command(sequence, "points", {"--variant", "points", "--association", "sp-slam"}));
  EXPECT_EQ(of_points.exit_code, 2);
  EXPECT_THAT(of_points.errors, HasSubstr("--association"));

  const fs::path file = folder_ / "settings.yaml";
  std::ofstream(file) << "association: {rule: parameters}\n";
  const auto run = [&](const char* name, std::vector<std::string> options) {
    options.insert(options.begin(), "-q");
    EXPECT_EQ(Run(Command(sequence, name, options)).exit_code, 0) << name;
    return ReadText(folder_ / name / "frame_planes.jsonl");
  };
  EXPECT_EQ(run("file", {"--config", file}), run("variant", {"--variant", "no-association"}));
  std::set<std::string> decisions;
  for (const char* rule : {"integrated", "manhattan-slam", "planar-slam", "sp-slam"}) {
    decisions.insert(run(rule, {"--config", file, "--association", rule}));
    EXPECT_EQ(RunJson(rule)["association"], rule);
  }
  EXPECT_EQ(decisions.size(), 4U);  // each decides otherwise
}

TEST_F(SlamProgram, AsksTheDetectorAsOftenAsTheOptionElseTheFileSays) {
  const fs::path sequence = Record(20);
  const fs::path file = folder_ / "settings.yaml";
  std::ofstream(file) << "detection: {every: 4}\n";
  ASSERT_EQ(Run(Command(sequence, "file", {"-q", "--config", file})).exit_code, 0);
  ASSERT_EQ(Run(Command(sequence, "option", {"-q", "--detect-every", "4"})).exit_code, 0);
  ASSERT_EQ(
      Run(Command(sequence, "both", {"-q", "--config", file, "--detect-every", "1"})).exit_code,
      0);
  ASSERT_EQ(Run(Command(sequence, "plain", {"-q"})).exit_code, 0);
  for (const char* run : {"file", "option"}) {
    EXPECT_EQ(RunJson(run)["options"]["detection"]["every"], 4) << run;
    EXPECT_EQ(ReadText(folder_ / run / "frame_planes.jsonl"),
              ReadText(folder_ / "file" / "frame_planes.jsonl"));
    EXPECT_NE(ReadText(folder_ / run / "frame_planes.jsonl"),
              ReadText(folder_ / "plain" / "frame_planes.jsonl"));
    // Only every fourth frame has a time of detection.
    std::istringstream lines(ReadText(folder_ / run / "timing.csv"));
    std::string line;
    std::getline(lines, line);
    EXPECT_THAT(line, HasSubstr("timestamp,orb,od,")) << "the column that is read below";
    for (int i = 0; std::getline(lines, line); ++i) {
      const std::size_t od = line.find(',', line.find(',') + 1) + 1;
      EXPECT_EQ(std::stod(line.substr(od)) > 0, i % 4 == 0) << run << " " << line;
    }
  }
  EXPECT_EQ(ReadText(folder_ / "both" / "frame_planes.jsonl"),
            ReadText(folder_ / "plain" / "frame_planes.jsonl"));
}

TEST_F(SlamProgram, RefusesANumberOfFramesThatIsNone) {
  const fs::path sequence = Record(2);
  for (const char* every : {"0", "-1", "x", "1.5", "1001", ""}) {
    const Outcome outcome = Run(Command(sequence, "run", {"-q", "--detect-every", every}));
    EXPECT_EQ(outcome.exit_code, 2) << every;
    EXPECT_THAT(outcome.errors, HasSubstr("--detect-every")) << every;
    EXPECT_FALSE(fs::exists(folder_ / "run"));
  }
}

TEST_F(SlamProgram, ReadsCamerasInSettingsOfOrbSlam) {
  const fs::path sequence = Record(12);
  ASSERT_EQ(Run(Command(sequence, "own", {"-q"})).exit_code, 0);
  std::istringstream own(ReadText(sequence / "camera.yaml"));
  std::ofstream orb(folder_ / "orb.yaml");
  orb << "%YAML:1.0\n\nORBextractor.nFeatures: 1000\n";
  for (std::string key, value; std::getline(own, key, ':') && std::getline(own, value);) {
    if (key == "model") continue;
    orb << (key == "depth_factor" ? "DepthMapFactor" : "Camera." + key) << ":" << value << "\n";
  }
  orb.close();
  fs::remove(sequence / "camera.yaml");
  const Outcome outcome = Run(Command(sequence, "orb", {"--camera", folder_ / "orb.yaml"}));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_EQ(ReadText(folder_ / "own" / "map.json"), ReadText(folder_ / "orb" / "map.json"));
}

}  // namespace
