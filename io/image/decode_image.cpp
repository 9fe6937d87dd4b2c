#include "io/image/decode_image.h"

#include <jpeglib.h>
#include <png.h>

#include <bit>
#include <csetjmp>
#include <cstring>
#include <new>

#include "io/image/png_bytes.h"
#include "io/image/png_pixels.h"

// libpng and libjpeg report errors by a jump back. What they jump over holds nothing that must be
// destroyed: image and decoder belong to the callers.

namespace io {
namespace {

class PngDecoder {
 public:
  explicit PngDecoder(std::string_view file)
      : left_(file),
        png_(png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, Fail, Ignore)) {
    if (png_ != nullptr) info_ = png_create_info_struct(png_);
    if (info_ == nullptr) {
      png_destroy_read_struct(&png_, nullptr, nullptr);
      throw std::bad_alloc();
    }
    png_set_read_fn(png_, &left_, Take);
  }
  ~PngDecoder() { png_destroy_read_struct(&png_, &info_, nullptr); }
  PngDecoder(const PngDecoder&) = delete;
  PngDecoder& operator=(const PngDecoder&) = delete;

  /// @returns false where the file is damaged
  bool Decode(cv::Mat& image) {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    png_read_info(png_, info_);
    const auto colours = png_get_color_type(png_, info_);
    if (colours == PNG_COLOR_TYPE_PALETTE) png_set_palette_to_rgb(png_);
    if (colours == PNG_COLOR_TYPE_GRAY) png_set_expand_gray_1_2_4_to_8(png_);
    png_set_bgr(png_);
    if constexpr (std::endian::native == std::endian::little) png_set_swap(png_);
    const int passes = png_set_interlace_handling(png_);
    png_read_update_info(png_, info_);
    image.create(static_cast<int>(png_get_image_height(png_, info_)),
                 static_cast<int>(png_get_image_width(png_, info_)),
                 CV_MAKETYPE(png_get_bit_depth(png_, info_) == 16 ? CV_16U : CV_8U,
                             png_get_channels(png_, info_)));
    for (int pass = 0; pass < passes; ++pass) {
      for (int v = 0; v < image.rows; ++v) png_read_row(png_, image.ptr(v), nullptr);
    }
    png_read_end(png_, nullptr);
    return true;
  }

 private:
  [[noreturn]] static void Fail(png_structp png, png_const_charp) { png_longjmp(png, 1); }
  static void Ignore(png_structp, png_const_charp) {}
  static void Take(png_structp png, png_bytep out, png_size_t count) {
    auto& left = *static_cast<std::string_view*>(png_get_io_ptr(png));
    if (count > left.size()) png_error(png, "cut off");
    std::memcpy(out, left.data(), count);
    left.remove_prefix(count);
  }

  std::string_view left_;
  png_structp png_;
  png_infop info_ = nullptr;
};

class JpegDecoder {
 public:
  JpegDecoder() {
    jpeg_.err = jpeg_std_error(&errors_.base);
    errors_.base.error_exit = Fail;
    errors_.base.output_message = Ignore;
  }
  ~JpegDecoder() { jpeg_destroy_decompress(&jpeg_); }
  JpegDecoder(const JpegDecoder&) = delete;
  JpegDecoder& operator=(const JpegDecoder&) = delete;

  /// @returns false where the file is damaged, or has four colours
  bool Decode(std::string_view file, cv::Mat& image) {
    if (setjmp(errors_.back) != 0) return false;
    jpeg_create_decompress(&jpeg_);
    jpeg_mem_src(&jpeg_, reinterpret_cast<const unsigned char*>(file.data()), file.size());
    jpeg_read_header(&jpeg_, TRUE);
    jpeg_.out_color_space = JCS_EXT_BGR;
    jpeg_start_decompress(&jpeg_);
    image.create(static_cast<int>(jpeg_.output_height), static_cast<int>(jpeg_.output_width),
                 CV_8UC3);
    while (jpeg_.output_scanline < jpeg_.output_height) {
      JSAMPROW row = image.ptr(static_cast<int>(jpeg_.output_scanline));
      jpeg_read_scanlines(&jpeg_, &row, 1);
    }
    jpeg_finish_decompress(&jpeg_);
    return true;
  }

 private:
  struct Errors {
    jpeg_error_mgr base;  // first, so that a pointer to it is one to all
    std::jmp_buf back;
  };
  [[noreturn]] static void Fail(j_common_ptr jpeg) {
    std::longjmp(reinterpret_cast<Errors*>(jpeg->err)->back, 1);
  }
  static void Ignore(j_common_ptr) {}

  Errors errors_{};
  jpeg_decompress_struct jpeg_{};
};

}  // namespace

cv::Mat DecodeImage(std::string_view file) {
  cv::Mat image;
  if (!file.starts_with(kPngSignature)) {
    return JpegDecoder().Decode(file, image) ? image : cv::Mat();
  }
  image = PngPixels(file);
  if (!image.empty()) return image;
  return PngDecoder(file).Decode(image) ? image : cv::Mat();
}

}  // namespace io
