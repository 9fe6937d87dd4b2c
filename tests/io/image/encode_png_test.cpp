#include "io/image/encode_png.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

namespace io {
namespace {

/// Flat on the left, noise on the right.
cv::Mat Picture(int type, int width, int height) {
  cv::Mat image(height, width, type);
  cv::RNG random(5);
  const std::size_t bytes = image.elemSize();
  for (int v = 0; v < height; ++v) {
    for (std::size_t i = 0; i < bytes * static_cast<std::size_t>(width); ++i) {
      const bool flat = i < bytes * static_cast<std::size_t>(width) / 2;
      image.ptr(v)[i] =
          flat ? static_cast<uchar>(i % bytes + 3) : static_cast<uchar>(random.uniform(0, 256));
    }
  }
  return image;
}

TEST(EncodePng, IsReadBackBitForBit) {
  for (const int type : {CV_8UC1, CV_8UC3, CV_16UC1}) {
    for (const auto& [width, height] : {std::pair{640, 480}, {37, 5}, {1, 1}, {1, 9}}) {
      const cv::Mat image = Picture(type, width, height);
      const std::string bytes = EncodePng(image);
      const cv::Mat read =
          cv::imdecode(std::vector<uchar>(bytes.begin(), bytes.end()), cv::IMREAD_UNCHANGED);
      ASSERT_EQ(read.type(), type) << width << " x " << height;
      ASSERT_EQ(read.size(), image.size());
      EXPECT_EQ(cv::norm(read, image, cv::NORM_INF), 0)
          << type << ": " << width << " x " << height;
    }
  }
}

TEST(EncodePng, OfAPartOfAnImageHoldsThatPart) {
  const cv::Mat part = Picture(CV_8UC3, 60, 40)(cv::Rect(20, 10, 31, 7));
  const std::string bytes = EncodePng(part);
  const cv::Mat read =
      cv::imdecode(std::vector<uchar>(bytes.begin(), bytes.end()), cv::IMREAD_UNCHANGED);
  EXPECT_EQ(cv::norm(read, part, cv::NORM_INF), 0);
}

TEST(EncodePng, IsRefusedForWhatItCannotHold) {
  EXPECT_THROW(EncodePng(cv::Mat()), std::invalid_argument);
  EXPECT_THROW(EncodePng(cv::Mat(3, 3, CV_32FC1)), std::invalid_argument);
  EXPECT_THROW(EncodePng(cv::Mat(3, 3, CV_16UC3)), std::invalid_argument);
}

}  // namespace
}  // namespace io
