#include "slam/input/image_file.h"

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>
#include <utility>

#include "io/image/as_bgr.h"
#include "io/image/decode_image.h"
#include "io/image/image_header.h"
#include "io/input_error.h"
#include "io/read_file.h"
#include "slam/base/require.h"

namespace slam {
namespace {

constexpr std::uintmax_t kMaxBytes = 512u << 20;  // 8192^2 pixels of 16 bits, and some

constexpr const char* kMakeDepth =
    "depth must be a PNG of 16-bit gray (depth_factor units a metre, 0 where nothing was "
    "measured)";

/// What a file that is neither PNG nor JPEG begins like; empty when that is not known.
std::string OtherFormat(std::string_view bytes) {
  using namespace std::string_view_literals;
  constexpr std::array<std::pair<std::string_view, const char*>, 8> kFormats = {
      {{"II*\0"sv, "a TIFF"},
       {"MM\0*"sv, "a TIFF"},
       {"\x76\x2F\x31\x01"sv, "an OpenEXR image"},
       {"\x93NUMPY"sv, "a NumPy array"},
       {"Pf\n"sv, "a PFM"},
       {"P5\n"sv, "a PGM"},
       {"P6\n"sv, "a PPM"},
       {"BM"sv, "a BMP"}}};
  for (const auto& [begin, name] : kFormats) {
    if (bytes.starts_with(begin)) return name;
  }
  return "";
}

[[noreturn]] void RefuseFormat(std::string_view bytes, bool colour, const std::string& where) {
  const std::string format = OtherFormat(bytes);
  const std::string expected = std::string("not a PNG ") + (colour ? "or JPEG " : "") + "image";
  if (format.empty()) throw io::InputError(where, expected + " (or cut off in its header)");
  throw io::InputError(where, "is " + format + ", " + expected + "; convert it: " +
                                  (colour ? "colour must have 8 bits a channel" : kMakeDepth));
}

/// How to mend an image of other pixels than are wanted.
std::string MendPixels(const io::ImageHeader& header, bool colour) {
  const std::string swapped = ": are colour and depth swapped in the list of images?";
  if (colour) {
    if (header.pixels == "16-bit gray") return "it looks like depth" + swapped;
    return header.pixels == "8-bit CMYK" ? "save it as RGB" : "save it with 8 bits a channel";
  }
  if (header.pixels == "8-bit RGB") return "it looks like colour" + swapped;
  if (header.pixels == "8-bit gray") {
    return "8 bits are a picture of depth, not depth: write it with 16 bits, not scaled";
  }
  return "convert it, without scaling";
}

/// How to mend an image of another size than the camera's.
std::string MendSize(const io::ImageHeader& header, const Camera& camera, bool colour) {
  if (header.width == camera.height && header.height == camera.width) {
    return "; one of the two is turned: turn the images, or swap width and height, fx and fy, "
           "cx "
           "and cy of the camera";
  }
  return colour ? "; mend the camera file or the image"
                : "; depth must lie on colour, pixel on pixel, and the camera is that of both "
                  "(docs/cameras.md)";
}

/// Refuses a file that is no whole image of the camera's size and the type wanted.
void CheckHeader(std::string_view bytes, ImageType type, const Camera& camera,
                 const std::string& where) {
  const bool colour = type == ImageType::kColour;
  if (bytes.empty()) throw io::InputError(where, "the file is empty (0 bytes); copy it again");
  const std::optional<io::ImageHeader> header = io::ReadImageHeader(bytes);
  if (!header) RefuseFormat(bytes, colour, where);
  if (header->format == io::ImageFormat::kJpeg && !colour) {
    throw io::InputError(
        where, std::string("the image is a JPEG, which does not keep depth; ") + kMakeDepth);
  }
  if (header->width != camera.width || header->height != camera.height)
    throw io::InputError(where, "the image is " + std::to_string(header->width) + " x " +
                                    std::to_string(header->height) + ", the camera says " +
                                    std::to_string(camera.width) + " x " +
                                    std::to_string(camera.height) +
                                    MendSize(*header, camera, colour));
  const std::string& pixels = header->pixels;
  const bool wanted = colour ? pixels == "8-bit RGB" || pixels == "8-bit gray" ||
                                   pixels == "8-bit RGB with alpha" ||
                                   pixels == "8-bit gray with alpha"
                             : pixels == "16-bit gray";
  if (!wanted)
    throw io::InputError(
        where, "the image is " + pixels + ", expected " +
                   (colour ? "8-bit RGB or gray" : "16-bit gray (depth_factor units a metre)") +
                   "; " + MendPixels(*header, colour));
  if (!header->whole)
    throw io::InputError(where, "the image is truncated (its end is missing); copy it again");
}

}  // namespace

cv::Mat ReadImage(const std::filesystem::path& file, ImageType type, const Camera& camera,
                  const std::string& context) {
  const std::string where = file.string() + " (" + context + ")";
  const std::string bytes = io::ReadFile(file, "expected the image of " + context, kMaxBytes);
  CheckHeader(bytes, type, camera, where);
  const bool colour = type == ImageType::kColour;
  const cv::Mat decoded = io::DecodeImage(bytes), image = colour ? io::AsBgr(decoded) : decoded;
  const int expected = colour ? CV_8UC3 : CV_16UC1;
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
