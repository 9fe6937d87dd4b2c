#include "slam/features/image_pyramid.h"

#include <opencv2/imgproc.hpp>

namespace slam {
namespace {

// Below this there is no room for a descriptor's patch.
constexpr int kMinSide_px = 24;

PyramidImage Pad(const cv::Mat1b& image, const cv::Size& full) {
  constexpr int kPad = kPyramidPadding_px;
  PyramidImage octave;
  octave.scale_u = static_cast<double>(full.width) / image.cols;
  octave.scale_v = static_cast<double>(full.height) / image.rows;
  cv::copyMakeBorder(image, octave.padded, kPad, kPad, kPad, kPad, cv::BORDER_REFLECT_101);
  octave.image = octave.padded(cv::Rect(kPad, kPad, image.cols, image.rows));
  return octave;
}

}  // namespace

std::vector<PyramidImage> BuildImagePyramid(const cv::Mat1b& image, const FeatureScale& scale) {
  std::vector<PyramidImage> octaves;
  cv::Mat1b current = image;
  for (int o = 0; o < scale.octaves; ++o) {
    const double factor = scale.Scale(o);
    const cv::Size size(cvRound(image.cols / factor), cvRound(image.rows / factor));
    if (std::min(size.width, size.height) < kMinSide_px) break;
    if (o > 0) {
      cv::Mat1b smaller;
      cv::resize(current, smaller, size, 0, 0, cv::INTER_LINEAR);
      current = smaller;
    }
    octaves.push_back(Pad(current, image.size()));
  }
  return octaves;
}

}  // namespace slam
