#include "sim/write/write_sequence.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <optional>
#include <set>

#include "io/atomic_file.h"
#include "io/number_text.h"
#include "io/read_file.h"
#include "io/sha256.h"
#include "sim/sensor/read_sensor.h"
#include "sim/write/sequence_text.h"
#include "tests/sim/support/sim_worlds.h"
#include "tests/support/file_contents.h"
#include "tests/support/image_files.h"
#include "tests/support/refusal.h"
#include "tests/support/temporary_folder.h"

namespace sim {
namespace {

namespace fs = std::filesystem;
using test_support::Contents;
using test_support::RefusalOf;
using testing::HasSubstr;

/// A folder of its own for each test, gone afterwards.
class WrittenSequence : public testing::Test {
 protected:
  void SetUp() override { root_ = temporary_.emplace().path(); }

  static SequenceOptions Options(int threads = 1) {
    SequenceOptions options;
    options.rig.camera = SmallCamera();
    options.rig.sensor = SensorKind::kKinect1Clean;
    options.threads = threads;
    options.version = "test";
    return options;
  }
  static int Write(const fs::path& folder, const SequenceOptions& options, int frames = 6) {
    return WriteSequence(SmallDesk(), SmallArc(frames), options, folder);
  }
  std::optional<test_support::TemporaryFolder> temporary_;
  fs::path root_;
};

TEST_F(WrittenSequence, HoldsEveryFileOfTheFormatAndNothingElse) {
  Write(root_ / "seq", Options(), 3);
  std::set<std::string> expected{"associations.txt", "camera.yaml",     "depth.txt",
                                 "detections.jsonl", "groundtruth.txt", "gt/frames.jsonl",
                                 "gt/scene.json",    "manifest.json",   "rgb.txt"};
  for (const std::string t : {"0.000000", "0.033333", "0.066667"}) {
    for (const std::string where : {"rgb/", "depth/", "gt/plane_id/", "gt/object_id/"}) {
      expected.insert(where + t + ".png");
    }
  }
  std::set<std::string> found;
  for (const auto& [path, bytes] : Contents(root_ / "seq")) found.insert(path);
  EXPECT_EQ(found, expected);
}

TEST_F(WrittenSequence, ListsTheHashOfEveryOtherFileInItsManifest) {
  Write(root_ / "seq", Options(), 3);
  const auto manifest = nlohmann::json::parse(io::ReadFile(root_ / "seq/manifest.json"));
  EXPECT_EQ(manifest["format"], "pas-sequence/1");
  EXPECT_EQ(manifest["complete"], true);
  EXPECT_EQ(manifest["frame_count"], 3);
  auto content = Contents(root_ / "seq");
  content.erase("manifest.json");
  EXPECT_EQ(manifest["sha256"].size(), content.size());
  for (const auto& [path, bytes] : content) {
    EXPECT_EQ(manifest["sha256"][path], io::Sha256Hex(bytes)) << path;
  }
}

TEST_F(WrittenSequence, StoresImagesInTheFormatsDepthAndSize) {
  SequenceOptions options = Options();
  options.rig.sensor = SensorKind::kIdeal;
  WriteSequence(OneBoard(1.2), {{0.0, LookAlongY()}}, options, root_ / "seq");
  const auto read = [&](const std::string& where) {
    return test_support::ReadImageFile(root_ / "seq" / where / "0.000000.png");
  };
  EXPECT_EQ(read("rgb").type(), CV_8UC3);
  EXPECT_EQ(read("gt/plane_id").type(), CV_16UC1);
  EXPECT_EQ(read("gt/object_id").type(), CV_16UC1);
  const cv::Mat depth = read("depth");
  ASSERT_EQ(depth.type(), CV_16UC1);
  EXPECT_EQ(depth.size(), cv::Size(160, 120));
  EXPECT_EQ(cv::countNonZero(depth != 6000), 0);
}

TEST_F(WrittenSequence, HasTheSameBytesWithOneThreadAndTwo) {
  Write(root_ / "one", Options(1));
  Write(root_ / "two", Options(2));
  EXPECT_EQ(Contents(root_ / "one"), Contents(root_ / "two"));
}

TEST_F(WrittenSequence, ChangesWithTheSeed) {
  SequenceOptions other = Options();
  other.rig.seed = 2;
  Write(root_ / "one", Options(), 1);
  Write(root_ / "two", other, 1);
  EXPECT_NE(io::ReadFile(root_ / "one/depth/0.000000.png"),
            io::ReadFile(root_ / "two/depth/0.000000.png"));
}

TEST_F(WrittenSequence, LeavesNoDetectionsFileWithoutADetector) {
  SequenceOptions options = Options();
  options.rig.detector = DetectorKind::kNone;
  Write(root_ / "seq", options, 1);
  EXPECT_FALSE(fs::exists(root_ / "seq/detections.jsonl"));
}

TEST_F(WrittenSequence, TellsTheCameraInItsManifestAsInCameraYaml) {
  SequenceOptions options = Options();
  options.rig.sensor.calibration.intrinsics = 0.02;
  Write(root_ / "seq", options, 1);
  const double fx = (*ReadManifest(root_ / "seq"))["camera"]["fx"];
  EXPECT_NE(fx, options.rig.camera.fx);
  EXPECT_THAT(io::ReadFile(root_ / "seq/camera.yaml"),
              HasSubstr("fx: " + io::NumberText(fx) + "\n"));
}

TEST_F(WrittenSequence, IsRefusedWhereAFolderExists) {
  Write(root_ / "seq", Options(), 1);
  const auto before = Contents(root_ / "seq");
  EXPECT_THAT(RefusalOf([&] { Write(root_ / "seq", Options(), 2); }), HasSubstr("--force"));
  EXPECT_EQ(Contents(root_ / "seq"), before);
}

TEST_F(WrittenSequence, ReplacesAnOldSequenceWhenForced) {
  Write(root_ / "seq", Options(), 3);
  SequenceOptions options = Options();
  options.existing = Existing::kReplace;
  Write(root_ / "seq", options, 2);
  Write(root_ / "fresh", Options(), 2);
  EXPECT_EQ(Contents(root_ / "seq"), Contents(root_ / "fresh"));
}

TEST_F(WrittenSequence, NeverReplacesAFolderThatIsNotASequence) {
  fs::create_directories(root_ / "mine");
  io::WriteFile(root_ / "mine/thesis.tex", "years of work");
  SequenceOptions options = Options();
  options.existing = Existing::kReplace;
  EXPECT_THAT(RefusalOf([&] { Write(root_ / "mine", options, 1); }), HasSubstr("left alone"));
  EXPECT_EQ(io::ReadFile(root_ / "mine/thesis.tex"), "years of work");
}

TEST_F(WrittenSequence, BeginsWhereARunWasKilledBeforeItsManifest) {
  fs::create_directories(root_ / "seq/gt/plane_id");
  io::WriteFile(root_ / "seq" / (std::string("manifest.json") + io::kUnfinishedSuffix), "{");
  Write(root_ / "fresh", Options(), 1);
  for (const Existing existing : {Existing::kResume, Existing::kReplace}) {
    const fs::path folder = root_ / ("seq" + std::to_string(static_cast<int>(existing)));
    fs::copy(root_ / "seq", folder, fs::copy_options::recursive);
    SequenceOptions options = Options();
    options.existing = existing;
    Write(folder, options, 1);
    EXPECT_EQ(Contents(folder), Contents(root_ / "fresh"));
  }
}

/// Death tests run in a process of their own, started anew: a fork alone would lack the ray
/// tracer's threads. The child repeats SetUp, so it is told the folder of its parent.
class InterruptedSequence : public WrittenSequence {
 protected:
  void SetUp() override {
    testing::FLAGS_gtest_death_test_style = "threadsafe";
    if (const char* given = std::getenv(kFolderVariable)) {
      root_ = given;
      return;
    }
    WrittenSequence::SetUp();
    setenv(kFolderVariable, root_.c_str(), 1);
  }
  void TearDown() override { unsetenv(kFolderVariable); }
  /// Dies in the middle of a write, after `frames` frames.
  static void WriteAndDie(const fs::path& folder, int frames) {
    SequenceOptions options = Options();
    options.progress = [frames](int done) {
      if (done == frames) kill(getpid(), SIGKILL);
    };
    Write(folder, options);
  }
  /// A limit on the size of a file stands for a full disk: both make write() fail half way.
  /// Exits with 0 when the error says which file and why.
  static void WriteToAFullDisk(const fs::path& folder) {
    signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{4000, 4000};
    setrlimit(RLIMIT_FSIZE, &limit);
    const std::string error = RefusalOf([&] { Write(folder, Options(2)); });
    _exit(error.find(": cannot be written: File too large") != std::string::npos ? 0 : 1);
  }
  static constexpr const char* kFolderVariable = "PAS_TEST_INTERRUPTED_FOLDER";
};

TEST_F(InterruptedSequence, NeverLooksCompleteAndResumesToTheSameBytes) {
  constexpr int kDone = 3;
  const fs::path folder = root_ / "killed";
  EXPECT_EXIT(WriteAndDie(folder, kDone), testing::KilledBySignal(SIGKILL), "");
  const auto manifest = ReadManifest(folder);
  ASSERT_TRUE(manifest.has_value());
  EXPECT_EQ((*manifest)["complete"], false);
  // A frame that was being written, and one whose image the disk lost.
  std::ofstream(folder / "rgb/0.166667.png.part") << "half a picture";
  std::ofstream(folder / "rgb/0.000000.png") << "torn";

  SequenceOptions resume = Options();
  resume.existing = Existing::kResume;
  EXPECT_EQ(Write(folder, resume), 6 - kDone + 1);
  Write(root_ / "whole", Options());
  EXPECT_EQ(Contents(folder), Contents(root_ / "whole"));
}

TEST_F(InterruptedSequence, MakesFramesAgainWhoseRecordsAreNotWhole) {
  constexpr int kDone = 3;
  const fs::path folder = root_ / "killed";
  EXPECT_EXIT(WriteAndDie(folder, kDone), testing::KilledBySignal(SIGKILL), "");
  ASSERT_TRUE(fs::exists(folder / ".frames/000001.json"));
  std::ofstream(folder / ".frames/000000.json") << "{}";
  std::ofstream(folder / ".frames/000001.json") << R"({"sha256": {}})";
  SequenceOptions resume = Options();
  resume.existing = Existing::kResume;
  EXPECT_EQ(Write(folder, resume), 6 - kDone + 2);
  Write(root_ / "whole", Options());
  EXPECT_EQ(Contents(folder), Contents(root_ / "whole"));
}

TEST_F(WrittenSequence, ResumesACompleteOneByDoingNothing) {
  Write(root_ / "seq", Options());
  const auto before = Contents(root_ / "seq");
  SequenceOptions resume = Options();
  resume.existing = Existing::kResume;
  EXPECT_EQ(Write(root_ / "seq", resume), 0);
  EXPECT_EQ(Contents(root_ / "seq"), before);
}

TEST_F(WrittenSequence, IsNotResumedWithOtherOptions) {
  Write(root_ / "seq", Options());
  SequenceOptions resume = Options();
  resume.existing = Existing::kResume;
  resume.rig.seed = 9;
  EXPECT_THAT(RefusalOf([&] { Write(root_ / "seq", resume); }),
              HasSubstr("seed was 1, now it is 9"));
  resume = Options();
  resume.existing = Existing::kResume;
  resume.rig.camera = Resize(Camera{}, 320, 240);
  EXPECT_THAT(RefusalOf([&] { Write(root_ / "seq", resume); }), HasSubstr("camera was"));
}

TEST_F(WrittenSequence, IsNotResumedWithAnotherSensorOfTheSameName) {
  SequenceOptions mine = Options();
  mine.rig.sensor = ParseSensor("base: d435\nname: mine\nrounding_m: 0.002\n", "mine.yaml");
  Write(root_ / "seq", mine);
  mine.existing = Existing::kResume;
  EXPECT_EQ(Write(root_ / "seq", mine), 0);
  mine.rig.sensor = ParseSensor("base: azure\nname: mine\nrounding_m: 0.002\n", "mine.yaml");
  EXPECT_THAT(RefusalOf([&] { Write(root_ / "seq", mine); }), HasSubstr("sensor_base was"));
}

// Its options are the same: only the files that are written before the first frame tell.
TEST_F(WrittenSequence, IsNotResumedAlongAnotherTrajectoryOfAsManyFrames) {
  Write(root_ / "seq", Options(), 2);
  const auto before = Contents(root_ / "seq");
  std::vector<TimedPose> higher = SmallArc(2);
  for (TimedPose& pose : higher) pose.T_wc.t.z() += 0.05;
  SequenceOptions resume = Options();
  resume.existing = Existing::kResume;
  EXPECT_THAT(RefusalOf([&] { WriteSequence(SmallDesk(), higher, resume, root_ / "seq"); }),
              HasSubstr("cannot resume: the content of groundtruth.txt was"));
  EXPECT_EQ(Contents(root_ / "seq"), before);
}

// The manifest names only what is not plain, so a key may be gone instead of changed.
TEST_F(WrittenSequence, IsNotResumedWithoutAnOptionItWasBegunWith) {
  SequenceOptions blurred = Options();
  blurred.rig.sensor.exposure.shutter_s = 0.02;
  Write(root_ / "seq", blurred);
  SequenceOptions resume = Options();
  resume.existing = Existing::kResume;
  EXPECT_THAT(RefusalOf([&] { Write(root_ / "seq", resume); }),
              ::testing::AllOf(HasSubstr("exposure was"), HasSubstr("now it is null")));
  blurred.existing = Existing::kResume;
  EXPECT_EQ(Write(root_ / "seq", blurred), 0);
}

TEST_F(InterruptedSequence, SaysWhichFileDoesNotFitOnTheDisk) {
  const fs::path folder = root_ / "seq";
  EXPECT_EXIT(WriteToAFullDisk(folder), testing::ExitedWithCode(0), "");
  EXPECT_EQ((*ReadManifest(folder))["complete"], false);
  EXPECT_FALSE(fs::exists(folder / "rgb/0.000000.png"));
}

TEST_F(WrittenSequence, SaysWhichFolderCannotBeMade) {
  io::WriteFile(root_ / "file", "");
  EXPECT_THAT(RefusalOf([&] { Write(root_ / "file/seq", Options()); }),
              HasSubstr("cannot be made"));
  EXPECT_THAT(RefusalOf([&] { Write(root_ / "file", Options()); }), HasSubstr("is a file"));
}

TEST(PlannedManifest, TellsEveryDefectOfTime) {
  SequenceOptions options;
  options.rig.sensor.timing = {.drop_ratio = 0.04,
                               .repeat_ratio = 0.1,
                               .depth_offset_s = 0.012,
                               .stamp_jitter_s = 0.003};
  const Recording recording = PlanRecording(SmallArc(5), {}, options.rig);
  const auto timing = PlannedManifest(SmallDesk(), recording, options, {}).at("timing");
  EXPECT_EQ(timing.at("drop_ratio"), 0.04);
  EXPECT_EQ(timing.at("repeat_ratio"), 0.1);
  EXPECT_EQ(timing.at("depth_offset_s"), 0.012);
  EXPECT_EQ(timing.at("stamp_jitter_s"), 0.003);
}

TEST(GroundTruthText, ReadsBackAsTheVeryPose) {
  const auto trajectory = SmallArc(1);
  const std::string text =
      FixedFiles(SmallDesk(), {}, RigOptions{}, MakeShots(trajectory, {}, 1))
          .at("groundtruth.txt");
  std::istringstream line(text.substr(text.rfind("0.000000")));
  double t, x, y, z, qx, qy, qz, qw;
  line >> t >> x >> y >> z >> qx >> qy >> qz >> qw;
  const Pose& T_wc = trajectory[0].T_wc;
  EXPECT_EQ(Eigen::Vector3d(x, y, z), T_wc.t);
  const Eigen::Matrix3d R = Eigen::Quaterniond(qw, qx, qy, qz).toRotationMatrix();
  EXPECT_LT((R - T_wc.R).cwiseAbs().maxCoeff(), 1e-14);
}

TEST_F(WrittenSequence, TellsWhatTheKinectAsRecordedHides) {
  SequenceOptions options = Options();
  options.rig.sensor = SensorKind::kKinect1;
  options.rig.sensor.timing = {};
  options.rig.seed = 9;
  WriteSequence(OneBoard(1.2), SmallArc(2), options, root_ / "seq");
  EXPECT_EQ(io::ReadFile(root_ / "seq/gt/camera.yaml"), CameraYaml(options.rig.camera));
  EXPECT_EQ(io::ReadFile(root_ / "seq/camera.yaml"), CameraYaml(options.rig.CameraAsTold()));
  EXPECT_NE(io::ReadFile(root_ / "seq/camera.yaml"),
            io::ReadFile(root_ / "seq/gt/camera.yaml"));

  const cv::Mat1w warp = test_support::ReadImageFile(root_ / "seq/gt/depth_warp.png");
  const cv::Mat1f p = DevicePattern(options.rig.sensor.depth, options.rig.camera, 9);
  ASSERT_EQ(warp.size(), p.size());
  EXPECT_NEAR((warp(7, 11) - 32768) * 1e-6, p(7, 11), 1e-6);

  options.rig.sensor = SensorKind::kKinect1Clean;
  WriteSequence(OneBoard(1.2), SmallArc(2), options, root_ / "clean");
  EXPECT_FALSE(std::filesystem::exists(root_ / "clean/gt/camera.yaml"));
  EXPECT_FALSE(std::filesystem::exists(root_ / "clean/gt/depth_warp.png"));
}

}  // namespace
}  // namespace sim
