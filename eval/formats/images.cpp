#include "eval/formats/images.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <opencv2/imgcodecs.hpp>
#include <vector>

namespace eval {
namespace {

std::string TypeName(int depth, int channels) {
  const char* bits = depth == CV_8U ? "8-bit" : depth == CV_16U ? "16-bit" : "other";
  return fmt::format("{} with {} channel{}", bits, channels, channels == 1 ? "" : "s");
}

// A PNG ends with an empty IEND chunk; decoders fill up what is missing before it.
bool IsWholePng(const std::vector<unsigned char>& bytes) {
  constexpr std::array<unsigned char, 8> kSignature{0x89, 'P',  'N',  'G',
                                                    '\r', '\n', 0x1a, '\n'};
  constexpr std::array<unsigned char, 12> kEnd{0,   0,   0,    0,    'I',  'E',
                                               'N', 'D', 0xae, 0x42, 0x60, 0x82};
  return bytes.size() > kSignature.size() + kEnd.size() &&
         std::equal(kSignature.begin(), kSignature.end(), bytes.begin()) &&
         std::equal(kEnd.begin(), kEnd.end(), bytes.end() - kEnd.size());
}

cv::Mat Decode(Folder& folder, const std::string& file) {
  std::ifstream in(folder.Open(file), std::ios::binary);
  const std::vector<unsigned char> bytes((std::istreambuf_iterator<char>(in)),
                                         std::istreambuf_iterator<char>());
  cv::Mat image;
  if (!IsWholePng(bytes)) {
    folder.Tell(file, 0, "is not a whole PNG file", "write the image again");
    return image;
  }
  try {
    image = cv::imdecode(bytes, cv::IMREAD_UNCHANGED);
  } catch (const cv::Exception&) {
    image.release();
  }
  if (image.empty()) folder.Tell(file, 0, "cannot be decoded", "write the image again");
  return image;
}

}  // namespace

cv::Mat ReadImage(Folder& folder, const std::string& file, const ImageKind& kind) {
  cv::Mat image = Decode(folder, file);
  if (image.empty()) return image;
  if (image.depth() != kind.depth || image.channels() != kind.channels) {
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

cv::Mat1w ReadLabels(const std::filesystem::path& file, const ImageKind& kind) {
  Folder folder(file.parent_path());
  cv::Mat1w labels;
  ReadImage(folder, file.filename().string(), kind).convertTo(labels, CV_16U);
  return labels;
}

}  // namespace eval
