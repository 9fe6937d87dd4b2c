// Cameras in the settings files of other systems.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <fstream>
#include <opencv2/core/persistence.hpp>

#include "io/input_error.h"
#include "slam/input/camera_reader.h"
#include "tests/support/temporary_folder.h"

namespace slam {
namespace {

using ::testing::ContainsRegex;
using ::testing::IsEmpty;
using ::testing::ThrowsMessage;

/// As ORB-SLAM2 comes with it, cut down.
const std::string kOrbSlam2 = R"(%YAML:1.0

#--------------------------------------------------------------------------------------------
# Camera Parameters. Adjust them!
#--------------------------------------------------------------------------------------------

Camera.fx: 517.306408
Camera.fy: 516.469215
Camera.cx: 318.643040
Camera.cy: 255.313989

Camera.k1: 0.262383
Camera.k2: -0.953104
Camera.p1: -0.005358
Camera.p2: 0.002628
Camera.k3: 1.163314

Camera.width: 640
Camera.height: 480
Camera.fps: 25.0
Camera.bf: 40.0
Camera.RGB: 1
ThDepth: 40.0
DepthMapFactor: 5000.0
ORBextractor.nFeatures: 1000
Viewer.KeyFrameSize: 0.05
)";

/// The same camera as ORB-SLAM3 writes it.
const std::string kOrbSlam3 = R"(%YAML:1.0
File.version: "1.0"
Camera.type: "PinHole"
Camera1.fx: 517.306408
Camera1.fy: 516.469215
Camera1.cx: 318.643040
Camera1.cy: 255.313989
Camera1.k1: 0.262383
Camera1.k2: -0.953104
Camera1.p1: -0.005358
Camera1.p2: 0.002628
Camera1.k3: 1.163314
Camera.width: 640
Camera.height: 480
Camera.newWidth: 640
Camera.fps: 25
Camera.RGB: 1
Stereo.ThDepth: 40.0
Stereo.b: 0.07732
RGBD.DepthMapFactor: 5000.0
ORBextractor.scaleFactor: 1.2
)";

/// As ROS writes it, with the unit of depth added.
const std::string kRos = R"(image_width: 640
image_height: 480
camera_name: narrow
camera_matrix: {rows: 3, cols: 3, data: [517.306408, 0, 318.643040, 0, 516.469215, 255.313989, 0, 0, 1]}
distortion_model: plumb_bob
distortion_coefficients: {rows: 1, cols: 5, data: [0.262383, -0.953104, -0.005358, 0.002628, 1.163314]}
rectification_matrix: {rows: 3, cols: 3, data: [1, 0, 0, 0, 1, 0, 0, 0, 1]}
depth_factor: 5000
fps: 25
)";

/// A message of ROS 1 as `rostopic echo` prints it, with the unit of depth added.
const std::string kMessage = R"(header:
  seq: 0
  stamp: {secs: 10, nsecs: 20}
  frame_id: "camera_color_optical_frame"
height: 480
width: 640
distortion_model: "plumb_bob"
D: [0.262383, -0.953104, -0.005358, 0.002628, 1.163314]
K: [517.306408, 0.0, 318.643040, 0.0, 516.469215, 255.313989, 0.0, 0.0, 1.0]
R: [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]
P: [517.306408, 0.0, 318.643040, 0.0, 0.0, 516.469215, 255.313989, 0.0, 0.0, 0.0, 1.0, 0.0]
binning_x: 0
roi: {x_offset: 0, y_offset: 0, height: 0, width: 0, do_rectify: False}
depth_factor: 5000
fps: 25
)";

class CameraFormats : public ::testing::Test {
 protected:
  CameraFile Read(const std::string& text) {
    std::ofstream(file_) << text;
    return ReadCamera(file_);
  }
  void ExpectTum1(const CameraFile& read) {
    const Camera tum = TumCamera("tum1");
    const Camera& c = read.camera;
    EXPECT_THAT(read.warnings, IsEmpty());
    EXPECT_EQ(c.width, tum.width);
    EXPECT_EQ(c.height, tum.height);
    EXPECT_EQ(c.fx, tum.fx);
    EXPECT_EQ(c.fy, tum.fy);
    EXPECT_EQ(c.cx, tum.cx);
    EXPECT_EQ(c.cy, tum.cy);
    EXPECT_EQ(c.k1, tum.k1);
    EXPECT_EQ(c.k2, tum.k2);
    EXPECT_EQ(c.p1, tum.p1);
    EXPECT_EQ(c.p2, tum.p2);
    EXPECT_EQ(c.k3, tum.k3);
    EXPECT_EQ(c.depth_factor, tum.depth_factor);
    EXPECT_EQ(c.fps, 25.0);
  }
  /// `text` with the first `from` replaced.
  static std::string With(std::string text, const std::string& from, const std::string& to) {
    return text.replace(text.find(from), from.size(), to);
  }
  /// `text` with the first `from` replaced must be refused so.
  void ExpectError(const std::string& text, const std::string& from, const std::string& to,
                   const std::string& regex) {
    EXPECT_THAT([&] { Read(With(text, from, to)); },
                ThrowsMessage<io::InputError>(ContainsRegex(regex)))
        << text << to;
  }

  test_support::TemporaryFolder temporary_;
  const std::filesystem::path file_ = temporary_ / "settings.yaml";
};

TEST_F(CameraFormats, AreThoseOfOrbSlam2) { ExpectTum1(Read(kOrbSlam2)); }

TEST_F(CameraFormats, AreThoseOfOrbSlam3) { ExpectTum1(Read(kOrbSlam3)); }

TEST_F(CameraFormats, AreThoseOfRos) { ExpectTum1(Read(kRos)); }

TEST_F(CameraFormats, AreMessagesOfRos) {
  ExpectTum1(Read(kMessage));
  ExpectTum1(Read(With(With(kMessage, "\nK:", "\nk:"), "\nD:", "\nd:")));  // of ROS 2
}

TEST_F(CameraFormats, AreMessagesOfRosWithoutALens) {
  const Camera camera =
      Read(With(kMessage, "[0.262383, -0.953104, -0.005358, 0.002628, 1.163314]", "[]")).camera;
  EXPECT_EQ(camera.k1, 0);
  EXPECT_EQ(camera.fx, TumCamera("tum1").fx);
}

TEST_F(CameraFormats, OfMessagesNeedTheUnitOfDepth) {
  ExpectError(kMessage, "depth_factor: 5000", "",
              "key `depth_factor` is missing; expected .*steps of the depth images a metre");
  ExpectError(kMessage, "K: [517.306408, 0.0,", "K: [517.306408, 3.0,",
              "yaml:9: K: expected data: .fx, 0");
  ExpectError(kMessage, "plumb_bob", "equidistant", "distortion_model: expected one of: plumb");
}

TEST_F(CameraFormats, AreThoseThatOpenCvWrites) {
  const Camera tum = TumCamera("tum1");
  {
    cv::FileStorage out(file_.string(), cv::FileStorage::WRITE);
    out << "calibration_time"
        << "Sun Nov 22 22:00:00 2026";
    out << "image_width" << 640 << "image_height" << 480 << "board_width" << 9;
    out << "camera_matrix"
        << cv::Mat(cv::Matx33d(tum.fx, 0, tum.cx, 0, tum.fy, tum.cy, 0, 0, 1));
    out << "distortion_coefficients"
        << cv::Mat((cv::Mat1d(5, 1) << tum.k1, tum.k2, tum.p1, tum.p2, tum.k3));
    out << "avg_reprojection_error" << 0.25 << "depth_factor" << 5000 << "fps" << 25;
  }
  ExpectTum1(ReadCamera(file_));
}

// Tools write the coefficients of larger models too; at 0 they change nothing.
TEST_F(CameraFormats, TakeALargerModelWhoseFurtherCoefficientsAreZero) {
  ExpectTum1(Read(With(kRos, "1.163314]", "1.163314, 0, 0, 0]")));
  ExpectTum1(Read(With(kOrbSlam2, "Camera.RGB: 1", "Camera.k4: 0.0")));
}

TEST_F(CameraFormats, OfRosGiveTheSizeOfTheImage) {
  const Camera camera =
      Read(With(With(kRos, "width: 640", "width: 656"), "height: 480", "height: 496")).camera;
  EXPECT_EQ(camera.width, 656);
  EXPECT_EQ(camera.height, 496);
}

TEST_F(CameraFormats, NameTheKeyThatIsMissing) {
  ExpectError(kOrbSlam2, "DepthMapFactor: 5000.0", "", "key `DepthMapFactor` is missing");
  ExpectError(kOrbSlam2, "Camera.width: 640", "", "key `Camera.width` is missing");
  ExpectError(kOrbSlam3, "Camera1.fy:", "Camera1.focal:", "key `Camera1.fy` is missing");
  ExpectError(kOrbSlam3, "RGBD.DepthMapFactor: 5000.0", "",
              "key `RGBD.DepthMapFactor` is missing");
  ExpectError(kRos, "depth_factor: 5000", "", "key `depth_factor` is missing");
  ExpectError(kRos, "distortion_coefficients", "distortion",
              "key `distortion_coefficients.* is missing");
}

TEST_F(CameraFormats, RefuseACameraThatIsNoPinhole) {
  ExpectError(kOrbSlam3, "\"PinHole\"", "\"KannalaBrandt8\"",
              "yaml:3: Camera.type: expected one of: PinHole, .*found `KannalaBrandt8`");
  ExpectError(kOrbSlam2, "Camera.RGB: 1", "Camera.k4: 0.1", "Camera.k4: expected a lens of k1");
  ExpectError(kOrbSlam3, "Camera.RGB: 1", "Camera1.k4: 0.1",
              "Camera1.k4: expected a lens of k1");
  ExpectError(kOrbSlam3, "Camera.RGB: 1", "Camera1.k6: 0.1",
              "Camera1.k6: expected a lens of k1");
  ExpectError(kOrbSlam2, "Camera.RGB: 1", "Camera.k5: -0.1",
              "Camera.k5: expected a lens of k1");
  ExpectError(kRos, "plumb_bob", "equidistant", "distortion_model: expected one of: plumb_bob");
  ExpectError(kRos, "1.163314]", "1.163314, 0.5, 0, 0]", "more than the five coefficients");
  ExpectError(kRos, "[517.306408, 0,", "[517.306408, 3,",
              "camera_matrix: expected data: .fx, 0");
}

TEST_F(CameraFormats, RefuseNumbersThatNoCameraHas) {
  ExpectError(kOrbSlam2, "Camera.fx: 517.306408", "Camera.fx: -517",
              "yaml:7: Camera.fx: expected a number in .1, 100000., found `-517`");
  ExpectError(
      kOrbSlam2, "Camera.fy: 516.469215", "Camera.fy: -480.0",
      "Camera.fy: expected a number in .1, 100000., found `-480.0`; write it without the "
      "sign, and mirror groundtruth.txt");
  ExpectError(kOrbSlam2, "Camera.fy: 516.469215", "Camera.fy: 0.5",
              "Camera.fy: expected a number in .1, 100000., found `0.5`$");
  ExpectError(kOrbSlam2, "Camera.cx: 318", "Camera.cx: 918", "Camera.cx: the principal point");
}

// The last column of 640 ends at 639.5, the last row of 480 at 479.5.
TEST_F(CameraFormats, NameTheCoordinateOfAPrincipalPointJustOutsideTheImage) {
  ExpectError(kOrbSlam2, "Camera.cx: 318.643040", "Camera.cx: 639.6",
              "yaml:9: Camera.cx: the principal point");
  ExpectError(kOrbSlam2, "Camera.cy: 255.313989", "Camera.cy: 479.6",
              "yaml:10: Camera.cy: the principal point");
}

TEST_F(CameraFormats, OfRosAreHeldToTheSameLaws) {
  ExpectError(kRos, "318.643040", "918", "yaml:4: camera_matrix: the principal point");
  ExpectError(kRos, "[0.262383", "[-5", "yaml:6: distortion_coefficients: .* be inverted");
}

}  // namespace
}  // namespace slam
