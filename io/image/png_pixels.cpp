#include "io/image/png_pixels.h"

#include <libdeflate.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <memory>
#include <optional>
#include <vector>

#include "io/image/png_bytes.h"
#include "io/image/png_row.h"

namespace io {
namespace {

// PNG specification (ISO/IEC 15948): the signature, then chunks of length, type, data, CRC-32.
constexpr std::size_t kNumber = 4;  // bytes of a length, a type, a CRC
constexpr std::size_t kHeader = 13;
constexpr std::uint32_t kMaxSide_px = 1u << 15;

/// What a file holds: its header, and the compressed pixels.
struct Png {
  std::uint32_t width = 0, height = 0;
  std::size_t pixel_bytes = 0;  ///< 1 and 2: gray; 3: RGB
  std::string packed;

  std::size_t row_bytes() const { return pixel_bytes * width; }
  int type() const {
    return pixel_bytes == 1 ? CV_8UC1 : pixel_bytes == 2 ? CV_16UC1 : CV_8UC3;
  }
};

bool ReadHeader(std::string_view data, Png& png) {
  using namespace std::string_view_literals;
  if (data.size() != kHeader) return false;
  png.width = PngNumber(data, 0);
  png.height = PngNumber(data, 4);
  // Bits and colours; deflate, the five filters, not interlaced.
  const std::string_view kind = data.substr(8);
  png.pixel_bytes = kind == "\x08\0\0\0\0"sv   ? 1
                    : kind == "\x10\0\0\0\0"sv ? 2
                    : kind == "\x08\2\0\0\0"sv ? 3
                                               : 0;
  return png.pixel_bytes > 0 && png.width > 0 && png.height > 0 && png.width <= kMaxSide_px &&
         png.height <= kMaxSide_px;
}

/// The chunks of a whole file of a kind that is known here.
std::optional<Png> ReadChunks(std::string_view file) {
  if (!file.starts_with(kPngSignature)) return std::nullopt;
  Png png;
  std::size_t at = kPngSignature.size();
  for (bool first = true; at + 3 * kNumber <= file.size(); first = false) {
    const std::size_t length = PngNumber(file, at);
    if (length > file.size() - at - 3 * kNumber) return std::nullopt;
    const std::string_view checked = file.substr(at + kNumber, kNumber + length);
    const std::string_view type = checked.substr(0, kNumber), data = checked.substr(kNumber);
    at += 2 * kNumber + length;
    if (libdeflate_crc32(0, checked.data(), checked.size()) != PngNumber(file, at))
      return std::nullopt;
    at += kNumber;
    if (first != (type == "IHDR")) return std::nullopt;
    if (first && !ReadHeader(data, png)) return std::nullopt;
    if (type == "IEND") return png;
    if (type == "IDAT") {
      png.packed += data;
    } else if (!first && ((type[0] & 0x20) == 0 || type == "tRNS")) {
      return std::nullopt;  // it changes what the pixels mean
    }
  }
  return std::nullopt;
}

struct FreeDecompressor {
  void operator()(libdeflate_decompressor* d) const { libdeflate_free_decompressor(d); }
};

bool Inflate(std::string_view packed, std::vector<std::uint8_t>& bytes) {
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
  switch (static_cast<PngFilter>(filter)) {
    case PngFilter::kNone:
      return true;
    case PngFilter::kLeft:
      UndoAlong<kPixel>(above, length, row, [](int left, int, int) { return left; });
      return true;
    case PngFilter::kAbove:
      for (std::size_t i = 0; i < length; ++i)
        row[i] = static_cast<std::uint8_t>(row[i] + above[i]);
      return true;
    case PngFilter::kMean:
      UndoAlong<kPixel>(above, length, row,
                        [](int left, int up, int) { return (left + up) / 2; });
      return true;
    case PngFilter::kPaeth:
      UndoAlong<kPixel>(above, length, row, Paeth);
      return true;
    default:
      return false;
  }
}

}  // namespace

cv::Mat PngPixels(std::string_view file) {
  const std::optional<Png> png = ReadChunks(file);
  if (!png) return {};
  // Each row stands behind the byte that names its filter.
  const std::size_t length = png->row_bytes();
  std::vector<std::uint8_t> rows((length + 1) * png->height);
  if (!Inflate(png->packed, rows)) return {};
  cv::Mat image(static_cast<int>(png->height), static_cast<int>(png->width), png->type());
  const std::vector<std::uint8_t> nothing(length, 0);
  const std::uint8_t* above = nothing.data();
  for (int v = 0; v < image.rows; ++v) {
    std::uint8_t* row = rows.data() + static_cast<std::size_t>(v) * (length + 1);
    const std::uint8_t filter = *row++;
    const auto undo = png->pixel_bytes == 1   ? UndoFilter<1>
                      : png->pixel_bytes == 2 ? UndoFilter<2>
                                              : UndoFilter<3>;
    if (!undo(filter, above, length, row)) return {};
    ReorderRow(row, png->pixel_bytes, png->width, image.ptr(v));
    above = row;
  }
  return image;
}

}  // namespace io
