#include "slam/input/image_message.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <limits>

#include "io/input_error.h"

namespace slam {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

template <typename Number>
BagImage ImageMessage(const std::string& encoding, const std::vector<Number>& row) {
  BagImage image;
  image.width = 2, image.height = 1;
  image.encoding = encoding;
  image.step = row.size() * sizeof(Number);
  image.data.resize(image.step);
  std::memcpy(image.data.data(), row.data(), image.step);
  return image;
}

TEST(ImageMessage, OfEachColourEncodingIsBgr) {
  const auto first = [](const std::string& encoding, const std::vector<std::uint8_t>& row) {
    return BgrOf(ImageMessage(encoding, row), {2, 1}, "here")(0, 1);
  };
  EXPECT_EQ(first("rgb8", {0, 0, 0, 1, 2, 3}), cv::Vec3b(3, 2, 1));
  EXPECT_EQ(first("bgr8", {0, 0, 0, 1, 2, 3}), cv::Vec3b(1, 2, 3));
  EXPECT_EQ(first("rgba8", {0, 0, 0, 0, 1, 2, 3, 9}), cv::Vec3b(3, 2, 1));
  EXPECT_EQ(first("bgra8", {0, 0, 0, 0, 1, 2, 3, 9}), cv::Vec3b(1, 2, 3));
  EXPECT_EQ(first("mono8", {0, 7}), cv::Vec3b(7, 7, 7));
  EXPECT_EQ(first("8UC3", {0, 0, 0, 1, 2, 3}), cv::Vec3b(1, 2, 3));
  EXPECT_EQ(first("8UC1", {0, 7}), cv::Vec3b(7, 7, 7));
}

TEST(ImageMessage, OfDepthIsInMetresAndZeroWhereNothingWasMeasured) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinite = std::numeric_limits<float>::infinity();
  const cv::Mat1f metres =
      DepthOf(ImageMessage<float>("32FC1", {1.25f, nan}), {2, 1}, 0, "here");
  EXPECT_EQ(metres(0, 0), 1.25f);
  EXPECT_EQ(metres(0, 1), 0.0f);
  EXPECT_EQ(DepthOf(ImageMessage<float>("32FC1", {infinite, 1}), {2, 1}, 0, "here")(0, 0), 0);
  const cv::Mat1f units =
      DepthOf(ImageMessage<std::uint16_t>("16UC1", {1500, 65535}), {2, 1}, 1000, "here");
  EXPECT_EQ(units(0, 0), 1.5f);
  EXPECT_EQ(units(0, 1), 0.0f);
  const cv::Mat1f mono =
      DepthOf(ImageMessage<std::uint16_t>("mono16", {0, 2500}), {2, 1}, 1000, "here");
  EXPECT_EQ(mono(0, 1), 2.5f);
}

TEST(ImageMessage, RowsMayBePadded) {
  BagImage image = ImageMessage<std::uint8_t>("mono8", {1, 2, 99, 99, 3, 4});
  image.height = 2, image.step = 4;
  EXPECT_EQ(BgrOf(image, {2, 2}, "here")(1, 0), cv::Vec3b(3, 3, 3));
}

TEST(ImageMessage, WithTooFewBytesOrOfAnotherSizeOrKindIsRefused) {
  const auto refused = [](const std::string& what) {
    return ThrowsMessage<io::InputError>(HasSubstr(what));
  };
  BagImage cut = ImageMessage<std::uint8_t>("rgb8", {1, 2, 3, 4, 5});
  EXPECT_THAT([&] { BgrOf(cut, {2, 1}, "here"); }, refused("here: the image has 5 bytes"));
  cut.step = std::numeric_limits<std::size_t>::max();
  EXPECT_THAT([&] { BgrOf(cut, {2, 1}, "here"); }, refused("too few"));
  EXPECT_THAT(
      [&] {
        BgrOf(cut, {3, 1}, "here");
      },
      refused("the image is 2 x 1, the camera says 3 x 1"));
  EXPECT_THAT(
      [&] {
        BgrOf(ImageMessage<std::uint8_t>("mono8", {1, 2}), {2, 2}, "here");
      },
      refused("the image is 2 x 1, the camera says 2 x 2"));
  cut.encoding = "yuv422";
  EXPECT_THAT([&] { BgrOf(cut, {2, 1}, "here"); }, refused("the encoding is `yuv422`"));
  EXPECT_THAT([&] { DepthOf(cut, {2, 1}, 1000, "here"); }, refused("expected 32FC1"));
  BagImage swapped = ImageMessage<std::uint16_t>("16UC1", {1, 2});
  swapped.big_endian = true;
  EXPECT_THAT([&] { DepthOf(swapped, {2, 1}, 1000, "here"); }, refused("big-endian"));
}

TEST(ImageMessage, OfSingleBytesHasNoOrderOfBytes) {
  BagImage image = ImageMessage<std::uint8_t>("mono8", {5, 6});
  image.big_endian = true;
  EXPECT_EQ(BgrOf(image, {2, 1}, "here")(0, 1), cv::Vec3b(6, 6, 6));
}

TEST(ImageMessage, WhoseRowsBeginWithinASampleIsRefused) {
  BagImage image = ImageMessage<std::uint16_t>("16UC1", {1, 2, 3, 4, 5});
  image.height = 2, image.step = 5;  // two samples and half a one
  EXPECT_THAT(
      [&] {
        DepthOf(image, {2, 2}, 1000, "here");
      },
      ThrowsMessage<io::InputError>(HasSubstr("no whole number of samples of 16UC1")));
}

}  // namespace
}  // namespace slam
