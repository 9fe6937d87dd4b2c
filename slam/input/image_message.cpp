#include "slam/input/image_message.h"

#include <bit>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "io/input_error.h"
#include "slam/input/image_file.h"

namespace slam {
namespace {

static_assert(std::endian::native == std::endian::little, "pixels are taken as they are");

std::string SizeText(int width, int height) {
  return std::to_string(width) + " x " + std::to_string(height);
}

/// The image's bytes as pixels, without a copy.
/// @throws InputError when they are not of that size, or too few
cv::Mat PixelsOf(const BagImage& image, int type, cv::Size size, const std::string& where) {
  if (image.width != size.width || image.height != size.height) {
    throw io::InputError(where, "the image is " + SizeText(image.width, image.height) +
                                    ", the camera says " + SizeText(size.width, size.height) +
                                    "; give the camera of this recording with --camera");
  }
  if (image.big_endian && CV_ELEM_SIZE1(type) > 1) {
    throw io::InputError(where,
                         "the pixels are big-endian, expected little-endian; record the "
                         "bag on a machine of that kind");
  }
  const std::size_t row = static_cast<std::size_t>(image.width) * CV_ELEM_SIZE(type);
  const auto rows = static_cast<std::size_t>(image.height);
  if (image.step < row || image.step > image.data.size() ||
      image.data.size() < image.step * (rows - 1) + row) {
    throw io::InputError(where, "the image has " + std::to_string(image.data.size()) +
                                    " bytes, too few for " +
                                    SizeText(image.width, image.height) + " pixels of " +
                                    image.encoding + "; copy the bag again");
  }
  if (image.step % CV_ELEM_SIZE1(type) != 0) {
    throw io::InputError(where, "its rows are " + std::to_string(image.step) +
                                    " bytes apart, which is no whole number of samples of " +
                                    image.encoding + "; record the bag again");
  }
  return {size, type, const_cast<std::uint8_t*>(image.data.data()), image.step};
}

[[noreturn]] void RefuseEncoding(const BagImage& image, const char* expected,
                                 const std::string& where) {
  throw io::InputError(where, "the encoding is " + io::Quoted(image.encoding) + ", expected " +
                                  expected + "; record it so");
}

}  // namespace

cv::Mat3b BgrOf(const BagImage& image, cv::Size size, const std::string& where) {
  cv::Mat3b bgr;
  const auto converted = [&](int type, int code) {
    cv::cvtColor(PixelsOf(image, type, size, where), bgr, code);
    return bgr;
  };
  if (image.encoding == "rgb8") return converted(CV_8UC3, cv::COLOR_RGB2BGR);
  if (image.encoding == "rgba8") return converted(CV_8UC4, cv::COLOR_RGBA2BGR);
  if (image.encoding == "bgra8") return converted(CV_8UC4, cv::COLOR_BGRA2BGR);
  if (image.encoding == "mono8" || image.encoding == "8UC1") {
    return converted(CV_8UC1, cv::COLOR_GRAY2BGR);
  }
  if (image.encoding == "bgr8" || image.encoding == "8UC3") {
    return PixelsOf(image, CV_8UC3, size, where).clone();
  }
  RefuseEncoding(image, "rgb8, bgr8, rgba8, bgra8 or mono8", where);
}

cv::Mat1f DepthOf(const BagImage& image, cv::Size size, double depth_factor,
                  const std::string& where) {
  if (image.encoding == "16UC1" || image.encoding == "mono16") {
    return DepthInMetres(PixelsOf(image, CV_16UC1, size, where), depth_factor);
  }
  if (image.encoding != "32FC1") RefuseEncoding(image, "32FC1, 16UC1 or mono16", where);
  cv::Mat1f depth_m = PixelsOf(image, CV_32FC1, size, where).clone();
  for (float& z_m : depth_m) {
    if (!std::isfinite(z_m)) z_m = 0.0f;
  }
  return depth_m;
}

}  // namespace slam
