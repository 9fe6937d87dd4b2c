#include "sim/write/preview.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

namespace sim {
namespace {

/// Four by two pixels of three planes and a thing without planes. Two of the planes are of one
/// object, one is of another; the last pixel shows nothing.
SimulatedFrame TinyFrame() {
  SimulatedFrame frame;
  frame.colour.create(2, 4);
  for (int i = 0; i < 8; ++i) frame.colour(i / 4, i % 4) = cv::Vec3b::all(uchar(20 * i + 10));
  frame.depth = (cv::Mat1w(2, 4) << 5000, 6000, 7000, 8000, 5000, 6000, 9000, 0);
  frame.plane_id = (cv::Mat1w(2, 4) << 1, 2, 3, 0, 1, 2, 3, 0);
  frame.object_id = (cv::Mat1w(2, 4) << 4, 4, 5, 6, 4, 4, 5, 0);
  return frame;
}

/// Pixels have one colour where they have one id, and are black where there is none.
void ExpectColoursOf(const cv::Mat3b& part, const cv::Mat1w& ids) {
  ASSERT_EQ(part.size(), ids.size());
  for (int i = 0; i < 8; ++i) {
    const cv::Vec3b colour = part(i / 4, i % 4);
    EXPECT_EQ(colour == cv::Vec3b(0, 0, 0), ids(i / 4, i % 4) == 0) << i;
    for (int k = 0; k < i; ++k) {
      EXPECT_EQ(colour == part(k / 4, k % 4), ids(i / 4, i % 4) == ids(k / 4, k % 4))
          << i << " and " << k;
    }
  }
}

TEST(PreviewPicture, ShowsColourAndDepthAboveAndIdsOfPlanesAndOfObjectsBelow) {
  const SimulatedFrame frame = TinyFrame();
  const cv::Mat3b picture = PreviewPicture(frame);
  ASSERT_EQ(picture.size(), cv::Size(8, 4));
  const cv::Mat3b colour = picture(cv::Rect(0, 0, 4, 2)), depth = picture(cv::Rect(4, 0, 4, 2));
  EXPECT_EQ(cv::norm(colour, frame.colour, cv::NORM_INF), 0.0);
  const cv::Vec3b nearest = depth(0, 0), farthest = depth(1, 2);
  EXPECT_GT(nearest[2], nearest[0]) << "red";
  EXPECT_GT(farthest[0], farthest[2]) << "blue";
  EXPECT_EQ(depth(1, 3), cv::Vec3b(0, 0, 0)) << "not measured";
  ExpectColoursOf(picture(cv::Rect(0, 2, 4, 2)), frame.plane_id);
  ExpectColoursOf(picture(cv::Rect(4, 2, 4, 2)), frame.object_id);
}

}  // namespace
}  // namespace sim
