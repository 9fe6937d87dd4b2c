#include "slam/input/image_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <string_view>

#include "io/input_error.h"
#include "tests/support/temporary_folder.h"

namespace slam {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

class ImageFiles : public ::testing::Test {
 protected:
  ImageFiles() { camera_.width = 32, camera_.height = 24; }
  cv::Mat3b Colour() { return ReadImage(file_, ImageType::kColour, camera_, "frame 0"); }
  void Write(const cv::Mat& image) { cv::imwrite(file_.string(), image); }
  void WriteBytes(std::string_view bytes) {
    std::ofstream(file_, std::ios::binary) << bytes << std::string(100, 'x');
  }
  void ExpectRefusal(ImageType type, const std::string& what) {
    EXPECT_THAT([&] { ReadImage(file_, type, camera_, "frame 0"); },
                ThrowsMessage<io::InputError>(HasSubstr(what)));
  }

  test_support::TemporaryFolder folder_;
  const std::filesystem::path file_ = folder_ / "image.png";
  Camera camera_;
};

TEST_F(ImageFiles, OfGrayAreColourWithoutAny) {
  cv::Mat1b gray(24, 32, uchar{90});
  gray(3, 4) = 17;
  Write(gray);
  EXPECT_EQ(Colour()(3, 4), cv::Vec3b(17, 17, 17));
  EXPECT_EQ(Colour()(5, 6), cv::Vec3b(90, 90, 90));
}

TEST_F(ImageFiles, OfGrayMayBeJpeg) {
  std::vector<unsigned char> jpeg;
  cv::imencode(".jpg", cv::Mat1b(24, 32, uchar{90}), jpeg);
  std::ofstream(file_, std::ios::binary)
      .write(reinterpret_cast<const char*>(jpeg.data()),
             static_cast<std::streamsize>(jpeg.size()));
  EXPECT_EQ(Colour()(5, 6), cv::Vec3b(90, 90, 90));
}

TEST_F(ImageFiles, WithAlphaAreReadAsIfItWereNotThere) {
  Write(cv::Mat(24, 32, CV_8UC4, cv::Scalar(1, 2, 3, 0)));
  EXPECT_EQ(Colour()(5, 6), cv::Vec3b(1, 2, 3));
}

TEST_F(ImageFiles, OfAnotherSizeAreRefusedWithWhatToDo) {
  Write(cv::Mat3b(24, 30));
  ExpectRefusal(ImageType::kColour, "the image is 30 x 24, the camera says 32 x 24; mend the");
  Write(cv::Mat1w(12, 16));
  ExpectRefusal(ImageType::kDepth,
                "the image is 16 x 12, the camera says 32 x 24; depth must lie on colour");
  Write(cv::Mat3b(32, 24));
  ExpectRefusal(ImageType::kColour,
                "the image is 24 x 32, the camera says 32 x 24; one of the two is turned");
}

TEST_F(ImageFiles, OfColourWithSixteenBitsAreRefusedWithWhatToDo) {
  Write(cv::Mat(24, 32, CV_16UC3, cv::Scalar(1, 2, 3)));
  ExpectRefusal(ImageType::kColour,
                "is 16-bit RGB, expected 8-bit RGB or gray; save it with 8");
  ExpectRefusal(ImageType::kDepth, "is 16-bit RGB, expected 16-bit gray");
}

// As associations of ICL-NUIM have them: depth first.
TEST_F(ImageFiles, OfTheOtherKindAskWhetherTheListIsSwapped) {
  Write(cv::Mat1w(24, 32, std::uint16_t{1000}));
  ExpectRefusal(ImageType::kColour, "it looks like depth: are colour and depth swapped");
  Write(cv::Mat3b(24, 32, cv::Vec3b(1, 2, 3)));
  ExpectRefusal(ImageType::kDepth, "it looks like colour: are colour and depth swapped");
}

TEST_F(ImageFiles, OfDepthWithEightBitsAreRefusedWithWhatToDo) {
  Write(cv::Mat1b(24, 32, uchar{90}));
  ExpectRefusal(ImageType::kDepth,
                "is 8-bit gray, expected 16-bit gray (depth_factor units a metre); 8 bits are");
}

// The header alone is looked at: RGB with its colours counted as four.
TEST_F(ImageFiles, OfFourInksAreRefusedWithWhatToDo) {
  std::vector<unsigned char> jpeg;
  cv::imencode(".jpg", cv::Mat3b(24, 32, cv::Vec3b(1, 2, 3)), jpeg);
  std::string bytes(jpeg.begin(), jpeg.end());
  const std::size_t frame = bytes.find("\xFF\xC0");
  ASSERT_NE(frame, std::string::npos);
  bytes[frame + 9] = 4;
  WriteBytes(bytes);
  ExpectRefusal(ImageType::kColour,
                "is 8-bit CMYK, expected 8-bit RGB or gray; save it as RGB");
}

TEST_F(ImageFiles, OfOtherFormatsAreNamed) {
  using namespace std::string_view_literals;
  WriteBytes("II*\0"sv);
  ExpectRefusal(ImageType::kDepth, "is a TIFF, not a PNG image; convert it: depth must be");
  ExpectRefusal(ImageType::kColour, "is a TIFF, not a PNG or JPEG image; convert it: colour");
  WriteBytes("\x76\x2F\x31\x01"sv);
  ExpectRefusal(ImageType::kDepth, "is an OpenEXR image, not a PNG image; convert it");
  WriteBytes("\x93NUMPY"sv);
  ExpectRefusal(ImageType::kDepth, "is a NumPy array, not a PNG image; convert it");
  WriteBytes("text");
  ExpectRefusal(ImageType::kDepth, "not a PNG image (or cut off in its header)");
}

}  // namespace
}  // namespace slam
