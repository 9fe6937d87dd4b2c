#pragma once

#include <filesystem>
#include <opencv2/core/mat.hpp>

#include "io/atomic_file.h"
#include "io/image/decode_image.h"
#include "io/image/encode_png.h"
#include "io/read_file.h"

namespace test_support {

inline cv::Mat ReadImageFile(const std::filesystem::path& file) {
  return io::DecodeImage(io::ReadFile(file));
}

inline void WriteImageFile(const std::filesystem::path& file, const cv::Mat& image) {
  io::WriteFile(file, io::EncodePng(image));
}

}  // namespace test_support
