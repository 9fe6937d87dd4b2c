#include "io/image/decode_image.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "tests/io/image/made_png.h"
#include "tests/io/image/opencv_image.h"

namespace io {
namespace {

/// Smooth, with some noise.
cv::Mat3b Photograph(int width, int height) {
  cv::RNG random(3);
  cv::Mat3b image(height, width);
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      const auto grey = [&](int at) {
        return cv::saturate_cast<uchar>(at % 256 + random.uniform(0, 20));
      };
      image(v, u) = {grey(2 * u), grey(3 * v), grey(u + v)};
    }
  }
  return image;
}

std::string Jpeg(const cv::Mat& image, const std::vector<int>& options = {}) {
  std::vector<uchar> bytes;
  cv::imencode(".jpg", image, bytes, options);
  return {bytes.begin(), bytes.end()};
}

void ExpectDecodedAsOpenCv(const std::string& file, int mode, const std::string& what) {
  ExpectAsOpenCvHasIt(DecodeImage(file), file, mode, what);
}

TEST(DecodeImage, UnfoldsEveryKindOfPngAsAnotherDecoderDoes) {
  for (const PngKind& kind :
       {kRgb, kRgb16, kGray16, kGray8, kGray4, kGray1, kPalette, kPalette2, kRgba}) {
    for (const bool interlaced : {false, true}) {
      for (const auto& [width, height] : {std::pair{37, 23}, {1, 1}, {3, 9}}) {
        ExpectDecodedAsOpenCv(
            MadePng(kind, {.width = width, .height = height, .interlaced = interlaced}),
            cv::IMREAD_UNCHANGED,
            std::to_string(kind.bits) + " bits, colour " + std::to_string(kind.colour) +
                (interlaced ? ", interlaced" : ""));
      }
    }
  }
}

TEST(DecodeImage, TakesAColourThatStandsForNothingAsAnyOther) {
  for (const auto& [kind, bytes] : {std::pair{kRgb, 6}, {kGray16, 2}, {kGray8, 2}}) {
    const cv::Mat plain = DecodeImage(MadePng(kind, {}));
    const cv::Mat image = DecodeImage(MadePng(kind, {.extra = "tRNS", .extra_bytes = bytes}));
    ASSERT_EQ(image.type(), plain.type());
    EXPECT_EQ(cv::norm(image, plain, cv::NORM_INF), 0);
  }
}

TEST(DecodeImage, ReadsAJpegAsColourAsAnotherDecoderDoes) {
  for (const auto& [width, height] : {std::pair{64, 48}, {37, 23}, {1, 1}, {17, 8}}) {
    const cv::Mat3b image = Photograph(width, height);
    cv::Mat1b gray;
    cv::extractChannel(image, gray, 1);
    const std::string size = std::to_string(width) + " x " + std::to_string(height);
    ExpectDecodedAsOpenCv(Jpeg(image), cv::IMREAD_COLOR, size);
    ExpectDecodedAsOpenCv(Jpeg(image, {cv::IMWRITE_JPEG_QUALITY, 30}), cv::IMREAD_COLOR, size);
    ExpectDecodedAsOpenCv(Jpeg(image, {cv::IMWRITE_JPEG_PROGRESSIVE, 1}), cv::IMREAD_COLOR,
                          size);
    ExpectDecodedAsOpenCv(Jpeg(gray), cv::IMREAD_COLOR, size + " gray");
  }
}

TEST(DecodeImage, TurnsNoJpegByWhatItSaysOfTheCamera) {
  using namespace std::string_literals;
  const std::string jpeg = Jpeg(Photograph(64, 48));
  // Exif, one entry: orientation (0x0112), a short, 6: turned by 90 degrees.
  const std::string exif =
      "\xFF\xE1\0\x22"
      "Exif\0\0MM\0*\0\0\0\x08\0\1\x01\x12\0\3\0\0\0\1\0\6\0\0\0\0\0\0"s;
  const std::string turned = jpeg.substr(0, 2) + exif + jpeg.substr(2);
  ASSERT_EQ(
      cv::imdecode(std::vector<uchar>(turned.begin(), turned.end()), cv::IMREAD_COLOR).size(),
      cv::Size(48, 64));
  EXPECT_EQ(DecodeImage(turned).size(), cv::Size(64, 48));
}

TEST(DecodeImage, IsEmptyForWhatIsDamagedOrNoImage) {
  EXPECT_TRUE(DecodeImage("").empty());
  EXPECT_TRUE(DecodeImage("GIF89a").empty());
  const std::string jpeg = Jpeg(Photograph(64, 48));
  ASSERT_FALSE(DecodeImage(jpeg).empty());
  EXPECT_TRUE(DecodeImage(jpeg.substr(0, 100)).empty());
  EXPECT_TRUE(DecodeImage(jpeg.substr(2)).empty());
  for (const PngKind& kind : {kRgb, kPalette}) {
    std::string png = MadePng(kind, {});
    EXPECT_TRUE(DecodeImage(png.substr(0, png.size() / 2)).empty());
    png[png.size() / 2] = static_cast<char>(png[png.size() / 2] ^ 0x10);
    EXPECT_TRUE(DecodeImage(png).empty());
  }
}

}  // namespace
}  // namespace io
