#include "eval/formats/sequence/images.h"

#include <fmt/format.h>

#include <algorithm>

#include "io/image/as_bgr.h"
#include "io/image/decode_image.h"
#include "io/image/image_header.h"
#include "io/input_error.h"
#include "io/read_file.h"

namespace eval {
namespace {

constexpr int kMaxImageSide_px = 8192;  // the largest camera that a camera.yaml may describe

std::string TypeName(int depth, int channels) {
  const char* bits = depth == CV_8U       ? "8-bit"
                     : depth == CV_16U    ? "16-bit"
                     : depth == kAnyDepth ? "8-bit or 16-bit"
                                          : "other";
  if (channels == kAnyColour) return fmt::format("{} RGB or gray", bits);
  return fmt::format("{} with {} channel{}", bits, channels, channels == 1 ? "" : "s");
}

/// Whether the header asks for no more pixels than an image may have: a few bytes could ask for
/// gigabytes.
bool IsOfSensibleSize(const io::ImageHeader& header) {
  return header.width > 0 && header.height > 0 && header.width <= kMaxImageSide_px &&
         header.height <= kMaxImageSide_px;
}

cv::Mat Decode(Folder& folder, const std::string& file, bool is_colour) {
  std::string bytes;
  if (!folder.Try(file, [&] { bytes = io::ReadFile(folder.Open(file)); })) return {};
  const auto header = io::ReadImageHeader(bytes);
  if (!header || !header->whole || (header->format == io::ImageFormat::kJpeg && !is_colour)) {
    folder.Tell(file, 0,
                is_colour ? "is not a whole PNG or JPEG file" : "is not a whole PNG file",
                "write the image again");
    return {};
  }
  if (!IsOfSensibleSize(*header)) {
    folder.Tell(file, 0,
                fmt::format("its header asks for more than {0} x {0} pixels, or for none",
                            kMaxImageSide_px),
                "write the image again");
    return {};
  }
  cv::Mat image = io::DecodeImage(bytes);
  if (image.empty()) folder.Tell(file, 0, "cannot be decoded", "write the image again");
  return image;
}

}  // namespace

cv::Mat ReadImage(Folder& folder, const std::string& file, const ImageKind& kind) {
  cv::Mat image = Decode(folder, file, kind.depth == CV_8U && kind.channels == kAnyColour);
  if (image.empty()) return image;
  const bool right_depth = kind.depth == kAnyDepth
                               ? image.depth() == CV_8U || image.depth() == CV_16U
                               : image.depth() == kind.depth;
  const bool right_channels = kind.channels == kAnyColour || image.channels() == kind.channels;
  if (!right_depth || !right_channels) {
    folder.Tell(file, 0,
                fmt::format("is {}; expected {}", TypeName(image.depth(), image.channels()),
                            TypeName(kind.depth, kind.channels)),
                "convert the image");
    return {};
  }
  if (!kind.size.empty() && image.size() != kind.size) {
    folder.Tell(file, 0,
                fmt::format("is {} x {}; expected {} x {}", image.cols, image.rows,
                            kind.size.width, kind.size.height),
                "use images of one size, the one in camera.yaml when there is one");
    return {};
  }
  return image;
}

void PixelSet::Add(int u, int v) {
  if (count == 0) {
    x0 = x1 = u;
    y0 = y1 = v;
  }
  ++count;
  x0 = std::min(x0, u), x1 = std::max(x1, u);
  y0 = std::min(y0, v), y1 = std::max(y1, v);
}

std::map<int, PixelSet> PixelsOfIds(const cv::Mat1w& ids) {
  std::map<int, PixelSet> pixels;
  for (int v = 0; v < ids.rows; ++v) {
    for (int u = 0; u < ids.cols; ++u) {
      if (ids(v, u) != 0) pixels[ids(v, u)].Add(u, v);
    }
  }
  return pixels;
}

cv::Mat ReadColour(const std::filesystem::path& file) {
  const std::string bytes = io::ReadFile(
      file,
      "expected a colour image (a run of pas slam --live keeps none: pas sim renders them)");
  const auto header = io::ReadImageHeader(bytes);
  if (!header) throw io::InputError(file.string(), "is no PNG or JPEG image; copy it again");
  if (!IsOfSensibleSize(*header)) {
    throw io::InputError(
        file.string(),
        fmt::format("says that it is {} x {} pixels; expected at most {} a side: "
                    "copy it again",
                    header->width, header->height, kMaxImageSide_px));
  }
  const cv::Mat image = header->whole ? io::AsBgr(io::DecodeImage(bytes)) : cv::Mat();
  if (image.empty()) {
    throw io::InputError(file.string(), "is damaged and cannot be decoded; copy it again");
  }
  if (image.type() != CV_8UC3) {
    throw io::InputError(file.string(), "is " + header->pixels +
                                            "; expected 8-bit RGB or gray: convert the image");
  }
  return image;
}

cv::Mat1w ReadLabels(const std::filesystem::path& file, const ImageKind& kind) {
  Folder folder(file.parent_path());
  cv::Mat1w labels;
  ReadImage(folder, file.filename().string(), kind).convertTo(labels, CV_16U);
  return labels;
}

}  // namespace eval
