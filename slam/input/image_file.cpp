#include "slam/input/image_file.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <opencv2/imgcodecs.hpp>
#include <span>

#include "io/input_error.h"
#include "io/read_file.h"
#include "slam/base/require.h"

namespace slam {
namespace {

constexpr std::array<std::uint8_t, 8> kPngSignature = {0x89, 'P',  'N', 'G',
                                                       '\r', '\n', 26,  '\n'};
constexpr std::array<std::uint8_t, 8> kPngEnd = {'I', 'E', 'N', 'D', 0xAE, 0x42, 0x60, 0x82};
constexpr std::size_t kHeaderBytes = 33;          // signature and IHDR
constexpr std::uintmax_t kMaxBytes = 512u << 20;  // 8192^2 pixels of 16 bits, and some

std::uint32_t BigEndian(const std::uint8_t* p) {
  return (std::uint32_t{p[0]} << 24) | (std::uint32_t{p[1]} << 16) |
         (std::uint32_t{p[2]} << 8) | std::uint32_t{p[3]};
}

/// What a PNG's header says of the pixels: "8-bit RGB" and so on.
std::string PixelText(int bits, int colour) {
  static constexpr std::array<const char*, 7> kNames = {
      "gray", "?", "RGB", "palette", "gray with alpha", "?", "RGB with alpha"};
  const char* name = colour >= 0 && colour < 7 ? kNames[static_cast<std::size_t>(colour)] : "?";
  return std::to_string(bits) + "-bit " + name;
}

/// Refuses a file that is no whole PNG of the camera's size and the type wanted.
void CheckHeader(std::span<const std::uint8_t> bytes, ImageType type, const Camera& camera,
                 const std::string& where) {
  if (bytes.empty()) throw io::InputError(where, "the file is empty (0 bytes); copy it again");
  if (bytes.size() < kHeaderBytes ||
      !std::equal(kPngSignature.begin(), kPngSignature.end(), bytes.begin()))
    throw io::InputError(where, "not a PNG image (or cut off in its header)");
  // IHDR, after signature, length and name: width, height, bits, colour type.
  const std::uint32_t width = BigEndian(&bytes[16]), height = BigEndian(&bytes[20]);
  if (width != static_cast<std::uint32_t>(camera.width) ||
      height != static_cast<std::uint32_t>(camera.height))
    throw io::InputError(
        where, "the image is " + std::to_string(width) + " x " + std::to_string(height) +
                   ", the camera says " + std::to_string(camera.width) + " x " +
                   std::to_string(camera.height) + "; mend the camera file or the image");
  const std::string found = PixelText(bytes[24], bytes[25]);
  const std::string expected = type == ImageType::kColour ? "8-bit RGB" : "16-bit gray";
  if (found != expected)
    throw io::InputError(
        where, "the image is " + found + ", expected " + expected +
                   (type == ImageType::kColour ? "" : " (depth_factor units a metre)"));
  if (!std::equal(kPngEnd.begin(), kPngEnd.end(), bytes.end() - kPngEnd.size()) &&
      std::search(bytes.begin(), bytes.end(), kPngEnd.begin(), kPngEnd.end()) == bytes.end())
    throw io::InputError(where, "the image is truncated (its end is missing); copy it again");
}

}  // namespace

cv::Mat ReadImage(const std::filesystem::path& file, ImageType type, const Camera& camera,
                  const std::string& context) {
  const std::string where = file.string() + " (" + context + ")";
  std::string bytes = io::ReadFile(file, "expected the image of " + context, kMaxBytes);
  auto* const first = reinterpret_cast<std::uint8_t*>(bytes.data());
  CheckHeader({first, bytes.size()}, type, camera, where);
  cv::Mat image;
  try {
    image = cv::imdecode(cv::Mat1b(1, static_cast<int>(bytes.size()), first),
                         type == ImageType::kColour ? cv::IMREAD_COLOR : cv::IMREAD_UNCHANGED);
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
