#include "io/image_header.h"

#include <gtest/gtest.h>

#include <string>

namespace io {
namespace {

using namespace std::string_literals;

TEST(ImageHeader, OfAPngTellsTheSize) {
  const std::string png = "\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\x02\x80\0\1\xE0\0\x08\2\0\0\0"s;
  const auto size = ImageSizeOf(png);
  ASSERT_TRUE(size);
  EXPECT_EQ(size->width, 640);
  EXPECT_EQ(size->height, 122880);
  EXPECT_FALSE(ImageSizeOf(png.substr(0, 20)));
}

TEST(ImageHeader, OfAJpegTellsTheSizeBehindItsOtherSegments) {
  const std::string begin = "\xFF\xD8\xFF\xE0\0\4ab\xFF\xFF\xC4\0\3x"s;
  const auto size = ImageSizeOf(begin + "\xFF\xC2\0\x11\x08\x01\xE0\x02\x80\3"s);
  ASSERT_TRUE(size);
  EXPECT_EQ(size->width, 640);
  EXPECT_EQ(size->height, 480);
  EXPECT_FALSE(ImageSizeOf(begin));
  EXPECT_FALSE(ImageSizeOf("\xFF\xD8\xFF\xE0\0\0"s));
}

TEST(ImageHeader, OfAJpegIsNotDeceivedByTheEndOfAThumbnail) {
  const std::string cut =
      "\xFF\xD8\xFF\xE1\0\6ab\xFF\xD9\xFF\xC2\0\x11\x08\x01\xE0\x02\x80\3"
      "abcdefghi\xFF\xDA\0\3x0123456789"s;
  ASSERT_TRUE(ImageSizeOf(cut));
  EXPECT_FALSE(ImageSizeOf(cut)->whole);
  EXPECT_TRUE(ImageSizeOf(cut + "\xFF\xD9"s)->whole);
}

TEST(ImageHeader, OfAnythingElseTellsNothing) {
  EXPECT_FALSE(ImageSizeOf(""));
  EXPECT_FALSE(ImageSizeOf("GIF89a"));
}

}  // namespace
}  // namespace io
