#include "slam/input/png_pixels.h"

#include <gtest/gtest.h>
#include <libdeflate.h>

#include <memory>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "slam/base/random.h"

namespace slam {
namespace {

using Bytes = std::vector<std::uint8_t>;

void AppendNumber(std::uint32_t value, Bytes& out) {
  for (int shift = 24; shift >= 0; shift -= 8)
    out.push_back(static_cast<std::uint8_t>(value >> shift));
}

void AppendChunk(const std::string& type, const Bytes& data, Bytes& out) {
  AppendNumber(static_cast<std::uint32_t>(data.size()), out);
  Bytes checked(type.begin(), type.end());
  checked.insert(checked.end(), data.begin(), data.end());
  out.insert(out.end(), checked.begin(), checked.end());
  AppendNumber(libdeflate_crc32(0, checked.data(), checked.size()), out);
}

Bytes Pack(const Bytes& bytes) {
  constexpr int kLevel = 6;
  const std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)> packer(
      libdeflate_alloc_compressor(kLevel), libdeflate_free_compressor);
  Bytes packed(libdeflate_zlib_compress_bound(packer.get(), bytes.size()));
  packed.resize(libdeflate_zlib_compress(packer.get(), bytes.data(), bytes.size(),
                                         packed.data(), packed.size()));
  return packed;
}

/// What is packed into a file: rows of filtered bytes, made up at random, so that whatever they
/// come to, all decoders must agree.
struct Kind {
  int bits = 8, colours = 2;
  std::size_t pixel_bytes = 3;
};
constexpr Kind kRgb{8, 2, 3}, kGray16{16, 0, 2}, kGray8{8, 0, 1}, kRgba{8, 6, 4};

struct Make {
  int width = 37, height = 23;
  int filter = -1;         ///< of all rows; -1: each in turn
  std::size_t parts = 1;   ///< chunks of pixels
  std::string extra = {};  ///< a chunk before them
  std::string ending = "IEND";
};

Bytes MakePng(const Kind& kind, const Make& make) {
  Random random({7});
  Bytes rows;
  for (int v = 0; v < make.height; ++v) {
    rows.push_back(static_cast<std::uint8_t>(make.filter >= 0 ? make.filter : v % 5));
    for (std::size_t i = 0; i < kind.pixel_bytes * static_cast<std::size_t>(make.width); ++i)
      rows.push_back(static_cast<std::uint8_t>(random.Below(256)));
  }
  const Bytes packed = Pack(rows);

  Bytes file = {0x89, 'P', 'N', 'G', '\r', '\n', 26, '\n'}, header;
  AppendNumber(static_cast<std::uint32_t>(make.width), header);
  AppendNumber(static_cast<std::uint32_t>(make.height), header);
  for (const int byte : {kind.bits, kind.colours, 0, 0, 0})
    header.push_back(static_cast<std::uint8_t>(byte));
  AppendChunk("IHDR", header, file);
  if (!make.extra.empty()) AppendChunk(make.extra, Bytes(6, 0), file);
  for (std::size_t k = 0; k < make.parts; ++k) {
    const auto begin =
        packed.begin() + static_cast<std::ptrdiff_t>(k * packed.size() / make.parts);
    const auto end =
        packed.begin() + static_cast<std::ptrdiff_t>((k + 1) * packed.size() / make.parts);
    AppendChunk("IDAT", Bytes(begin, end), file);
  }
  AppendChunk(make.ending, {}, file);
  return file;
}

void ExpectAsOpenCvHasIt(const Bytes& file, const std::string& what) {
  const cv::Mat expected = cv::imdecode(file, cv::IMREAD_UNCHANGED);
  const cv::Mat image = PngPixels(file);
  ASSERT_FALSE(expected.empty()) << what;
  ASSERT_EQ(image.type(), expected.type()) << what;
  ASSERT_EQ(image.size(), expected.size()) << what;
  EXPECT_EQ(cv::norm(image, expected, cv::NORM_INF), 0) << what;
}

TEST(PngPixels, AreThoseOfAnotherDecoderWhateverTheFilter) {
  for (const Kind& kind : {kRgb, kGray16}) {
    for (int filter = -1; filter < 5; ++filter) {
      for (const auto& [width, height] : {std::pair{37, 23}, {1, 1}, {640, 7}, {2, 9}}) {
        ExpectAsOpenCvHasIt(
            MakePng(kind, {.width = width, .height = height, .filter = filter}),
            std::to_string(kind.bits) + " bits, filter " + std::to_string(filter));
      }
    }
  }
}

TEST(PngPixels, AreReadFromManyChunksAndBesideOthers) {
  ExpectAsOpenCvHasIt(MakePng(kRgb, {.parts = 5}), "parts");
  ExpectAsOpenCvHasIt(MakePng(kGray16, {.extra = "teXt"}), "a text");
}

TEST(PngPixels, AreLeftToOtherDecodersWhereTheyMeanSomethingElse) {
  EXPECT_TRUE(PngPixels(MakePng(kGray8, {})).empty());
  EXPECT_TRUE(PngPixels(MakePng(kRgba, {})).empty());
  EXPECT_TRUE(PngPixels(MakePng(kRgb, {.extra = "tRNS"})).empty());
  EXPECT_TRUE(PngPixels(MakePng(kRgb, {.extra = "PLTE"})).empty());
  EXPECT_TRUE(PngPixels(MakePng(kRgb, {.filter = 5})).empty());
}

TEST(PngPixels, AreNoneOfAFileThatIsNotWhole) {
  const Bytes file = MakePng(kRgb, {});
  ASSERT_FALSE(PngPixels(file).empty());
  for (std::size_t length = 0; length < file.size(); ++length)
    ASSERT_TRUE(PngPixels({file.data(), length}).empty()) << length;
  // A flipped bit anywhere but in the CRC of the end is found.
  for (std::size_t at = 0; at < file.size(); ++at) {
    Bytes broken = file;
    broken[at] ^= 0x10;
    ASSERT_TRUE(PngPixels(broken).empty()) << at;
  }
  EXPECT_TRUE(PngPixels(MakePng(kRgb, {.ending = "IDAT"})).empty());
}

}  // namespace
}  // namespace slam
