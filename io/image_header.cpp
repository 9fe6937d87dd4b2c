#include "io/image_header.h"

#include <cstddef>
#include <limits>

namespace io {
namespace {

/// A whole number of `count` bytes, the highest first.
std::size_t BigEndian(std::string_view bytes, std::size_t at, std::size_t count) {
  std::size_t number = 0;
  for (const char c : bytes.substr(at, count)) {
    number = 256 * number + static_cast<unsigned char>(c);
  }
  return number;
}

std::optional<ImageSize> SizeFrom(std::size_t width, std::size_t height) {
  constexpr std::size_t kMax = std::numeric_limits<int>::max();
  if (width > kMax || height > kMax) return std::nullopt;
  return ImageSize{static_cast<int>(width), static_cast<int>(height), false};
}

/// Whether a segment of a JPEG file begins a frame, and so tells its size (ITU-T T.81, B.1.1.3).
bool IsFrame(unsigned char marker) {
  constexpr unsigned char kHuffmanTables = 0xC4, kExtension = 0xC8, kArithmetic = 0xCC;
  return marker >= 0xC0 && marker <= 0xCF && marker != kHuffmanTables && marker != kExtension &&
         marker != kArithmetic;
}

std::optional<ImageSize> JpegSize(std::string_view bytes) {
  // Segments: 0xFF, a marker, two bytes of length (which count themselves), content.
  constexpr unsigned char kStartOfScan = 0xDA;
  constexpr std::string_view kEnd = "\xFF\xD9";
  std::optional<ImageSize> size;
  std::size_t at = 2;
  while (at + 9 <= bytes.size() && bytes[at] == '\xFF') {
    const auto marker = static_cast<unsigned char>(bytes[at + 1]);
    if (marker == 0xFF) {  // filling
      ++at;
      continue;
    }
    if (IsFrame(marker)) {
      size = SizeFrom(BigEndian(bytes, at + 7, 2), BigEndian(bytes, at + 5, 2));
    }
    if (marker == kStartOfScan) {
      // 0xFF is escaped inside a scan, so this is the end of the image and not of a thumbnail.
      if (size) size->whole = bytes.find(kEnd, at) != std::string_view::npos;
      return size;
    }
    at += 2 + BigEndian(bytes, at + 2, 2);
  }
  return size;
}

}  // namespace

std::optional<ImageSize> ImageSizeOf(std::string_view bytes) {
  constexpr std::string_view kPng = "\x89PNG\r\n\x1a\n", kJpeg = "\xFF\xD8";
  constexpr std::string_view kPngEnd = "IEND\xAE\x42\x60\x82";
  constexpr std::size_t kPngHeader_bytes = 24;  // signature, length, "IHDR", width, height
  if (bytes.starts_with(kPng) && bytes.size() >= kPngHeader_bytes) {
    auto size = SizeFrom(BigEndian(bytes, 16, 4), BigEndian(bytes, 20, 4));
    if (size) size->whole = bytes.ends_with(kPngEnd);
    return size;
  }
  return bytes.starts_with(kJpeg) ? JpegSize(bytes) : std::nullopt;
}

}  // namespace io
