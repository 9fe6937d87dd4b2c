#include "io/image/png_pixels.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <string>

#include "tests/io/image/made_png.h"
#include "tests/io/image/opencv_image.h"

namespace io {
namespace {

void ExpectUnfilteredAsOpenCv(const std::string& file, const std::string& what) {
  ExpectAsOpenCvHasIt(PngPixels(file), file, cv::IMREAD_UNCHANGED, what);
}

TEST(PngPixels, AreThoseOfAnotherDecoderWhateverTheFilter) {
  for (const PngKind& kind : {kRgb, kGray16, kGray8}) {
    for (int filter = -1; filter < 5; ++filter) {
      for (const auto& [width, height] : {std::pair{37, 23}, {1, 1}, {640, 7}, {2, 9}}) {
        ExpectUnfilteredAsOpenCv(
            MadePng(kind, {.width = width, .height = height, .filter = filter}),
            std::to_string(kind.bits) + " bits, filter " + std::to_string(filter));
      }
    }
  }
}

TEST(PngPixels, AreReadFromManyChunksAndBesideOthers) {
  ExpectUnfilteredAsOpenCv(MadePng(kRgb, {.parts = 5}), "parts");
  ExpectUnfilteredAsOpenCv(MadePng(kGray16, {.extra = "teXt"}), "a text");
}

TEST(PngPixels, AreLeftToOtherDecodersWhereTheyMeanSomethingElse) {
  EXPECT_TRUE(PngPixels(MadePng(kRgba, {})).empty());
  EXPECT_TRUE(PngPixels(MadePng(kRgb16, {})).empty());
  EXPECT_TRUE(PngPixels(MadePng(kPalette, {})).empty());
  EXPECT_TRUE(PngPixels(MadePng(kGray4, {})).empty());
  EXPECT_TRUE(PngPixels(MadePng(kRgb, {.interlaced = true})).empty());
  EXPECT_TRUE(PngPixels(MadePng(kRgb, {.extra = "tRNS"})).empty());
  EXPECT_TRUE(PngPixels(MadePng(kRgb, {.extra = "PLTE"})).empty());
  EXPECT_TRUE(PngPixels(MadePng(kRgb, {.filter = 5})).empty());
}

TEST(PngPixels, AreNoneOfAFileThatIsNotWhole) {
  const std::string file = MadePng(kRgb, {});
  ASSERT_FALSE(PngPixels(file).empty());
  for (std::size_t length = 0; length < file.size(); ++length)
    ASSERT_TRUE(PngPixels(std::string_view(file).substr(0, length)).empty()) << length;
  // A flipped bit anywhere is found.
  for (std::size_t at = 0; at < file.size(); ++at) {
    std::string broken = file;
    broken[at] = static_cast<char>(broken[at] ^ 0x10);
    ASSERT_TRUE(PngPixels(broken).empty()) << at;
  }
  EXPECT_TRUE(PngPixels(MadePng(kRgb, {.ending = "IDAT"})).empty());
}

}  // namespace
}  // namespace io
