#include "eval/check/check_images.h"

#include <fmt/format.h>

#include <array>
#include <fstream>
#include <iterator>
#include <opencv2/imgcodecs.hpp>
#include <set>

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

bool Exists(const FolderCheck& check, const ListedImage& image) {
  return check.Has(image.file);  // a missing one is the list's fault, reported there
}

}  // namespace

cv::Mat CheckImage(FolderCheck& check, const std::string& file, const ImageKind& kind) {
  std::ifstream in(check.root / file, std::ios::binary);
  const std::vector<unsigned char> bytes((std::istreambuf_iterator<char>(in)),
                                         std::istreambuf_iterator<char>());
  check.files.insert(file);
  if (!IsWholePng(bytes)) {
    check.broken.insert(file);
    check.Add(file, 0, "is not a whole PNG file", "write the image again");
    return {};
  }
  cv::Mat image;
  try {
    image = cv::imdecode(bytes, cv::IMREAD_UNCHANGED);
  } catch (const cv::Exception&) {
    image.release();
  }
  if (image.empty()) {
    check.broken.insert(file);
    check.Add(file, 0, "cannot be decoded", "write the image again");
    return {};
  }
  if (image.depth() != kind.depth || image.channels() != kind.channels) {
    check.broken.insert(file);
    check.Add(file, 0,
              fmt::format("is {}; expected {}", TypeName(image.depth(), image.channels()),
                          TypeName(kind.depth, kind.channels)),
              "convert the image");
    return {};
  }
  if (!kind.size.empty() && image.size() != kind.size) {
    check.broken.insert(file);
    check.Add(file, 0,
              fmt::format("is {} x {}; expected {} x {}", image.cols, image.rows,
                          kind.size.width, kind.size.height),
              "use images of one size, the one in camera.yaml when there is one");
    return {};
  }
  return image;
}

cv::Size CheckListedImages(FolderCheck& check, const std::vector<ListedImage>& rgb,
                           const std::vector<ListedImage>& depth, cv::Size size) {
  std::set<std::string> done;
  const auto check_all = [&](const std::vector<ListedImage>& images, int type, int channels) {
    for (const ListedImage& listed : images) {
      if (!Exists(check, listed) || !done.insert(listed.file).second) continue;
      const cv::Mat image = CheckImage(check, listed.file, {type, channels, size});
      if (size.empty()) size = image.size();
    }
  };
  check_all(rgb, CV_8U, 3);
  check_all(depth, CV_16U, 1);
  return size;
}

}  // namespace eval
