// Cameras as other programs write them: what `pas slam` can run must not be refused afterwards.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "eval/formats/sequence/camera.h"
#include "tests/support/refusal.h"
#include "tests/support/temporary_folder.h"

namespace eval {
namespace {

class CameraForms : public ::testing::Test {
 protected:
  Camera Read(const std::string& text) const {
    std::ofstream(temporary_ / "camera.yaml") << text;
    Folder folder(temporary_.path());
    return ReadCamera(folder).value();
  }
  static void ExpectSame(const Camera& found, double fps) {
    EXPECT_EQ(found.width, 640);
    EXPECT_EQ(found.height, 480);
    EXPECT_EQ(found.fx, 517.3);
    EXPECT_EQ(found.fy, 516.5);
    EXPECT_EQ(found.cx, 318.6);
    EXPECT_EQ(found.cy, 255.3);
    EXPECT_EQ(found.fps, fps);
    EXPECT_EQ(found.depth_factor, 5000);
    EXPECT_EQ(found.distortion, (std::array{0.26, -0.95, -0.005, 0.003, 1.16}));
  }

  test_support::TemporaryFolder temporary_;
};

TEST_F(CameraForms, OfOrbSlamAreRead) {
  const auto settings = [](const std::string& lens, const char* factor) {
    std::string text = "%YAML:1.0\nCamera.width: 640\nCamera.height: 480\nCamera.fps: 15.0\n";
    for (const char* value : {"fx: 517.3", "fy: 516.5", "cx: 318.6", "cy: 255.3", "k1: 0.26",
                              "k2: -0.95", "p1: -0.005", "p2: 0.003", "k3: 1.16"}) {
      text += lens + value + "\n";
    }
    return text + factor + ": 5000.0\nORBextractor.nFeatures: 1000\n";
  };
  ExpectSame(Read(settings("Camera.", "DepthMapFactor")), 15);
  ExpectSame(Read(settings("Camera1.", "RGBD.DepthMapFactor")), 15);
}

TEST_F(CameraForms, OfOpenCvAndRosAreRead) {
  const std::string matrix = "[517.3, 0, 318.6, 0, 516.5, 255.3, 0, 0, 1]";
  const std::string lens = "[0.26, -0.95, -0.005, 0.003, 1.16]";
  ExpectSame(
      Read("image_width: 640\nimage_height: 480\ncamera_name: c\ncamera_matrix:\n  rows: "
           "3\n  cols: 3\n  data: " +
           matrix + "\ndistortion_coefficients:\n  rows: 1\n  cols: 5\n  data: " + lens +
           "\ndepth_factor: 5000\nfps: 15\n"),
      15);
  const std::string size = "height: 480\nwidth: 640\ndepth_factor: 5000\n";
  ExpectSame(Read(size + "K: " + matrix + "\nD: " + lens + "\n"), 30);
  ExpectSame(Read(size + "k: " + matrix + "\nd: " + lens + "\n"), 30);
}

TEST_F(CameraForms, WithoutARateAreOfThirtyFramesASecond) {
  ExpectSame(
      Read("model: pinhole\nwidth: 640\nheight: 480\nfx: 517.3\nfy: 516.5\ncx: 318.6\ncy: "
           "255.3\ndepth_factor: 5000\nk1: 0.26\nk2: -0.95\np1: -0.005\np2: 0.003\nk3: "
           "1.16\n"),
      30);
}

TEST_F(CameraForms, OfAnotherLensAreRefusedAsPasSlamDoes) {
  // Read as Brown's, a fisheye's coefficients would put what is at 45 degrees 140 pixels off.
  const std::string matrix = "[500, 0, 320, 0, 500, 240, 0, 0, 1]";
  const auto of_ros = [&](const std::string& model, const std::string& lens) {
    return "image_width: 640\nimage_height: 480\ncamera_matrix: {data: " + matrix +
           "}\ndistortion_model: " + model + "\ndistortion_coefficients: {data: " + lens +
           "}\ndepth_factor: 5000\n";
  };
  const std::string of_orb_slam =
      "Camera.width: 640\nCamera.height: 480\nCamera.fx: 500\nCamera.fy: 500\nCamera.cx: "
      "320\nCamera.cy: 240\nDepthMapFactor: 5000\n";
  EXPECT_NO_THROW(Read(of_ros("rational_polynomial", "[0.1, 0, 0, 0, 0, 0, 0, 0]")));
  EXPECT_NO_THROW(Read(of_orb_slam + "Camera.type: \"PinHole\"\n"));
  for (const auto& [text, word] :
       {std::pair(of_ros("equidistant", "[0.1, 0.01, 0, 0]"), "distortion_model"),
        std::pair(of_ros("rational_polynomial", "[0.1, 0, 0, 0, 0, 0.3, 0, 0]"),
                  "k1 k2 p1 p2 k3"),
        std::pair(of_orb_slam + "Camera.type: \"KannalaBrandt8\"\n", "Camera.type"),
        std::pair(of_orb_slam + "Camera.k4: 0.1\n", "Camera.k4")}) {
    EXPECT_THAT(test_support::RefusalOf([&, file = text] { Read(file); }),
                ::testing::HasSubstr(word));
  }
}

TEST_F(CameraForms, ThatLackAValueAreRefusedByItsName) {
  EXPECT_THAT(test_support::RefusalOf([&] { Read("Camera.fx: 500\nCamera.width: 640\n"); }),
              ::testing::HasSubstr("Camera.height"));
}

}  // namespace
}  // namespace eval
