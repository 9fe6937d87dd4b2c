// Bags of ROS 1 as a user meets them: the run of a bag is that of a folder with the same frames.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <opencv2/imgproc.hpp>
#include <sstream>

#include "slam/input/camera_reader.h"
#include "tests/support/bag_writer.h"
#include "tests/support/image_files.h"
#include "tests/support/program.h"

namespace {

using namespace program;
using bags::BagWriter;
using bags::Compression;
using testing::AllOf;
using testing::HasSubstr;

struct BagFrame {
  double stamp_s = 0;
  cv::Mat3b bgr;
  cv::Mat1w depth_mm;
};

/// A desk of 30 frames whose folder has depth in millimetres.
class DeskForBags {
 public:
  DeskForBags() {
    const std::vector<std::vector<std::string>> commands{
        {Pas(), "-q", "scene", "make", "--family", "desk", "--seed", "503", "-o",
         folder_ / "desk.yaml"},
        {Pas(), "-q", "sim", folder_ / "desk.yaml", "-o", sequence(), "--sensor",
         "kinect1-clean", "--seed", "503", "--frames", "30", "--width", "320", "--height",
         "240", "--detector", "none"}};
    for (const auto& command : commands) {
      EXPECT_EQ(Process(command, {}, folder_ / "errors").Wait().exit_code, 0);
    }
    camera_ = slam::ReadCamera(sequence() / "camera.yaml").camera;
    std::ifstream list(sequence() / "associations.txt");
    for (std::string line; std::getline(list, line);) {
      if (line.empty() || line[0] == '#') continue;
      std::istringstream text(line);
      std::string stamp, rgb, depth_stamp, depth;
      text >> stamp >> rgb >> depth_stamp >> depth;
      BagFrame frame{std::stod(stamp), test_support::ReadImageFile(sequence() / rgb), {}};
      const cv::Mat raw = test_support::ReadImageFile(sequence() / depth);
      raw.convertTo(frame.depth_mm, CV_16U, 1000 / camera_.depth_factor);
      test_support::WriteImageFile(sequence() / depth, frame.depth_mm);
      frames_.push_back(frame);
    }
    std::string camera = ReadText(sequence() / "camera.yaml");
    const std::size_t at = camera.find("depth_factor:");
    camera.replace(at, camera.find('\n', at) - at, "depth_factor: 1000");
    std::ofstream(sequence() / "camera.yaml") << camera;
  }
  fs::path sequence() const { return folder_ / "seq"; }
  const slam::Camera& camera() const { return camera_; }
  const std::vector<BagFrame>& frames() const { return frames_; }

 private:
  TemporaryFolder folder_;
  slam::Camera camera_;
  std::vector<BagFrame> frames_;
};

const DeskForBags& Desk() {
  static const DeskForBags desk;
  return desk;
}

cv::Mat Rgb(const cv::Mat3b& bgr) {
  cv::Mat rgb;
  cv::cvtColor(bgr, rgb, cv::COLOR_BGR2RGB);
  return rgb;
}

/// As Kinect's driver gives it: metres, and NaN where nothing was measured.
cv::Mat1f Metres(const cv::Mat1w& depth_mm) {
  cv::Mat1f depth_m(depth_mm.size(), std::numeric_limits<float>::quiet_NaN());
  for (int v = 0; v < depth_mm.rows; ++v) {
    for (int u = 0; u < depth_mm.cols; ++u) {
      if (depth_mm(v, u) > 0) depth_m(v, u) = static_cast<float>(depth_mm(v, u) / 1000.0);
    }
  }
  return depth_m;
}

class BagProgram : public testing::Test {
 protected:
  static constexpr const char* kColour = "/camera/rgb/image_color";
  static constexpr const char* kDepth = "/camera/depth/image";

  Outcome Run(const std::vector<std::string>& arguments) const {
    std::vector<std::string> command{Pas(), "-q"};
    command.insert(command.end(), arguments.begin(), arguments.end());
    return Process(command, {}, folder_ / "errors").Wait();
  }
  std::string Bag() const { return folder_ / "a.bag"; }
  void WriteInfo(BagWriter& bag, const std::string& topic) const {
    const slam::Camera& c = Desk().camera();
    bag.CameraInfo(topic, {c.width, c.height}, {c.fx, c.fy, c.cx, c.cy}, "plumb_bob",
                   {c.k1, c.k2, c.p1, c.p2, c.k3});
  }
  /// Everything but times, what is said of the input, and its name.
  std::map<std::string, std::string> RunOf(const fs::path& input) const {
    const fs::path run = folder_ / "run";
    EXPECT_EQ(Run({"slam", input, "-o", run, "--detector", "none", "--force"}).exit_code, 0);
    auto contents = Contents(run);
    EXPECT_GT(contents["trajectory.txt"].size(), 1000u);
    contents.erase("timing.csv");
    contents.erase("run.json");
    return contents;
  }
  void ExpectRunOfFolder(const std::map<std::string, std::string>& run) const {
    static const auto of_folder = RunOf(Desk().sequence());
    EXPECT_EQ(run.size(), of_folder.size());
    for (const auto& [name, bytes] : of_folder) {
      EXPECT_TRUE(run.count(name) > 0 && run.at(name) == bytes) << name;
    }
  }
  void ExpectRunOfBag() const { ExpectRunOfFolder(RunOf(Bag())); }
  /// The desk under TUM's names; depth in metres.
  void WriteTum(Compression compression, const std::string& depth_encoding = "32FC1",
                const std::string& depth_frame = "/openni_rgb_optical_frame") const {
    BagWriter bag(Bag(), compression);
    for (const BagFrame& frame : Desk().frames()) {
      bag.Image(kColour, frame.stamp_s, "/openni_rgb_optical_frame", "rgb8", Rgb(frame.bgr));
      WriteInfo(bag, "/camera/rgb/camera_info");
      const cv::Mat depth =
          depth_encoding == "32FC1" ? cv::Mat(Metres(frame.depth_mm)) : cv::Mat(frame.depth_mm);
      bag.Image(kDepth, frame.stamp_s, depth_frame, depth_encoding, depth);
    }
  }
  void ExpectRefused(const std::string& what, const std::string& mend) const {
    const fs::path run = folder_ / "refused";
    const Outcome outcome = Run({"slam", Bag(), "-o", run});
    EXPECT_EQ(outcome.exit_code, 2) << outcome.signal << outcome.errors;
    EXPECT_THAT(outcome.errors, AllOf(HasSubstr("a.bag"), HasSubstr(what), HasSubstr(mend)));
    EXPECT_FALSE(fs::exists(run));
  }

  TemporaryFolder folder_;
};

TEST_F(BagProgram, TumBagGivesTheRunOfTheFolderHoweverItIsPacked) {
  for (const Compression c : {Compression::kNone, Compression::kBz2, Compression::kLz4}) {
    SCOPED_TRACE(static_cast<int>(c));
    WriteTum(c);
    ExpectRunOfBag();
  }
}

TEST_F(BagProgram, SixteenBitsOfDepthAreMillimetres) {
  WriteTum(Compression::kNone, "16UC1");
  ExpectRunOfBag();
}

TEST_F(BagProgram, RealSenseBagGivesTheRunOfTheFolder) {
  {
    BagWriter bag(Bag(), Compression::kLz4);
    for (const std::string stream :
         {"/device_0/sensor_0/Depth_0/", "/device_0/sensor_1/Color_0/"}) {
      WriteInfo(bag, stream + "info/camera_info");
      bag.Transform(stream + "tf/0", {0, 0, 0}, {0, 0, 0, 1});
    }
    bag.Number("/device_0/sensor_0/option/Depth Units/value", 0.00025f);
    for (const BagFrame& frame : Desk().frames()) {
      bag.Image("/device_0/sensor_0/Depth_0/image/data", frame.stamp_s, "0", "mono16",
                4 * frame.depth_mm);
      bag.Image("/device_0/sensor_1/Color_0/image/data", frame.stamp_s, "0", "bgr8", frame.bgr);
      bag.Image("/device_0/sensor_0/Infrared_1/image/data", frame.stamp_s, "0", "8UC1",
                cv::Mat1b(240, 320, uchar{9}));
    }
  }
  ExpectRunOfBag();
}

TEST_F(BagProgram, ImportedBagIsTheFolder) {
  WriteTum(Compression::kLz4, "16UC1");
  ASSERT_EQ(Run({"import", Bag(), "-o", folder_ / "seq"}).exit_code, 0);
  ExpectRunOfFolder(RunOf(folder_ / "seq"));
  const slam::Camera camera = slam::ReadCamera(folder_ / "seq" / "camera.yaml").camera;
  EXPECT_EQ(camera.fx, Desk().camera().fx);
  EXPECT_EQ(camera.depth_factor, 1000);
  EXPECT_EQ(Run({"check", folder_ / "seq"}).exit_code, 0);
  EXPECT_EQ(Run({"draw", folder_ / "run", "-o", folder_ / "pictures"}).exit_code, 0);
  EXPECT_EQ(Run({"import", Bag(), "-o", folder_ / "seq"}).exit_code, 2);
}

TEST_F(BagProgram, ImportedDepthKeepsItsOwnTime) {
  {
    BagWriter bag(Bag(), Compression::kNone);
    for (const BagFrame& frame : Desk().frames()) {
      bag.Image(kColour, frame.stamp_s, "/openni_rgb_optical_frame", "rgb8", Rgb(frame.bgr));
      WriteInfo(bag, "/camera/rgb/camera_info");
      bag.Image(kDepth, frame.stamp_s + 0.012, "/openni_rgb_optical_frame", "16UC1",
                frame.depth_mm);
    }
  }
  ASSERT_EQ(Run({"import", Bag(), "-o", folder_ / "seq"}).exit_code, 0);
  std::istringstream pairs(ReadText(folder_ / "seq/associations.txt"));
  std::string rgb, depth;
  double stamp_s = 0, depth_stamp_s = 0;
  int count = 0;
  for (; pairs >> stamp_s >> rgb >> depth_stamp_s >> depth; ++count) {
    EXPECT_NEAR(depth_stamp_s - stamp_s, 0.012, 2e-6);
  }
  EXPECT_EQ(count, static_cast<int>(Desk().frames().size()));
}

TEST_F(BagProgram, ImportedBagHasTheRateOfItsStamps) {
  {
    BagWriter bag(Bag(), Compression::kNone);
    const BagFrame& frame = Desk().frames().front();
    for (int i = 0; i < 4; ++i) {
      bag.Image(kColour, 1 + i / 90.0, "rgb", "rgb8", Rgb(frame.bgr));
      bag.Image(kDepth, 1 + i / 90.0, "rgb", "16UC1", frame.depth_mm);
    }
    WriteInfo(bag, "/camera/rgb/camera_info");
  }
  ASSERT_EQ(Run({"import", Bag(), "-o", folder_ / "seq"}).exit_code, 0);
  EXPECT_NEAR(slam::ReadCamera(folder_ / "seq/camera.yaml").camera.fps, 90, 1e-3);
}

TEST_F(BagProgram, BenchRefusesABagAtOnceAndLeavesNothing) {
  WriteTum(Compression::kNone);
  const fs::path scratch = folder_ / "scratch";
  fs::create_directory(scratch);
  const Outcome outcome =
      Process({Pas(), "bench", "slam", Bag()}, {{"TMPDIR", scratch}}, folder_ / "errors")
          .Wait();
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.errors, AllOf(HasSubstr("is a ROS bag"), HasSubstr("pas import")));
  EXPECT_TRUE(fs::is_empty(scratch));
}

TEST_F(BagProgram, CalibrateReadsBags) {
  WriteTum(Compression::kNone);
  const Outcome outcome = Run({"calibrate", Bag(), "-o", folder_ / "warp.yaml"});
  EXPECT_EQ(outcome.exit_code, 1);  // a clean camera: nothing to learn
  EXPECT_THAT(outcome.errors, HasSubstr("no warp is written"));
}

TEST_F(BagProgram, CommandsThatReadFilesNameImport) {
  WriteTum(Compression::kNone);
  const Outcome outcome = Run({"surfaces", Bag(), "-o", folder_ / "surfaces.yaml"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.errors, AllOf(HasSubstr("is a ROS bag"), HasSubstr("pas import")));
}

TEST_F(BagProgram, WhatIsNoBagIsRefused) {
  std::ofstream(Bag()) << "not a bag";
  ExpectRefused("cannot be read as a bag", "copy it again");
  std::ofstream(Bag()) << "";
  ExpectRefused("cannot be read as a bag", "copy it again");
}

TEST_F(BagProgram, CutOffBagIsRefusedWhereverItIsCut) {
  WriteTum(Compression::kLz4);
  const std::string whole = ReadText(Bag());
  for (const double share : {0.0001, 0.3, 0.9, 0.9999}) {
    SCOPED_TRACE(share);
    std::ofstream(Bag(), std::ios::binary)
        << whole.substr(0, static_cast<std::size_t>(share * static_cast<double>(whole.size())));
    ExpectRefused("a.bag", "copy it again");
  }
}

TEST_F(BagProgram, DamagedChunkIsRefused) {
  WriteTum(Compression::kBz2);
  std::string bytes = ReadText(Bag());
  for (std::size_t i = bytes.size() / 2; i < bytes.size() / 2 + 64; ++i) bytes[i] = 'x';
  std::ofstream(Bag(), std::ios::binary) << bytes;
  ExpectRefused("cannot be read as a bag", "copy it again");
}

TEST_F(BagProgram, BagWithoutDepthOrColourIsRefusedWithWhatItHolds) {
  const BagFrame& frame = Desk().frames().front();
  {
    BagWriter bag(Bag(), Compression::kNone);
    bag.Image(kColour, 1, "rgb", "rgb8", Rgb(frame.bgr));
    WriteInfo(bag, "/camera/rgb/camera_info");
  }
  ExpectRefused("has no topic of depth", "/camera/rgb/image_color (rgb8)");
  {
    BagWriter bag(Bag(), Compression::kNone);
    bag.Image(kColour, 1, "rgb", "yuv422", frame.bgr);
    bag.Image(kDepth, 1, "rgb", "16UC1", frame.depth_mm);
  }
  ExpectRefused("has no topic of colour", "/camera/rgb/image_color (yuv422)");
}

TEST_F(BagProgram, BagWithoutCameraNeedsTheOption) {
  {
    BagWriter bag(Bag(), Compression::kNone);
    for (const BagFrame& frame : Desk().frames()) {
      bag.Image(kColour, frame.stamp_s, "rgb", "rgb8", Rgb(frame.bgr));
      bag.Image(kDepth, frame.stamp_s, "rgb", "16UC1", frame.depth_mm);
    }
  }
  ExpectRefused("has no CameraInfo beside /camera/rgb/image_color", "--camera");
  EXPECT_EQ(
      Run({"slam", Bag(), "-o", folder_ / "run", "--camera", Desk().sequence() / "camera.yaml"})
          .exit_code,
      0);
}

TEST_F(BagProgram, DepthThatIsNotLaidOnColourIsRefused) {
  WriteTum(Compression::kNone, "32FC1", "/openni_depth_optical_frame");
  ExpectRefused("it is not laid on colour", "align_depth:=true");
}

TEST_F(BagProgram, EncodingThatChangesOnTheWayIsRefusedAtItsFrame) {
  {
    BagWriter bag(Bag(), Compression::kNone);
    const BagFrame& frame = Desk().frames().front();
    for (int i = 0; i < 3; ++i) {
      bag.Image(kColour, 1 + i, "rgb", i < 2 ? "rgb8" : "yuv422", Rgb(frame.bgr));
      bag.Image(kDepth, 1 + i, "rgb", "16UC1", frame.depth_mm);
    }
    WriteInfo(bag, "/camera/rgb/camera_info");
  }
  ExpectRefused("frame 2, /camera/rgb/image_color, image 2", "the encoding is `yuv422`");
}

TEST_F(BagProgram, MemoryDoesNotGrowWithTheLength) {
  std::array<double, 2> peak_mb{};
  for (int i = 0; i < 2; ++i) {
    {
      BagWriter bag(Bag(), Compression::kNone);
      const BagFrame& frame = Desk().frames().front();
      const int frames = i == 0 ? 20 : 300;  // 8 and 115 MB of images
      for (int k = 0; k < frames; ++k) {
        bag.Image(kColour, 1 + k, "rgb", "rgb8", Rgb(frame.bgr));
        bag.Image(kDepth, 1 + k, "rgb", "16UC1", frame.depth_mm);
      }
      WriteInfo(bag, "/camera/rgb/camera_info");
    }
    const Outcome outcome = Run({"import", Bag(), "-o", folder_ / "seq", "--force"});
    EXPECT_EQ(outcome.exit_code, 0);
    peak_mb[static_cast<std::size_t>(i)] = outcome.peak_mb;
  }
  EXPECT_LT(peak_mb[1], peak_mb[0] + 10);
}

}  // namespace
