// A folder whose depth is an image of a camera of its own, brought into the form that pas slam reads.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/image_files.h"
#include "tests/support/program.h"

namespace {

using namespace program;
using testing::AllOf;
using testing::HasSubstr;

/// Two frames of a wall at 1 m, on the right at 2 m. What the depth camera sees lies 40 mm farther to
/// the left for the colour camera, which has twice its focal length and size.
class FolderWithTwoCameras : public testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(seq() / "rgb"), fs::create_directories(seq() / "depth");
    cv::Mat1w depth_mm(24, 32, std::uint16_t{1000});
    depth_mm.colRange(16, 32) = 2000;
    depth_mm(12, 8) = 65535;  // nothing was measured
    const cv::Mat3b bgr(48, 64, cv::Vec3b(10, 20, 30));
    for (const std::string stamp : {"1.000000", "1.033333"}) {
      test_support::WriteImageFile(seq() / ("rgb/" + stamp + ".png"), bgr);
      test_support::WriteImageFile(seq() / ("depth/" + stamp + ".png"), depth_mm);
      std::ofstream(seq() / "rgb.txt", std::ios::app) << stamp << " rgb/" << stamp << ".png\n";
      std::ofstream(seq() / "depth.txt", std::ios::app)
          << stamp << " depth/" << stamp << ".png\n";
    }
    std::ofstream(seq() / "camera.yaml")
        << "model: pinhole\nwidth: 64\nheight: 48\nfx: 90\nfy: 90\ncx: 31\ncy: 23\n"
           "depth_factor: 1000\nfps: 30\n";
    std::ofstream(seq() / "groundtruth.txt") << "1.0 1 2 3 0 0 0 1\n";
    WriteRegistration(64);
  }
  void WriteRegistration(int width) const {
    std::ofstream(folder_ / "registration.yaml")
        << "depth: {width: 32, height: 24, fx: 50, fy: 50, cx: 15.25, cy: 11.25}\n"
        << "colour: {width: " << width
        << ", height: 48, fx: 100, fy: 100, cx: 31, cy: 23, k1: 0.01}\n"
        << "translation: [-0.04, 0, 0]\nrotation: [0, 0, 0, 1]\n";
  }
  fs::path seq() const { return folder_ / "seq"; }
  Outcome Import(const std::vector<std::string>& more) const {
    std::vector<std::string> command{Pas(), "-q", "import", seq(), "-o", folder_ / "out"};
    command.insert(command.end(), more.begin(), more.end());
    return Process(command, {}, folder_ / "errors").Wait();
  }
  std::string Registration() const { return folder_ / "registration.yaml"; }

  TemporaryFolder folder_;
};

TEST_F(FolderWithTwoCameras, HasItsDepthWhereColourShowsIt) {
  const Outcome outcome = Import({"--depth-registration", Registration()});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
  const cv::Mat1w depth_mm = test_support::ReadImageFile(folder_ / "out/depth/1.033333.png");
  ASSERT_EQ(depth_mm.size(), cv::Size(64, 48));
  // A pixel of depth is two of colour; at 1 m it lies 4 pixels further left, at 2 m 2 pixels.
  EXPECT_EQ(depth_mm(24, 10), 1000);
  EXPECT_EQ(depth_mm(24, 50), 2000);
  EXPECT_EQ(depth_mm(24, 26), 1000);
  EXPECT_EQ(depth_mm(24, 32), 2000);
  EXPECT_EQ(depth_mm(24, 63), 0);  // the depth camera does not see so far to the right
  EXPECT_EQ(depth_mm(24, 2 * 8 - 4), 0);
  // Colour and its camera are what the registration says; what it does not say stays.
  const std::string camera = ReadText(folder_ / "out/camera.yaml");
  EXPECT_THAT(camera, AllOf(HasSubstr("fx: 100\n"), HasSubstr("k1: 0.01\n"),
                            HasSubstr("depth_factor: 1000\n")));
  EXPECT_EQ(ReadText(folder_ / "out/rgb/1.000000.png"), ReadText(seq() / "rgb/1.000000.png"));
  EXPECT_EQ(ReadText(folder_ / "out/groundtruth.txt"), ReadText(seq() / "groundtruth.txt"));
  EXPECT_EQ(
      Process({Pas(), "-q", "check", folder_ / "out"}, {}, folder_ / "errors").Wait().exit_code,
      0);
}

TEST_F(FolderWithTwoCameras, IsRefusedWithoutTheirPlacesAndWithImagesOfAnotherSize) {
  const Outcome without = Import({});
  EXPECT_EQ(without.exit_code, 2);
  EXPECT_THAT(without.errors, HasSubstr("--depth-registration"));
  WriteRegistration(80);
  const Outcome other = Import({"--depth-registration", Registration()});
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_THAT(other.errors,
              AllOf(HasSubstr("1.000000.png"), HasSubstr("64 x 48"), HasSubstr("80 x 48")));
  EXPECT_FALSE(fs::exists(folder_ / "out"));
}

}  // namespace
