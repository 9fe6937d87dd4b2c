#include "slam/input/bag_images.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/input_error.h"
#include "slam/input/bag_camera.h"
#include "tests/support/bag_writer.h"
#include "tests/support/program.h"

namespace slam {
namespace {

using bags::BagWriter;
using bags::Compression;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

const std::string kDepthStream = "/device_0/sensor_0/Depth_0/";
const std::string kColourStream = "/device_0/sensor_1/Color_0/";

class Bags : public ::testing::Test {
 protected:
  std::string File() const { return folder_ / "a.bag"; }
  static cv::Mat3b Colour() { return cv::Mat3b(48, 64, cv::Vec3b(1, 2, 3)); }
  static cv::Mat1w Depth() { return cv::Mat1w(48, 64, std::uint16_t{1000}); }
  void WriteInfo(BagWriter& bag, const std::string& topic,
                 const std::string& lens = "plumb_bob",
                 const std::vector<double>& d = {}) const {
    bag.CameraInfo(topic, {64, 48}, {60, 60, 31.5, 23.5}, lens, d);
  }
  void WriteRealSense(const std::array<double, 3>& t_colour,
                      const std::string& tf_colour = "tf/0") const {
    BagWriter bag(File(), Compression::kNone);
    for (const std::string& stream : {kDepthStream, kColourStream}) {
      WriteInfo(bag, stream + "info/camera_info", "Inverse Brown Conrady", {0, 0, 0, 0, 0});
    }
    bag.Transform(kDepthStream + "tf/0", {0, 0, 0}, {0, 0, 0, 1});
    bag.Transform(kColourStream + tf_colour, t_colour, {0, 0, 0, 1});
    cv::Mat1w depth = Depth();
    depth.col(40) = 0;
    bag.Image(kDepthStream + "image/data", 1, "0", "mono16", depth);
    bag.Image(kColourStream + "image/data", 1, "0", "rgb8", Colour());
  }
  program::TemporaryFolder folder_;
};

TEST_F(Bags, OfRealSenseHaveDepthLaidOnColour) {
  WriteRealSense({-0.05, 0, 0});  // three pixels at 1 m
  const cv::Mat1f laid = BagImages(File(), CameraOfBag(File())).Depth(0);
  EXPECT_EQ(laid(10, 37), 0.0f);
  EXPECT_EQ(laid(10, 36), 1.0f);
  EXPECT_EQ(laid(10, 38), 1.0f);
  EXPECT_EQ(laid(10, 62), 0.0f);
  WriteRealSense({0, 0, 0});
  EXPECT_EQ(BagImages(File(), CameraOfBag(File())).Depth(0)(10, 40), 0.0f);
}

// Ways from two cameras of the device say nothing of how depth and colour lie to each other.
TEST_F(Bags, OfRealSenseAreRefusedWhoseStreamsKnowNoReferenceInCommon) {
  WriteRealSense({-0.05, 0, 0}, "tf/1");
  EXPECT_THAT([&] { BagImages(File(), CameraOfBag(File())); },
              ThrowsMessage<io::InputError>(HasSubstr("tf/N of both, with one N")));
}

TEST_F(Bags, PairByTheStampsOfTheHeadersInTheirOrder) {
  {
    BagWriter bag(File(), Compression::kNone);
    for (const double t : {1.0, 2.0, 1.5, 3.0, 3.0}) {
      bag.Image("/rgb/image_raw", t, "c", "rgb8", Colour());
    }
    for (const double t : {1.005, 2.03, 1.49, 3.0}) {
      bag.Image("/depth_to_rgb/image_raw", t, "c", "16UC1", Depth());
    }
    WriteInfo(bag, "/rgb/camera_info");
  }
  const BagImages images(File(), CameraOfBag(File()));
  std::vector<double> stamps_s, depth_s;
  for (const SequenceEntry& entry : images.index().entries) {
    stamps_s.push_back(entry.timestamp_s);
    depth_s.push_back(entry.depth_timestamp_s);
  }
  EXPECT_THAT(stamps_s, ElementsAre(1.0, 1.5, 3.0));
  EXPECT_THAT(depth_s, ElementsAre(1.005, 1.49, 3.0));
  EXPECT_THAT(images.index().warnings,
              ElementsAre(HasSubstr("1 of 5 images of /rgb/image_raw"),
                          HasSubstr("1 of 4 colour images (first /rgb/image_raw, image 1)")));
}

TEST_F(Bags, WithSeveralTopicsReadTheRegisteredDepthOfTheColourCameraAndSaySo) {
  {
    BagWriter bag(File(), Compression::kNone);
    bag.Image("/camera/color/image_raw", 1, "colour", "rgb8", Colour());
    bag.Image("/camera/infra1/image_rect_raw", 1, "depth", "mono8", cv::Mat1b(48, 64, uchar{}));
    bag.Image("/camera/depth/image_rect_raw", 1, "depth", "16UC1", Depth());
    bag.Image("/camera/aligned_depth_to_color/image_raw", 1, "colour", "16UC1", 2 * Depth());
    WriteInfo(bag, "/camera/color/camera_info");
  }
  const BagImages images(File(), CameraOfBag(File()));
  EXPECT_EQ(images.Depth(0)(0, 0), 2.0f);
  EXPECT_THAT(images.index().warnings,
              ElementsAre(HasSubstr("and not /camera/depth/image_rect_raw (16UC1)")));
}

TEST_F(Bags, ShowTheImageOfItsStampWhereMessagesCameOutOfOrder) {
  {
    BagWriter bag(File(), Compression::kNone);
    for (const double stamp_s : {1.0, 3.0, 2.0}) {
      bag.Image("/color/image_raw", stamp_s, "colour", "rgb8", Colour());
      bag.Image("/depth/registered/image", stamp_s, "colour", "16UC1", stamp_s * Depth());
    }
    WriteInfo(bag, "/color/camera_info");
  }
  const BagImages images(File(), CameraOfBag(File()));
  for (int frame = 0; frame < 3; ++frame)
    EXPECT_EQ(images.Depth(static_cast<std::size_t>(frame))(0, 0),
              1.0f + static_cast<float>(frame));
}

TEST_F(Bags, ReadTheDepthOfColoursCameraOfTwo) {
  {
    BagWriter bag(File(), Compression::kNone);
    bag.Image("/cam1/color/image_raw", 1, "one", "rgb8", Colour());
    bag.Image("/cam2/depth/image_raw", 1, "one", "16UC1", Depth());
    bag.Image("/cam1/depth/image_raw", 1, "one", "16UC1", 2 * Depth());
    WriteInfo(bag, "/cam1/color/camera_info");
  }
  EXPECT_EQ(BagImages(File(), CameraOfBag(File())).Depth(0)(0, 0), 2.0f);
}

// A driver's first message may lack its stamp; the others have theirs.
TEST_F(Bags, TakeTheTimeOfRecordingOnlyWhereNoHeaderHasOne) {
  for (const double first_s : {0.0, 1.0}) {
    {
      BagWriter bag(File(), Compression::kNone);
      for (const double stamp_s : {first_s, 2.0, 3.0}) {
        bag.Image("/color/image_raw", stamp_s, "colour", "rgb8", Colour());
        bag.Image("/depth/registered/image", stamp_s, "colour", "16UC1", Depth());
      }
      WriteInfo(bag, "/color/camera_info");
    }
    const BagImages images(File(), CameraOfBag(File()));
    EXPECT_EQ(images.index().entries.back().timestamp_s, 3.0) << first_s;
  }
}

TEST_F(Bags, TakeWordsOfANameForWhatTheySay) {
  {
    BagWriter bag(File(), Compression::kNone);
    bag.Image("/camera/color/image_raw", 1, "colour", "rgb8", Colour());
    bag.Image("/camera/depth_unregistered/image", 1, "depth", "16UC1", Depth());
    bag.Image("/camera/depth/registered/image", 1, "colour", "16UC1", 2 * Depth());
    for (double stamp_s : {1.0, 2.0}) {
      bag.Image("/camera/left_ir/image_raw", stamp_s, "colour", "mono16", 3 * Depth());
      bag.Image("/Camera/IR1/image_raw", stamp_s, "colour", "mono16", 3 * Depth());
    }
    bag.Image("/souvenir/air/image_raw", 1, "other", "16UC1", Depth());  // no infrared
    WriteInfo(bag, "/camera/color/camera_info");
  }
  const BagImages images(File(), CameraOfBag(File()));
  EXPECT_EQ(images.Depth(0)(0, 0), 2.0f);
  EXPECT_THAT(images.index().warnings,
              ElementsAre(::testing::AllOf(
                  HasSubstr("/camera/depth_unregistered/image (16UC1)"),
                  HasSubstr("/souvenir/air/image_raw (16UC1)"),
                  ::testing::Not(HasSubstr("left_ir")), ::testing::Not(HasSubstr("IR1")))));
}

// The same pinhole, but colour goes through a lens: depth has to be laid on it all the same.
TEST_F(Bags, OfRealSenseWhoseLensesDifferHaveDepthLaidOnColour) {
  {
    BagWriter bag(File(), Compression::kNone);
    WriteInfo(bag, kDepthStream + "info/camera_info");
    WriteInfo(bag, kColourStream + "info/camera_info", "plumb_bob", {0.3, 0, 0, 0, 0});
    for (const std::string& stream : {kDepthStream, kColourStream})
      bag.Transform(stream + "tf/0", {0, 0, 0}, {0, 0, 0, 1});
    cv::Mat1w depth = Depth();
    depth.col(60) = 2000;
    bag.Image(kDepthStream + "image/data", 1, "0", "mono16", depth);
    bag.Image(kColourStream + "image/data", 1, "0", "rgb8", Colour());
  }
  // x = 28.5 / 60 ahead; the lens moves it outwards by 0.3 x^3 of 60 px, by 1.9 px.
  const cv::Mat1f laid = BagImages(File(), CameraOfBag(File())).Depth(0);
  EXPECT_EQ(laid(24, 60), 1.0f);
  EXPECT_EQ(laid(24, 62), 2.0f);
}

TEST_F(Bags, TurnRealSensesInverseLensIntoBrowns) {
  // As of a D455's colour camera; the inverse polynomial takes recorded to ideal.
  const std::vector<double> d{-0.055, 0.066, 0.0007, -0.0004, -0.021};
  {
    BagWriter bag(File(), Compression::kNone);
    bag.Image("/rgb/image_raw", 1, "c", "rgb8", Colour());
    bag.Image("/depth/image_raw", 1, "c", "16UC1", Depth());
    WriteInfo(bag, "/rgb/camera_info", "Inverse Brown Conrady", d);
  }
  const Camera camera = CameraOfBag(File());
  for (const auto& [u, v] : {std::pair(0, 0), std::pair(63, 10), std::pair(20, 47)}) {
    const double x = (u - 31.5) / 60, y = (v - 23.5) / 60, r2 = x * x + y * y;
    const double f = 1 + r2 * (d[0] + r2 * (d[1] + r2 * d[4]));
    const Eigen::Vector2d ideal(x * f + 2 * d[2] * x * y + d[3] * (r2 + 2 * x * x),
                                y * f + 2 * d[3] * x * y + d[2] * (r2 + 2 * y * y));
    const Eigen::Vector2d back = camera.ProjectDistorted({ideal.x(), ideal.y(), 1});
    EXPECT_NEAR(back.x(), u, 0.05);
    EXPECT_NEAR(back.y(), v, 0.05);
  }
}

TEST_F(Bags, OfRectifiedImagesHaveTheirCameraWithoutTheLensThatWasTakenOut) {
  for (const char* name : {"image_raw", "image_rect_color"}) {
    const bool rectified = name != std::string("image_raw");
    {
      BagWriter bag(File(), Compression::kNone);
      bag.Image(std::string("/rgb/") + name, 1, "c", "rgb8", Colour());
      bag.Image("/depth/image_raw", 1, "c", "16UC1", Depth());
      bag.CameraInfo("/rgb/camera_info", {64, 48}, {60, 61, 31.5, 23.5}, "plumb_bob",
                     {-0.05, 0, 0, 0, 0}, {58, 59, 32, 24});
    }
    const Camera camera = CameraOfBag(File());
    const Eigen::Vector4d k(camera.fx, camera.fy, camera.cx, camera.cy);
    EXPECT_EQ(
        k, rectified ? Eigen::Vector4d(58, 59, 32, 24) : Eigen::Vector4d(60, 61, 31.5, 23.5));
    EXPECT_EQ(camera.k1, rectified ? 0.0 : -0.05);
  }
}

// The camera is checked as a file's is, but there is no file whose line could be mended.
TEST_F(Bags, NameTheTopicAndNoLineOfACameraThatIsNone) {
  {
    BagWriter bag(File(), Compression::kNone);
    bag.Image("/rgb/image_raw", 1, "c", "rgb8", Colour());
    bag.Image("/depth/image_raw", 1, "c", "16UC1", Depth());
    bag.CameraInfo("/rgb/camera_info", {64, 48}, {0, 60, 31.5, 23.5}, "plumb_bob", {});
  }
  EXPECT_THAT(
      [&] { CameraOfBag(File()); },
      ThrowsMessage<io::InputError>(HasSubstr("a.bag (/rgb/camera_info): fx: expected")));
}

TEST_F(Bags, RefuseOtherLensesAndImpossibleCameras) {
  for (const auto& [lens, expected] :
       {std::pair("equidistant", "the lens is `equidistant`"),
        std::pair("plumb_bob", "the distortion k1 k2 p1 p2 k3 cannot be inverted")}) {
    {
      BagWriter bag(File(), Compression::kNone);
      bag.Image("/rgb/image_raw", 1, "c", "rgb8", Colour());
      bag.Image("/depth/image_raw", 1, "c", "16UC1", Depth());
      WriteInfo(bag, "/rgb/camera_info", lens, {-9, 0, 0, 0, 0});
    }
    EXPECT_THAT([&] { CameraOfBag(File()); },
                ThrowsMessage<io::InputError>(HasSubstr(expected)));
  }
}

}  // namespace
}  // namespace slam
