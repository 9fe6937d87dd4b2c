#include "eval/formats/sequence/images.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>

#include "tests/eval/check/small_world.h"
#include "tests/support/refusal.h"

namespace eval {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class ColourImageFile : public ::testing::Test {
 protected:
  std::string WhyRefused(const std::string& bytes) const {
    const fs::path file = folder_.path() / "colour.png";
    small_world::WriteText(file, bytes);
    const std::string why = test_support::RefusalOf([&] { ReadColour(file); });
    if (!why.empty()) {
      EXPECT_THAT(why, HasSubstr(file.string()));
    }
    return why;
  }
  std::string Encoded(const char* extension) const {
    std::vector<uchar> bytes;
    cv::imencode(extension, image_, bytes);
    return {bytes.begin(), bytes.end()};
  }
  small_world::TemporaryFolder folder_;
  cv::Mat image_{cv::Size(32, 24), CV_8UC3, cv::Scalar(40, 120, 200)};
};

TEST_F(ColourImageFile, IsReadAsPngAndAsJpeg) {
  for (const char* extension : {".png", ".jpg"}) {
    EXPECT_EQ(WhyRefused(Encoded(extension)), "");
    const cv::Mat read = ReadColour(folder_.path() / "colour.png");
    ASSERT_EQ(read.size(), image_.size());
    ASSERT_EQ(read.type(), CV_8UC3);
    EXPECT_LT(cv::norm(read, image_, cv::NORM_INF), 4);
  }
}

TEST_F(ColourImageFile, MayBeGrayOrHaveAlpha) {
  const auto read = [&](const cv::Mat& image) {
    std::vector<uchar> png;
    cv::imencode(".png", image, png);
    EXPECT_EQ(WhyRefused({png.begin(), png.end()}), "");
    return ReadColour(folder_.path() / "colour.png");
  };
  const cv::Mat gray = read(cv::Mat(24, 32, CV_8UC1, cv::Scalar(90)));
  EXPECT_EQ(cv::norm(gray, cv::Mat(24, 32, CV_8UC3, cv::Scalar(90, 90, 90)), cv::NORM_INF), 0);
  const cv::Mat colour = read(cv::Mat(24, 32, CV_8UC4, cv::Scalar(40, 120, 200, 7)));
  EXPECT_EQ(cv::norm(colour, image_, cv::NORM_INF), 0);
}

TEST_F(ColourImageFile, MayHaveMoreBehindTheEndOfAJpeg) {
  EXPECT_EQ(WhyRefused(Encoded(".jpg") + "written by the camera"), "");
  const std::string jpeg = Encoded(".jpg");
  EXPECT_THAT(WhyRefused(jpeg.substr(0, jpeg.size() - 2)), HasSubstr("is damaged"));
}

TEST_F(ColourImageFile, IsRefusedWhenItIsNoImageOrBroken) {
  EXPECT_THAT(WhyRefused(""), HasSubstr("is no PNG or JPEG image"));
  EXPECT_THAT(WhyRefused("GIF89a and more that is none"), HasSubstr("is no PNG or JPEG image"));
  EXPECT_THAT(WhyRefused(Encoded(".png").substr(0, 50)), HasSubstr("is damaged"));
}

TEST_F(ColourImageFile, IsRefusedBeforeItIsDecodedWhenItSaysThatItIsHuge) {
  std::string png = Encoded(".png");
  png[16] = 0, png[17] = 1, png[20] = 0, png[21] = 1;  // more than 65536 x 65536
  EXPECT_THAT(WhyRefused(png), HasSubstr("65568 x 65560 pixels"));
  std::string jpeg = Encoded(".jpg");
  const std::size_t frame = jpeg.find("\xff\xc0");
  ASSERT_NE(frame, std::string::npos);
  for (std::size_t i = 5; i < 9; ++i) jpeg[frame + i] = '\xff';
  EXPECT_THAT(WhyRefused(jpeg), HasSubstr("65535 x 65535 pixels"));
}

}  // namespace
}  // namespace eval
