#include "slam/extract/point_descriptor.h"

#include <array>
#include <cmath>
#include <cstring>
#include <numbers>
#include <opencv2/features2d.hpp>

#include "slam/base/require.h"

namespace slam {
namespace {

constexpr int kRadius_px = 15;
constexpr int kPatch_px = 2 * kRadius_px + 1;

/// Half width of the disc's row at height |dy|.
constexpr std::array<int, kRadius_px + 1> DiscRows() {
  std::array<int, kRadius_px + 1> half{};
  for (int dy = 0; dy <= kRadius_px; ++dy) {
    int dx = 0;
    while ((dx + 1) * (dx + 1) + dy * dy <= kRadius_px * kRadius_px) ++dx;
    half[static_cast<std::size_t>(dy)] = dx;
  }
  return half;
}

}  // namespace

float PatchAngle(const PyramidImage& octave, int x, int y) {
  constexpr std::array<int, kRadius_px + 1> kHalf = DiscRows();
  int m10 = 0, m01 = 0;
  for (int dy = -kRadius_px; dy <= kRadius_px; ++dy) {
    const int half = kHalf[static_cast<std::size_t>(std::abs(dy))];
    const std::uint8_t* row =
        octave.padded.ptr(y + dy + kPyramidPadding_px) + x + kPyramidPadding_px;
    int sum = 0;
    for (int dx = -half; dx <= half; ++dx) {
      sum += row[dx];
      m10 += dx * row[dx];
    }
    m01 += dy * sum;
  }
  const double degrees =
      std::atan2(static_cast<double>(m01), static_cast<double>(m10)) * 180.0 / std::numbers::pi;
  const float angle = static_cast<float>(degrees < 0 ? degrees + 360.0 : degrees);
  return angle < 360.0f ? angle : 0.0f;
}

std::vector<Descriptor> DescribePoints(const PyramidImage& octave,
                                       const std::vector<cv::KeyPoint>& corners) {
  if (corners.empty()) return {};
  std::vector<cv::KeyPoint> padded = corners;
  for (cv::KeyPoint& corner : padded) {
    corner.pt.x += static_cast<float>(kPyramidPadding_px);
    corner.pt.y += static_cast<float>(kPyramidPadding_px);
    corner.octave = 0;
    corner.size = static_cast<float>(kPatch_px);
  }
  // The padding is wider than the edge threshold, so that no corner is dropped.
  constexpr int kEdge_px = 4;
  const auto orb = cv::ORB::create(static_cast<int>(corners.size()), 1.2f, 1, kEdge_px, 0, 2,
                                   cv::ORB::HARRIS_SCORE, kPatch_px);
  cv::Mat rows;
  orb->compute(octave.padded, padded, rows);
  Require(rows.rows == static_cast<int>(corners.size()),
          "DescribePoints: a corner was dropped");

  std::vector<Descriptor> descriptors(corners.size());
  for (std::size_t i = 0; i < corners.size(); ++i) {
    std::memcpy(descriptors[i].data(), rows.ptr(static_cast<int>(i)), descriptors[i].size());
  }
  return descriptors;
}

}  // namespace slam
