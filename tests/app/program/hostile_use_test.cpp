// The program among things that are in its way: files that exist, devices, pipes, full disks,
// another process in the same folder. It refuses with one line, and loses nothing.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <chrono>
#include <thread>

#include "tests/support/program.h"

namespace {

using namespace program;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class HostileUse : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    shared_ = new TemporaryFolder;
    const auto run = [](std::vector<std::string> arguments) {
      arguments.insert(arguments.begin(), {Pas(), "-q"});
      const Outcome outcome = Process(arguments, {}, *shared_ / "errors").Wait();
      ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
    };
    run({"scene", "make", "-o", *shared_ / "scene.yaml"});
    run({"sim", "--sensor", "kinect1-clean", *shared_ / "scene.yaml", "-o", *shared_ / "seq",
         "--frames", "5", "--width", "160", "--height", "120"});
    run({"slam", *shared_ / "seq", "-o", *shared_ / "run"});
  }
  static void TearDownTestSuite() { delete shared_; }

  static fs::path seq() { return *shared_ / "seq"; }
  static fs::path scene() { return *shared_ / "scene.yaml"; }
  static fs::path run() { return *shared_ / "run"; }

  Outcome Do(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), {Pas(), "-q"});
    return Process(arguments, {}, folder_ / "errors").Wait();
  }
  /// A line of the shell, `pas` being the program.
  Outcome Shell(const std::string& line) const {
    return Process({"/bin/sh", "-c", "pas() { '" + Pas().string() + "' \"$@\"; }; " + line}, {},
                   folder_ / "errors")
        .Wait();
  }
  void ExpectRefusal(const std::vector<std::string>& arguments, const std::string& why) const {
    const Outcome outcome = Do(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << outcome.errors;
    EXPECT_THAT(outcome.errors, AllOf(HasSubstr("pas: "), HasSubstr(why)));
  }

  static TemporaryFolder* shared_;
  TemporaryFolder folder_;
};
TemporaryFolder* HostileUse::shared_ = nullptr;

TEST_F(HostileUse, NoCommandReplacesAFileWithoutForce) {
  std::ofstream(folder_ / "thesis") << "years of work";
  const fs::path thesis = folder_ / "thesis";
  const std::string why = "thesis: exists already; choose another name or add --force";
  ExpectRefusal({"eval", run(), "-o", thesis}, why);
  ExpectRefusal({"scene", "make", "-o", thesis}, why);
  ExpectRefusal({"scene", "show", scene(), "--svg", thesis}, why);
  ExpectRefusal({"sim", scene(), "--preview", thesis}, why);
  ExpectRefusal({"vocabulary", seq(), "-o", thesis}, why);
  EXPECT_EQ(ReadText(thesis), "years of work");
  fs::create_directory(folder_ / "out");
  std::ofstream(folder_ / "out/detectors.txt") << "old";
  ExpectRefusal({"sim", "--detector-report", "-o", folder_ / "out"}, "exists already");
  std::ofstream(folder_ / "out/sensor_ideal.png") << "old";
  ExpectRefusal({"sim", "--sensor-report", "ideal", "-o", folder_ / "out"}, "exists already");
}

TEST_F(HostileUse, ABagThatIsNotThereIsCalledABag) {
  ExpectRefusal({"import", folder_ / "none.bag", "-o", folder_ / "out"},
                "none.bag: no such file; expected a bag of ROS 1, RECORDING.bag");
}

TEST_F(HostileUse, NoCommandReplacesItsInputsEvenWithForce) {
  const auto before = Contents(seq());
  ExpectRefusal({"eval", run(), "--force", "-o", seq() / "camera.yaml"}, "camera.yaml: is in");
  ExpectRefusal({"eval", run(), "--force", "-o", run() / "map.json"}, "map.json: is in");
  ExpectRefusal({"scene", "show", scene(), "--force", "--svg", scene()}, "is read by this");
  ExpectRefusal({"sim", scene(), "--force", "--preview", scene()}, "is read by this");
  ExpectRefusal({"vocabulary", seq(), "--force", "-o", seq() / "rgb.txt"}, "rgb.txt: is in");
  EXPECT_EQ(Contents(seq()), before);
}

TEST_F(HostileUse, SimReplacesNoSequenceThatHoldsItsScene) {
  fs::copy(seq(), folder_ / "own", fs::copy_options::recursive);
  fs::copy(scene(), folder_ / "own/scene.yaml");
  ExpectRefusal({"sim", folder_ / "own/scene.yaml", "--force", "-o", folder_ / "own"},
                "scene.yaml is in it, which is read by this command");
  EXPECT_TRUE(fs::exists(folder_ / "own/scene.yaml"));
}

TEST_F(HostileUse, SlamReplacesNoRunThatHoldsItsSequence) {
  fs::copy(run(), folder_ / "run", fs::copy_options::recursive);
  fs::copy(seq(), folder_ / "run/seq", fs::copy_options::recursive);
  ExpectRefusal({"slam", folder_ / "run/seq", "--force", "-o", folder_ / "run"},
                "run/seq is in it, which is read by this command");
  EXPECT_TRUE(fs::exists(folder_ / "run/seq/rgb.txt"));
}

TEST_F(HostileUse, SlamReplacesNoRunThatHoldsAFileOfItsScenesRecordingOrSettings) {
  const fs::path own = folder_ / "run";
  fs::copy(run(), own, fs::copy_options::recursive);
  fs::copy(seq() / "groundtruth.txt", own / "path.txt");
  std::ofstream(own / "sensor.yaml") << "base: d435\n";
  std::ofstream(own / "warp.yaml") << "of an earlier run\n";
  std::ofstream(folder_ / "config.yaml")
      << "depth_warp: {source: " << (own / "warp.yaml").string() << "}\n";
  const std::vector<std::string> live{"slam", "--live",  scene(), "--force",  "-o",
                                      own,    "--width", "160",   "--height", "120"};
  const auto refused = [&](const std::string& option, const fs::path& file,
                           const std::string& holds) {
    std::vector<std::string> arguments = live;
    arguments.insert(arguments.end(), {option, file});
    ExpectRefusal(arguments, holds + " is in it, which is read by this command");
  };
  refused("--trajectory", own / "path.txt", "path.txt");
  refused("--sim-sensor", own / "sensor.yaml", "sensor.yaml");
  refused("--config", folder_ / "config.yaml", "warp.yaml");
  EXPECT_TRUE(fs::exists(own / "warp.yaml"));
}

TEST_F(HostileUse, ARunMayBeCalledAsAWordOfAnOption) {
  const std::string slam = "cd " + folder_.path().string() +
                           " && mkdir -p tum1 && pas -q slam " + seq().string() +
                           " -o tum1 --force --depth-warp off --camera ";
  EXPECT_EQ(Shell(slam + (seq() / "camera.yaml").string()).exit_code, 0);
  const Outcome outcome = Shell(slam + "tum1");
  EXPECT_THAT(outcome.errors, HasSubstr("the camera says 640 x 480"));
}

TEST_F(HostileUse, EvalReplacesItsOwnMetricsAlone) {
  EXPECT_EQ(Do({"eval", run()}).exit_code, 0);
  EXPECT_EQ(Do({"eval", run()}).exit_code, 0);
  ExpectRefusal({"eval", run(), "-o", run() / "metrics.json"}, "exists already");
  EXPECT_EQ(Do({"eval", run(), "--force", "-o", run() / "metrics.json"}).exit_code, 0);
}

TEST_F(HostileUse, DevicesAreWrittenToAndStay) {
  EXPECT_EQ(Do({"eval", run(), "-o", "/dev/null"}).exit_code, 0);
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  ExpectRefusal({"eval", run(), "-o", "/dev/full"}, "No space left on device");
  EXPECT_TRUE(fs::is_character_file("/dev/full"));
  const std::string out = (folder_ / "out.json").string();
  EXPECT_EQ(Shell("pas -q eval " + run().string() + " -o /dev/stdout > " + out).exit_code, 0);
  EXPECT_EQ(ReadText(out), [&] {
    Do({"eval", run()});
    return ReadText(run() / "metrics.json");
  }());
}

TEST_F(HostileUse, PipesAndEndlessDevicesAreRefusedAtOnceAsInputs) {
  ASSERT_EQ(mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  fs::create_symlink("/dev/zero", folder_ / "zero.yaml");
  ExpectRefusal({"sim", folder_ / "pipe", "-o", folder_ / "x"}, "is a pipe, expected a file");
  ExpectRefusal({"sim", folder_ / "zero.yaml", "-o", folder_ / "x"}, "is a device");
  ExpectRefusal({"slam", folder_ / "pipe", "-o", folder_ / "x"},
                "is a pipe, expected a folder");
  ExpectRefusal({"slam", seq(), "-o", folder_ / "x", "--config", folder_ / "zero.yaml"},
                "is a device");
  ExpectRefusal({"slam", seq(), "-o", folder_ / "x", "--camera", folder_ / "pipe"},
                "is a pipe");
}

TEST_F(HostileUse, TwoCannotSimulateIntoOneFolder) {
  const std::vector<std::string> command{Pas(), "-q",          "sim",      scene(),
                                         "-o",  folder_ / "s", "--frames", "5000"};
  const Process first(command, {}, folder_ / "first");
  for (int i = 0; i < 2000 && !fs::exists(folder_ / "s/manifest.json"); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  const std::string why = "is being written by another process";
  ExpectRefusal({"sim", scene(), "-o", folder_ / "s", "--frames", "2", "--force"}, why);
  ExpectRefusal({"sim", scene(), "-o", folder_ / "s", "--frames", "5000", "--resume"}, why);
  first.Kill();
  first.Wait();
  EXPECT_EQ(Do({"sim", scene(), "-o", folder_ / "s", "--frames", "2", "--force"}).exit_code, 0);
}

TEST_F(HostileUse, TwoCannotTrackIntoOneRun) {
  const std::vector<std::string> command{Pas(), "-q",          "slam",     "--live", scene(),
                                         "-o",  folder_ / "r", "--frames", "5000"};
  const Process first(command, {}, folder_ / "first");
  // The folder that it writes into until it is done.
  const auto begun = [this] {
    for (const auto& entry : fs::directory_iterator(folder_ / "")) {
      if (fs::exists(entry.path() / "timing.csv.part")) return true;
    }
    return false;
  };
  for (int i = 0; i < 2000 && !begun(); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  const std::string why = "r: is being written by another process";
  ExpectRefusal({"slam", seq(), "-o", folder_ / "r"}, why);
  ExpectRefusal({"plot", run(), "-o", folder_ / "r"}, why);
  ExpectRefusal({"export", seq(), "--format", "coco", "-o", folder_ / "r"}, why);
  EXPECT_TRUE(begun()) << "nothing of the first is lost";
  first.Kill();
  first.Wait();
  EXPECT_EQ(Do({"slam", seq(), "-o", folder_ / "r"}).exit_code, 0);
  EXPECT_FALSE(begun()) << "what the first left is removed";
}

TEST_F(HostileUse, WhatCannotBePrintedIsAnError) {
  for (const std::string& line :
       {std::string("pas --help"), std::string("pas --version"), std::string("pas scene list"),
        "pas eval " + run().string()}) {
    const Outcome outcome = Shell(line + " > /dev/full");
    EXPECT_EQ(outcome.exit_code, 2) << line;
    EXPECT_THAT(outcome.errors, HasSubstr("pas: standard output: ")) << line;
  }
  EXPECT_EQ(Shell("pas -q eval " + run().string() + " >&-").exit_code, 0);
}

// As where a log is sent to a full disk: the result is elsewhere.
TEST_F(HostileUse, WordsThatCannotBeWrittenLoseNoResult) {
  const std::string run = (folder_ / "run").string(), slam = "pas slam " + seq().string();
  EXPECT_EQ(Shell(slam + " -o " + run + " 2>/dev/full").exit_code, 0);
  EXPECT_EQ(Do({"check", run}).exit_code, 0);
  EXPECT_EQ(Shell(slam + " -o " + run + "2 2>&-").exit_code, 0);
  EXPECT_EQ(Do({"check", run + "2"}).exit_code, 0);
}

TEST_F(HostileUse, AFullDiskLeavesNoTemporaryFolder) {
  fs::create_directory(folder_ / "in");
  const Outcome outcome = Shell("ulimit -f 1; pas draw " + run().string() + " -o '" +
                                (folder_ / "in/new/pictures").string() + "'");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.errors, HasSubstr("File too large"));
  EXPECT_TRUE(fs::is_empty(folder_ / "in"));
}

TEST_F(HostileUse, AnEmptyFolderIsAsGoodAsNone) {
  for (const char* name : {"run", "pictures", "seq", "coco"}) {
    fs::create_directory(folder_ / name);
  }
  EXPECT_EQ(Do({"slam", seq(), "-o", folder_ / "run"}).exit_code, 0);
  EXPECT_EQ(Do({"draw", folder_ / "run", "-o", folder_ / "pictures"}).exit_code, 0);
  EXPECT_EQ(Do({"sim", scene(), "-o", folder_ / "seq", "--frames", "2"}).exit_code, 0);
  EXPECT_EQ(Do({"export", seq(), "--format", "coco", "-o", folder_ / "coco"}).exit_code, 0);
  ExpectRefusal({"slam", seq(), "-o", folder_ / "run"}, "exists already");
}

TEST_F(HostileUse, AFolderOfAnotherKindIsNamed) {
  ExpectRefusal({"eval", seq()}, "is a sequence, expected a run folder");
  ExpectRefusal({"draw", scene(), "-o", folder_ / "x"}, "is a file, expected a run folder");
  ExpectRefusal({"slam", run(), "-o", folder_ / "x"}, "is a run of `pas slam`, expected a seq");
  ExpectRefusal({"export", run(), "--format", "coco", "-o", folder_ / "x"}, "is a run of");
  ExpectRefusal({"vocabulary", run(), "-o", folder_ / "x"}, "is a run of");
  const Outcome check = Do({"check", scene()});
  EXPECT_EQ(check.exit_code, 2);
  EXPECT_THAT(check.errors, HasSubstr("is a file, neither a sequence"));
}

TEST_F(HostileUse, NumbersThatAreNoneAreRefused) {
  ExpectRefusal({"sim", scene(), "-o", folder_ / "x", "--rolling-ms", "nan"},
                "--rolling-ms: expected a finite number, found `nan`");
  ExpectRefusal({"sim", scene(), "-o", folder_ / "x", "--seed", "-1"},
                "--seed: expected a whole number of 0 or more");
  ExpectRefusal({"slam", seq(), "-o", folder_ / "x", "--seed", "-1"}, "--seed: expected");
  ExpectRefusal({"sim", "--sensor-report", "ideal", "--preview", folder_ / "p.png"},
                "--sensor-report excludes --preview");
  ExpectRefusal({"sim", scene(), "--preview", folder_ / "p.png", "-o", folder_ / "x"},
                "--output excludes --preview");
  ExpectRefusal({"slams"}, "did you mean `slam`?");
  ExpectRefusal({"slam",
                 "b\xFC"
                 "cher",
                 "-o", folder_ / "x"},
                "is not valid UTF-8");
  EXPECT_EQ(Do({"help", "slam"}).exit_code, 0);
}

TEST_F(HostileUse, AnImageThatAsksForGigabytesIsRefusedByItsHeader) {
  fs::copy(seq(), folder_ / "seq", fs::copy_options::recursive);
  for (const char* part : {"rgb", "depth", "gt/plane_id", "gt/object_id"}) {
    const fs::path image = fs::directory_iterator(folder_ / "seq" / part)->path();
    std::fstream file(image, std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(16).write("\0\1\x86\xA0\0\1\x86\xA0", 8);  // 100000 x 100000
  }
  constexpr double kMax_mb = 300;
  for (const std::vector<std::string>& command : std::vector<std::vector<std::string>>{
           {"check", folder_ / "seq"},
           {"slam", folder_ / "seq", "-o", folder_ / "x"},
           {"draw", run(), "--truth", folder_ / "seq", "-o", folder_ / "x"},
           {"eval", run(), "--truth", folder_ / "seq", "-o", folder_ / "x"},
           {"export", folder_ / "seq", "--format", "coco", "-o", folder_ / "x"},
           {"export", folder_ / "seq", "--format", "bop", "-o", folder_ / "x"}}) {
    const Outcome outcome = Do(command);
    EXPECT_EQ(outcome.exit_code, 2) << command[0];
    EXPECT_THAT(outcome.errors, Not(HasSubstr("OpenCV"))) << command[0];
    EXPECT_LT(outcome.peak_mb, kMax_mb) << command[0];
    fs::remove_all(folder_ / "x");
  }
}

}  // namespace
