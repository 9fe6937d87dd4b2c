#include "io/image/image_header.h"

#include <gtest/gtest.h>

#include <string>

#include "io/image/decode_image.h"
#include "tests/io/image/made_png.h"

namespace io {
namespace {

using namespace std::string_literals;

TEST(ImageHeader, OfAPngTellsTheSize) {
  const std::string png = "\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\x02\x80\0\1\xE0\0\x08\2\0\0\0"s;
  const auto header = ReadImageHeader(png);
  ASSERT_TRUE(header);
  EXPECT_EQ(header->width, 640);
  EXPECT_EQ(header->height, 122880);
  EXPECT_EQ(header->pixels, "8-bit RGB");
  EXPECT_FALSE(header->whole);
  EXPECT_TRUE(ReadImageHeader(png + "IEND\xAE\x42\x60\x82"s)->whole);
  EXPECT_FALSE(ReadImageHeader(png.substr(0, 20)));
}

// It is unfolded when it is decoded, so whoever wants colour can take it.
TEST(ImageHeader, OfAPaletteTellsItsColours) {
  for (const PngKind& kind : {kPalette, kPalette2}) {
    const std::string png = MadePng(kind, {});
    EXPECT_EQ(ReadImageHeader(png)->pixels, "8-bit RGB") << kind.bits;
    EXPECT_EQ(DecodeImage(png).type(), CV_8UC3) << kind.bits;
  }
}

TEST(ImageHeader, OfAJpegTellsTheSizeBehindItsOtherSegments) {
  const std::string begin = "\xFF\xD8\xFF\xE0\0\4ab\xFF\xFF\xC4\0\3x"s;
  const auto header = ReadImageHeader(begin + "\xFF\xC2\0\x11\x08\x01\xE0\x02\x80\3"s);
  ASSERT_TRUE(header);
  EXPECT_EQ(header->width, 640);
  EXPECT_EQ(header->height, 480);
  EXPECT_EQ(header->format, ImageFormat::kJpeg);
  EXPECT_EQ(header->pixels, "8-bit RGB");
  EXPECT_FALSE(ReadImageHeader(begin));
  EXPECT_FALSE(ReadImageHeader("\xFF\xD8\xFF\xE0\0\0"s));
}

TEST(ImageHeader, OfAJpegIsNotDeceivedByTheEndOfAThumbnail) {
  const std::string cut =
      "\xFF\xD8\xFF\xE1\0\6ab\xFF\xD9\xFF\xC2\0\x11\x08\x01\xE0\x02\x80\3"
      "abcdefghi\xFF\xDA\0\3x0123456789"s;
  ASSERT_TRUE(ReadImageHeader(cut));
  EXPECT_FALSE(ReadImageHeader(cut)->whole);
  EXPECT_TRUE(ReadImageHeader(cut + "\xFF\xD9"s)->whole);
}

TEST(ImageHeader, OfAnythingElseTellsNothing) {
  EXPECT_FALSE(ReadImageHeader(""));
  EXPECT_FALSE(ReadImageHeader("GIF89a"));
}

}  // namespace
}  // namespace io
