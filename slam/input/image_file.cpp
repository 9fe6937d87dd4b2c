#include "slam/input/image_file.h"

#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>

#include "io/image/decode_image.h"
#include "io/image/image_header.h"
#include "io/input_error.h"
#include "io/read_file.h"
#include "slam/base/require.h"

namespace slam {
namespace {

constexpr std::uintmax_t kMaxBytes = 512u << 20;  // 8192^2 pixels of 16 bits, and some

/// Refuses a file that is no whole image of the camera's size and the type wanted.
void CheckHeader(std::string_view bytes, ImageType type, const Camera& camera,
                 const std::string& where) {
  const bool colour = type == ImageType::kColour;
  if (bytes.empty()) throw io::InputError(where, "the file is empty (0 bytes); copy it again");
  const std::optional<io::ImageHeader> header = io::ReadImageHeader(bytes);
  if (!header) {
    throw io::InputError(where, std::string("not a PNG ") + (colour ? "or JPEG " : "") +
                                    "image (or cut off in its header)");
  }
  if (header->format == io::ImageFormat::kJpeg && !colour) {
    throw io::InputError(where,
                         "the image is a JPEG, which does not keep depth; depth must be a PNG "
                         "of 16-bit gray (depth_factor units a metre)");
  }
  if (header->width != camera.width || header->height != camera.height)
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
  const std::string bytes = io::ReadFile(file, "expected the image of " + context, kMaxBytes);
  CheckHeader(bytes, type, camera, where);
  const cv::Mat image = io::DecodeImage(bytes);
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
