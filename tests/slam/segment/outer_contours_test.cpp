#include "slam/segment/edges/outer_contours.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace slam {
namespace {

/// Blobs of four labels with holes, islands in the holes, threads and single pixels.
cv::Mat1b TangledLabels(int seed) {
  cv::Mat1b labels(61, 83, static_cast<std::uint8_t>(0));
  cv::RNG random(static_cast<std::uint64_t>(seed) + 1);
  for (int k = 0; k < 60; ++k) {
    const cv::Point at(random.uniform(0, 83), random.uniform(0, 61));
    const cv::Size size(random.uniform(0, 18), random.uniform(0, 14));
    const int label = random.uniform(0, 5);
    cv::ellipse(labels, at, size, random.uniform(0, 180), 0, 360, cv::Scalar(label),
                k % 3 == 0 ? 1 : cv::FILLED);
  }
  return labels;
}

TEST(OuterContours, AreThoseOfEachSegmentAlone) {
  int nested = 0;
  for (int seed = 0; seed < 30; ++seed) {
    const cv::Mat1b labels = TangledLabels(seed);
    OuterContours found;
    found.Trace(labels);
    std::size_t next = 0;
    for (int label = 1; label < 5; ++label) {
      cv::Mat1b mask;
      cv::copyMakeBorder(labels == label, mask, 1, 1, 1, 1, cv::BORDER_CONSTANT, 0);
      std::vector<std::vector<cv::Point>> expected, all;
      cv::findContours(mask, expected, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE, {-1, -1});
      cv::findContours(mask, all, cv::RETR_CCOMP, cv::CHAIN_APPROX_NONE);
      nested += all.size() > expected.size() ? 1 : 0;
      std::stable_sort(expected.begin(), expected.end(),
                       [](const auto& a, const auto& b) { return a.size() > b.size(); });
      for (const std::vector<cv::Point>& contour : expected) {
        ASSERT_LT(next, found.contours().size());
        const OuterContours::Contour& own = found.contours()[next++];
        EXPECT_EQ(own.label, label);
        const auto first = found.points().begin();
        EXPECT_EQ(contour,
                  std::vector<cv::Point>(first + static_cast<std::ptrdiff_t>(own.begin),
                                         first + static_cast<std::ptrdiff_t>(own.end)))
            << "seed " << seed;
      }
    }
    EXPECT_EQ(next, found.contours().size());
  }
  EXPECT_GT(nested, 60) << "there must be holes to be mistaken about";
}

TEST(OuterContours, PointAwayFromTheirOwnSegment) {
  const cv::Mat1b labels = TangledLabels(3);
  cv::Mat1b framed;
  cv::copyMakeBorder(labels, framed, 2, 2, 2, 2, cv::BORDER_CONSTANT, 0);
  OuterContours contours;
  contours.Trace(labels);
  ASSERT_FALSE(contours.points().empty());
  for (const cv::Point& at : contours.points()) {
    cv::Point expected(0, 0);
    for (int dv = -2; dv <= 2; ++dv) {
      for (int du = -2; du <= 2; ++du) {
        const bool outside = framed(at.y + 2 + dv, at.x + 2 + du) != labels(at);
        expected += outside ? cv::Point(du, dv) : cv::Point(0, 0);
      }
    }
    EXPECT_EQ(contours.Outward(at), expected);
  }
}

TEST(OuterContours, PointToTheOutsideAcrossTheImagesBorderToo) {
  cv::Mat1b labels(20, 20, static_cast<std::uint8_t>(2));
  labels(cv::Rect(10, 0, 10, 20)).setTo(1);
  OuterContours contours;
  contours.Trace(labels);
  EXPECT_EQ(contours.Outward({9, 10}), cv::Point(15, 0));
  EXPECT_EQ(contours.Outward({5, 0}), cv::Point(0, -15));
  EXPECT_EQ(contours.Outward({5, 5}), cv::Point(0, 0));
}

}  // namespace
}  // namespace slam
