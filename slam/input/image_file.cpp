#include "slam/input/image_file.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <opencv2/imgcodecs.hpp>
#include <optional>
#include <span>

#include "io/input_error.h"
#include "io/read_file.h"
#include "slam/base/require.h"
#include "slam/input/png_bytes.h"
#include "slam/input/png_pixels.h"

namespace slam {
namespace {

constexpr std::array<std::uint8_t, 8> kPngEnd = {'I', 'E', 'N', 'D', 0xAE, 0x42, 0x60, 0x82};
constexpr std::array<std::uint8_t, 3> kJpegSignature = {0xFF, 0xD8, 0xFF};
constexpr std::size_t kHeaderBytes = 33;          // signature and IHDR
constexpr std::uintmax_t kMaxBytes = 512u << 20;  // 8192^2 pixels of 16 bits, and some

/// What a PNG's header says of the pixels: "8-bit RGB" and so on.
std::string PixelText(int bits, int colour) {
  static constexpr std::array<const char*, 7> kNames = {
      "gray", "?", "RGB", "palette", "gray with alpha", "?", "RGB with alpha"};
  const char* name = colour >= 0 && colour < 7 ? kNames[static_cast<std::size_t>(colour)] : "?";
  return std::to_string(bits) + "-bit " + name;
}

/// Size, pixels and end of an image, as far as its header tells them.
struct Header {
  std::uint32_t width = 0, height = 0;
  std::string pixels;  ///< "8-bit RGB"
  bool whole = false;  ///< the mark of its end is there
};

bool Begins(std::span<const std::uint8_t> bytes, std::span<const std::uint8_t> with) {
  return bytes.size() >= with.size() && std::equal(with.begin(), with.end(), bytes.begin());
}

std::optional<Header> PngHeader(std::span<const std::uint8_t> bytes) {
  if (bytes.size() < kHeaderBytes || !Begins(bytes, kPngSignature)) return std::nullopt;
  // IHDR, after signature, length and name: width, height, bits, colour type.
  const bool whole =
      std::equal(kPngEnd.begin(), kPngEnd.end(), bytes.end() - kPngEnd.size()) ||
      std::search(bytes.begin(), bytes.end(), kPngEnd.begin(), kPngEnd.end()) != bytes.end();
  return Header{PngNumber(bytes, 16), PngNumber(bytes, 20), PixelText(bytes[24], bytes[25]),
                whole};
}

/// A JPEG is a chain of segments, 0xFF, kind, length; the first scan follows them.
std::optional<Header> JpegHeader(std::span<const std::uint8_t> bytes) {
  constexpr std::uint8_t kStartOfScan = 0xDA, kFirstFrame = 0xC0, kLastFrame = 0xCF;
  constexpr std::array<std::uint8_t, 3> kNoFrames = {0xC4, 0xC8, 0xCC};
  constexpr std::array<std::uint8_t, 2> kEnd = {0xFF, 0xD9};
  const auto word = [&](std::size_t at) {
    return std::uint32_t{bytes[at]} << 8 | bytes[at + 1];
  };
  std::optional<Header> header;
  for (std::size_t at = 2; at + 9 < bytes.size() && bytes[at] == 0xFF;) {
    const std::uint8_t kind = bytes[at + 1];
    if (kind >= kFirstFrame && kind <= kLastFrame &&
        std::find(kNoFrames.begin(), kNoFrames.end(), kind) == kNoFrames.end()) {
      // After the length: bits, height, width, number of components.
      const int components = bytes[at + 9];
      header = Header{word(at + 7), word(at + 5),
                      std::to_string(bytes[at + 4]) + "-bit " +
                          (components == 3   ? "RGB"
                           : components == 1 ? "gray"
                                             : "CMYK"),
                      false};
    }
    if (kind == kStartOfScan) {
      // 0xFF is escaped inside a scan, so that this is the end of the image and nothing else.
      const auto scan = bytes.subspan(at);
      if (header) {
        header->whole =
            std::search(scan.begin(), scan.end(), kEnd.begin(), kEnd.end()) != scan.end();
      }
      return header;
    }
    at += kind == 0xFF ? 1 : 2 + word(at + 2);
  }
  return header;
}

/// Refuses a file that is no whole image of the camera's size and the type wanted.
void CheckHeader(std::span<const std::uint8_t> bytes, ImageType type, const Camera& camera,
                 const std::string& where) {
  const bool colour = type == ImageType::kColour;
  if (bytes.empty()) throw io::InputError(where, "the file is empty (0 bytes); copy it again");
  const bool jpeg = Begins(bytes, kJpegSignature);
  if (jpeg && !colour) {
    throw io::InputError(where,
                         "the image is a JPEG, which does not keep depth; depth must be a PNG "
                         "of 16-bit gray (depth_factor units a metre)");
  }
  const std::optional<Header> header = jpeg ? JpegHeader(bytes) : PngHeader(bytes);
  if (!header) {
    throw io::InputError(where, std::string("not a PNG ") + (colour ? "or JPEG " : "") +
                                    "image (or cut off in its header)");
  }
  if (header->width != static_cast<std::uint32_t>(camera.width) ||
      header->height != static_cast<std::uint32_t>(camera.height))
    throw io::InputError(where, "the image is " + std::to_string(header->width) + " x " +
                                    std::to_string(header->height) + ", the camera says " +
                                    std::to_string(camera.width) + " x " +
                                    std::to_string(camera.height) +
                                    "; mend the camera file or the image");
  const std::string expected = colour ? "8-bit RGB" : "16-bit gray";
  if (header->pixels != expected)
    throw io::InputError(where, "the image is " + header->pixels + ", expected " + expected +
                                    (colour ? "" : " (depth_factor units a metre)"));
  if (!header->whole)
    throw io::InputError(where, "the image is truncated (its end is missing); copy it again");
}

}  // namespace

cv::Mat ReadImage(const std::filesystem::path& file, ImageType type, const Camera& camera,
                  const std::string& context) {
  const std::string where = file.string() + " (" + context + ")";
  std::string bytes = io::ReadFile(file, "expected the image of " + context, kMaxBytes);
  auto* const first = reinterpret_cast<std::uint8_t*>(bytes.data());
  CheckHeader({first, bytes.size()}, type, camera, where);
  cv::Mat image = PngPixels({first, bytes.size()});
  try {
    if (image.empty()) {
      image =
          cv::imdecode(cv::Mat1b(1, static_cast<int>(bytes.size()), first),
                       type == ImageType::kColour
                           ? cv::IMREAD_COLOR | cv::IMREAD_IGNORE_ORIENTATION  // as recorded
                           : cv::IMREAD_UNCHANGED);
    }
  } catch (const cv::Exception&) {
    image.release();
  }
  const int expected = type == ImageType::kColour ? CV_8UC3 : CV_16UC1;
  if (image.empty() || image.type() != expected || image.cols != camera.width ||
      image.rows != camera.height)
    throw io::InputError(where, "the image is damaged and cannot be decoded; copy it again");
  return image;
}

cv::Mat1f DepthInMetres(const cv::Mat& raw, double depth_factor) {
  Require(raw.type() == CV_16UC1, "DepthInMetres: expected 16-bit gray");
  Require(depth_factor > 0, "DepthInMetres: the depth factor must be positive");
  cv::Mat1f depth_m(raw.rows, raw.cols);
  for (int v = 0; v < raw.rows; ++v) {
    const auto* in = raw.ptr<std::uint16_t>(v);
    float* out = depth_m[v];
    for (int u = 0; u < raw.cols; ++u) {
      const bool measured = in[u] != std::numeric_limits<std::uint16_t>::max();
      out[u] = measured ? static_cast<float>(in[u] / depth_factor) : 0.0f;
    }
  }
  return depth_m;
}

}  // namespace slam
