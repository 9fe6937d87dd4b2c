#pragma once

#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

namespace io {

/// Expects an image to be what OpenCV decodes of the file, bit for bit. @param mode  of cv::imdecode
inline void ExpectAsOpenCvHasIt(const cv::Mat& image, const std::string& file, int mode,
                                const std::string& what) {
  const cv::Mat expected = cv::imdecode(std::vector<uchar>(file.begin(), file.end()), mode);
  ASSERT_FALSE(expected.empty()) << what;
  ASSERT_EQ(image.type(), expected.type()) << what;
  ASSERT_EQ(image.size(), expected.size()) << what;
  EXPECT_EQ(cv::norm(image, expected, cv::NORM_INF), 0) << what;
}

}  // namespace io
