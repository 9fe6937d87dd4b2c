#include "io/image/image_header.h"

#include <array>
#include <cstddef>
#include <limits>

#include "io/image/png_bytes.h"

namespace io {
namespace {

unsigned char ByteAt(std::string_view bytes, std::size_t at) {
  return static_cast<unsigned char>(bytes[at]);
}

std::size_t TwoBytes(std::string_view bytes, std::size_t at) {
  return std::size_t{ByteAt(bytes, at)} << 8 | ByteAt(bytes, at + 1);
}

std::optional<ImageHeader> PngHeader(std::string_view bytes) {
  using namespace std::string_view_literals;
  // Behind the signature: length and type of the first chunk, width, height, bits, kind of colour.
  constexpr std::size_t kWidth = 16, kHeight = 20, kBits = 24, kColour = 25, kEnd = 29;
  constexpr std::array kKinds = {"gray",   "kind 1",        "RGB", "palette", "gray with alpha",
                                 "kind 5", "RGB with alpha"};
  constexpr std::size_t kPalette = 3;
  constexpr std::string_view kEndChunk = "IEND\xAE\x42\x60\x82"sv;
  constexpr std::uint32_t kMax = std::numeric_limits<int>::max();
  if (bytes.size() < kEnd) return std::nullopt;
  const std::uint32_t width = PngNumber(bytes, kWidth), height = PngNumber(bytes, kHeight);
  const std::size_t colour = ByteAt(bytes, kColour);
  if (width > kMax || height > kMax || colour >= kKinds.size()) return std::nullopt;
  return ImageHeader{ImageFormat::kPng, static_cast<int>(width), static_cast<int>(height),
                     colour == kPalette
                         ? "8-bit RGB"  // of each entry, however many there are
                         : std::to_string(ByteAt(bytes, kBits)) + "-bit " + kKinds[colour],
                     bytes.find(kEndChunk) != std::string_view::npos};
}

/// Whether a segment of a JPEG file begins a frame, and so tells its size (ITU-T T.81, B.1.1.3).
bool IsFrame(unsigned char marker) {
  constexpr unsigned char kHuffmanTables = 0xC4, kExtension = 0xC8, kArithmetic = 0xCC;
  return marker >= 0xC0 && marker <= 0xCF && marker != kHuffmanTables && marker != kExtension &&
         marker != kArithmetic;
}

/// The segment at `at`: 0xFF, its marker, length, bits, height, width, number of colours.
ImageHeader FrameHeader(std::string_view bytes, std::size_t at) {
  const unsigned char colours = ByteAt(bytes, at + 9);
  return {ImageFormat::kJpeg, static_cast<int>(TwoBytes(bytes, at + 7)),
          static_cast<int>(TwoBytes(bytes, at + 5)),
          std::to_string(ByteAt(bytes, at + 4)) + "-bit " +
              (colours == 3   ? "RGB"
               : colours == 1 ? "gray"
                              : "CMYK"),
          false};
}

std::optional<ImageHeader> JpegHeader(std::string_view bytes) {
  // Segments: 0xFF, a marker, two bytes of length (which count themselves), content.
  constexpr unsigned char kFilling = 0xFF, kStartOfScan = 0xDA;
  constexpr std::string_view kEnd = "\xFF\xD9";
  std::optional<ImageHeader> header;
  for (std::size_t at = 2; at + 9 < bytes.size() && bytes[at] == '\xFF';) {
    const unsigned char marker = ByteAt(bytes, at + 1);
    if (IsFrame(marker)) header = FrameHeader(bytes, at);
    if (marker == kStartOfScan) {
      // 0xFF is escaped inside a scan, so this is the end of the image and not of a thumbnail.
      if (header) header->whole = bytes.find(kEnd, at) != std::string_view::npos;
      return header;
    }
    at += marker == kFilling ? 1 : 2 + TwoBytes(bytes, at + 2);
  }
  return header;
}

}  // namespace

std::optional<ImageHeader> ReadImageHeader(std::string_view bytes) {
  constexpr std::string_view kJpeg = "\xFF\xD8";
  if (bytes.starts_with(kPngSignature)) return PngHeader(bytes);
  return bytes.starts_with(kJpeg) ? JpegHeader(bytes) : std::nullopt;
}

}  // namespace io
