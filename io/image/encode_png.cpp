#include "io/image/encode_png.h"

#include <libdeflate.h>

#include <memory>
#include <new>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "io/image/png_bytes.h"
#include "io/image/png_row.h"

namespace io {
namespace {

// PNG specification (ISO/IEC 15948): signature, then chunks of length, type, data, CRC-32.
constexpr int kFastest = 1;

void AppendNumber(std::uint32_t value, std::string& out) {
  for (int shift = 24; shift >= 0; shift -= 8) out += static_cast<char>(value >> shift & 0xFFu);
}

void AppendChunk(std::string_view type, std::string_view data, std::string& out) {
  AppendNumber(static_cast<std::uint32_t>(data.size()), out);
  const std::size_t start = out.size();
  out += type;
  out += data;
  AppendNumber(libdeflate_crc32(0, out.data() + start, out.size() - start), out);
}

/// All rows, each after the byte that names its filter.
void FilterRows(const cv::Mat& image, std::vector<unsigned char>& out) {
  const std::size_t pixel = image.elemSize();
  const std::size_t length = pixel * static_cast<std::size_t>(image.cols);
  // The row above suits flat id images, the pixel to the left everything noisy.
  const PngFilter filter = image.depth() == CV_16U ? PngFilter::kAbove : PngFilter::kLeft;
  std::vector<unsigned char> above(length, 0), row(length);
  out.resize((length + 1) * static_cast<std::size_t>(image.rows));
  unsigned char* to = out.data();
  for (int v = 0; v < image.rows; ++v, to += length + 1) {
    ReorderRow(image.ptr(v), pixel, static_cast<std::size_t>(image.cols), row.data());
    to[0] = static_cast<unsigned char>(filter);
    if (filter == PngFilter::kAbove) {
      for (std::size_t i = 0; i < length; ++i) {
        to[1 + i] = static_cast<unsigned char>(row[i] - above[i]);
      }
    } else {
      for (std::size_t i = 0; i < pixel; ++i) to[1 + i] = row[i];
      for (std::size_t i = pixel; i < length; ++i) {
        to[1 + i] = static_cast<unsigned char>(row[i] - row[i - pixel]);
      }
    }
    std::swap(above, row);
  }
}

struct FreeCompressor {
  void operator()(libdeflate_compressor* c) const { libdeflate_free_compressor(c); }
};

std::string Compress(const std::vector<unsigned char>& bytes) {
  thread_local const std::unique_ptr<libdeflate_compressor, FreeCompressor> compressor(
      libdeflate_alloc_compressor(kFastest));
  if (!compressor) throw std::bad_alloc();
  std::string packed(libdeflate_zlib_compress_bound(compressor.get(), bytes.size()), 0);
  packed.resize(libdeflate_zlib_compress(compressor.get(), bytes.data(), bytes.size(),
                                         packed.data(), packed.size()));
  if (packed.empty()) throw std::runtime_error("an image cannot be compressed");
  return packed;
}

}  // namespace

std::string EncodePng(const cv::Mat& image) {
  const int type = image.type();
  if (image.empty() || (type != CV_8UC1 && type != CV_8UC3 && type != CV_16UC1)) {
    throw std::invalid_argument("PNG: expected an image of 8 bits or of 16 bits, one channel");
  }
  thread_local std::vector<unsigned char> filtered;
  FilterRows(image, filtered);
  std::string header;
  AppendNumber(static_cast<std::uint32_t>(image.cols), header);
  AppendNumber(static_cast<std::uint32_t>(image.rows), header);
  header += static_cast<char>(image.depth() == CV_16U ? 16 : 8);
  header += static_cast<char>(image.channels() == 3 ? 2 : 0);  // RGB or grey
  header.append(3, '\0');  // deflate, the five filters, not interlaced
  std::string file(kPngSignature);
  AppendChunk("IHDR", header, file);
  AppendChunk("IDAT", Compress(filtered), file);
  AppendChunk("IEND", "", file);
  return file;
}

}  // namespace io
