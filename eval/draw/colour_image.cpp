#include "eval/draw/colour_image.h"

#include <fmt/format.h>

#include <opencv2/imgcodecs.hpp>
#include <optional>
#include <string>

#include "io/input_error.h"
#include "io/read_file.h"

namespace eval {
namespace {

constexpr std::uintmax_t kMaxBytes = 64u << 20;  // several times a 24-megapixel PNG
constexpr double kMaxPixels = 50e6;              // 150 MB decoded; no depth camera has so many

unsigned ByteAt(const std::string& bytes, std::size_t at) {
  return static_cast<unsigned char>(bytes[at]);
}
unsigned WordAt(const std::string& bytes, std::size_t at) {
  return ByteAt(bytes, at) * 256 + ByteAt(bytes, at + 1);
}

/// Width and height from the IHDR chunk, which is a PNG's first.
std::optional<cv::Size2d> SizeOfPng(const std::string& bytes) {
  constexpr std::size_t kWidthAt = 16, kHeightAt = 20, kEnd = 24;
  if (!bytes.starts_with("\x89PNG\r\n\x1a\n") || bytes.size() < kEnd) return std::nullopt;
  const auto number = [&](std::size_t at) {
    return WordAt(bytes, at) * 65536.0 + WordAt(bytes, at + 2);
  };
  return cv::Size2d(number(kWidthAt), number(kHeightAt));
}

/// Width and height from the frame header of a JPEG, the first segment SOF0 to SOF15.
std::optional<cv::Size2d> SizeOfJpeg(const std::string& bytes) {
  if (!bytes.starts_with("\xff\xd8")) return std::nullopt;
  std::size_t at = 2;
  while (at + 9 < bytes.size() && ByteAt(bytes, at) == 0xff) {
    const unsigned marker = ByteAt(bytes, at + 1);
    // DHT, JPG and DAC stand among the numbers of frame headers.
    const bool is_frame =
        (marker & 0xf0) == 0xc0 && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
    if (is_frame) return cv::Size2d(WordAt(bytes, at + 7), WordAt(bytes, at + 5));
    at += 2 + WordAt(bytes, at + 2);
  }
  return std::nullopt;
}

}  // namespace

cv::Mat ReadColourImage(const std::filesystem::path& file) {
  const std::string bytes = io::ReadFile(file, "expected a colour image", kMaxBytes);
  auto size = SizeOfPng(bytes);
  if (!size) size = SizeOfJpeg(bytes);
  if (!size) {
    throw io::InputError(file.string(), "is no PNG or JPEG image; copy it again");
  }
  if (!(size->area() > 0 && size->area() <= kMaxPixels)) {
    throw io::InputError(
        file.string(), fmt::format("says that it is {:.0f} x {:.0f} pixels; expected an image "
                                   "of a depth camera: copy it again",
                                   size->width, size->height));
  }
  cv::Mat image;
  try {
    image = cv::imdecode(std::vector<char>(bytes.begin(), bytes.end()),
                         cv::IMREAD_COLOR | cv::IMREAD_IGNORE_ORIENTATION);
  } catch (const cv::Exception&) {
    image.release();
  }
  if (image.empty()) {
    throw io::InputError(file.string(), "is damaged and cannot be decoded; copy it again");
  }
  return image;
}

}  // namespace eval
