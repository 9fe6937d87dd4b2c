#include "slam/input/png_pixels.h"

#include <libdeflate.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "slam/input/png_bytes.h"

namespace slam {
namespace {

// PNG specification (ISO/IEC 15948): the signature, then chunks of length, type, data, CRC-32.
using Bytes = std::span<const std::uint8_t>;
constexpr std::size_t kNumber = 4;  // bytes of a length, a type, a CRC
constexpr std::size_t kHeader = 13;
constexpr std::uint32_t kMaxSide_px = 1u << 15;
enum Filter : std::uint8_t { kNone = 0, kLeft = 1, kAbove = 2, kMean = 3, kPaeth = 4 };

/// What a file holds: its header, and the compressed pixels.
struct Png {
  std::uint32_t width = 0, height = 0;
  bool gray16 = false;  ///< else RGB of 8 bits
  std::vector<std::uint8_t> packed;

  std::size_t pixel_bytes() const { return gray16 ? 2 : 3; }
  std::size_t row_bytes() const { return pixel_bytes() * width; }
};

bool ReadHeader(Bytes data, Png& png) {
  if (data.size() != kHeader) return false;
  png.width = PngNumber(data, 0);
  png.height = PngNumber(data, 4);
  // Bits and colours; deflate, the five filters, not interlaced.
  constexpr std::array<std::uint8_t, 5> kRgb8 = {8, 2, 0, 0, 0}, kGray16 = {16, 0, 0, 0, 0};
  const Bytes kind = data.subspan(8);
  png.gray16 = std::equal(kind.begin(), kind.end(), kGray16.begin());
  return (png.gray16 || std::equal(kind.begin(), kind.end(), kRgb8.begin())) && png.width > 0 &&
         png.height > 0 && png.width <= kMaxSide_px && png.height <= kMaxSide_px;
}

/// The chunks of a whole file of a kind that is known here.
std::optional<Png> ReadChunks(Bytes file) {
  if (file.size() < kPngSignature.size() ||
      !std::equal(kPngSignature.begin(), kPngSignature.end(), file.begin()))
    return std::nullopt;
  Png png;
  std::size_t at = kPngSignature.size();
  for (bool first = true; at + 3 * kNumber <= file.size(); first = false) {
    const std::size_t length = PngNumber(file, at);
    if (length > file.size() - at - 3 * kNumber) return std::nullopt;
    const Bytes checked = file.subspan(at + kNumber, kNumber + length);
    const Bytes data = checked.subspan(kNumber);
    const std::string_view type(reinterpret_cast<const char*>(checked.data()), kNumber);
    at += 2 * kNumber + length;
    if (libdeflate_crc32(0, checked.data(), checked.size()) != PngNumber(file, at))
      return std::nullopt;
    at += kNumber;
    if (first != (type == "IHDR")) return std::nullopt;
    if (first && !ReadHeader(data, png)) return std::nullopt;
    if (type == "IEND") return png;
    if (type == "IDAT") {
      png.packed.insert(png.packed.end(), data.begin(), data.end());
    } else if (!first && ((type[0] & 0x20) == 0 || type == "tRNS")) {
      return std::nullopt;  // it changes what the pixels mean
    }
  }
  return std::nullopt;
}

struct FreeDecompressor {
  void operator()(libdeflate_decompressor* d) const { libdeflate_free_decompressor(d); }
};

bool Inflate(const std::vector<std::uint8_t>& packed, std::vector<std::uint8_t>& bytes) {
  thread_local const std::unique_ptr<libdeflate_decompressor, FreeDecompressor> decompressor(
      libdeflate_alloc_decompressor());
  return decompressor != nullptr &&
         libdeflate_zlib_decompress(decompressor.get(), packed.data(), packed.size(),
                                    bytes.data(), bytes.size(), nullptr) == LIBDEFLATE_SUCCESS;
}

/// Whichever of left, above and above left is nearest to left + above - above left.
int Paeth(int left, int above, int corner) {
  const int by_left = std::abs(above - corner), by_above = std::abs(left - corner),
            by_corner = std::abs(left + above - 2 * corner);
  const int other = by_above <= by_corner ? above : corner;
  return by_left <= by_above && by_left <= by_corner ? left : other;
}

/// Undoes a filter that looks to the left. @param above  the row before, as it came out
template <std::size_t kPixel, typename Guess>
void UndoAlong(const std::uint8_t* above, std::size_t length, std::uint8_t* row, Guess guess) {
  std::array<int, kPixel> left{}, corner{};
  for (std::size_t i = 0; i < length; i += kPixel) {
    for (std::size_t k = 0; k < kPixel; ++k) {
      const int up = above[i + k];
      left[k] = (row[i + k] + guess(left[k], up, corner[k])) & 0xFF;
      row[i + k] = static_cast<std::uint8_t>(left[k]);
      corner[k] = up;
    }
  }
}

/// @returns false for a filter that there is not
template <std::size_t kPixel>
bool UndoFilter(std::uint8_t filter, const std::uint8_t* above, std::size_t length,
                std::uint8_t* row) {
  switch (filter) {
    case kNone:
      return true;
    case kLeft:
      UndoAlong<kPixel>(above, length, row, [](int left, int, int) { return left; });
      return true;
    case kAbove:
      for (std::size_t i = 0; i < length; ++i)
        row[i] = static_cast<std::uint8_t>(row[i] + above[i]);
      return true;
    case kMean:
      UndoAlong<kPixel>(above, length, row,
                        [](int left, int up, int) { return (left + up) / 2; });
      return true;
    case kPaeth:
      UndoAlong<kPixel>(above, length, row, Paeth);
      return true;
    default:
      return false;
  }
}

/// A row of the file as OpenCV has it: blue first, the processor's order of bytes.
void StoreRow(const std::uint8_t* row, bool gray16, cv::Mat& image, int v) {
  std::uint8_t* out = image.ptr(v);
  const auto count = static_cast<std::size_t>(image.cols);
  for (std::size_t i = 0; gray16 && i < count; ++i) {
    const auto sample = static_cast<std::uint16_t>(row[2 * i] << 8 | row[2 * i + 1]);
    std::memcpy(out + 2 * i, &sample, sizeof sample);
  }
  for (std::size_t i = 0; !gray16 && i < count; ++i) {
    out[3 * i] = row[3 * i + 2];
    out[3 * i + 1] = row[3 * i + 1];
    out[3 * i + 2] = row[3 * i];
  }
}

}  // namespace

cv::Mat PngPixels(std::span<const std::uint8_t> file) {
  const std::optional<Png> png = ReadChunks(file);
  if (!png) return {};
  // Each row stands behind the byte that names its filter.
  const std::size_t length = png->row_bytes();
  std::vector<std::uint8_t> rows((length + 1) * png->height);
  if (!Inflate(png->packed, rows)) return {};
  cv::Mat image(static_cast<int>(png->height), static_cast<int>(png->width),
                png->gray16 ? CV_16UC1 : CV_8UC3);
  const std::vector<std::uint8_t> nothing(length, 0);
  const std::uint8_t* above = nothing.data();
  for (int v = 0; v < image.rows; ++v) {
    std::uint8_t* row = rows.data() + static_cast<std::size_t>(v) * (length + 1);
    const std::uint8_t filter = *row++;
    if (!(png->gray16 ? UndoFilter<2>(filter, above, length, row)
                      : UndoFilter<3>(filter, above, length, row)))
      return {};
    StoreRow(row, png->gray16, image, v);
    above = row;
  }
  return image;
}

}  // namespace slam
