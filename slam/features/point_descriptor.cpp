#include "slam/features/point_descriptor.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <numbers>
#include <opencv2/features2d.hpp>

#include "slam/base/lanes.h"
#include "slam/base/require.h"

namespace slam {
namespace {

constexpr int kRadius_px = 15;  // patch of 31 x 31 pixels: Rublee et al. 2011
constexpr int kPatch_px = 2 * kRadius_px + 1;

/// Weights of a row of the patch in its moments: 1 in the disc, and dx there.
constexpr int kRow_px = 32;  // from -kRadius_px on; the last is beyond the disc
struct RowWeights {
  std::array<std::int16_t, kRow_px> one{}, dx{};
};
constexpr std::array<RowWeights, kRadius_px + 1> DiscRows() {
  std::array<RowWeights, kRadius_px + 1> rows{};
  for (int dy = 0; dy <= kRadius_px; ++dy) {
    for (int dx = -kRadius_px; dx <= kRadius_px; ++dx) {
      if (dx * dx + dy * dy > kRadius_px * kRadius_px) continue;
      RowWeights& row = rows[static_cast<std::size_t>(dy)];
      row.one[static_cast<std::size_t>(dx + kRadius_px)] = 1;
      row.dx[static_cast<std::size_t>(dx + kRadius_px)] = static_cast<std::int16_t>(dx);
    }
  }
  return rows;
}
constexpr std::array<RowWeights, kRadius_px + 1> kDisc = DiscRows();

}  // namespace

/// Moments of the patch around a pixel.
/// @param stride  bytes from one row of the image to the next
SLAM_LANES static void Moments(const std::uint8_t* center, std::ptrdiff_t stride, int& m10,
                               int& m01) {
  m10 = m01 = 0;
  for (int dy = -kRadius_px; dy <= kRadius_px; ++dy) {
    const RowWeights& weights = kDisc[static_cast<std::size_t>(std::abs(dy))];
    const std::uint8_t* row = center + dy * stride - kRadius_px;
    int sum = 0, moment = 0;
    for (std::size_t k = 0; k < kRow_px; ++k) {
      sum += weights.one[k] * row[k];
      moment += weights.dx[k] * row[k];
    }
    m10 += moment, m01 += dy * sum;
  }
}

float PatchAngle(const PyramidImage& octave, int x, int y) {
  int m10 = 0, m01 = 0;
  Moments(octave.padded.ptr(y + kPyramidPadding_px) + x + kPyramidPadding_px,
          static_cast<std::ptrdiff_t>(octave.padded.step), m10, m01);
  const double degrees =
      std::atan2(static_cast<double>(m01), static_cast<double>(m10)) * 180.0 / std::numbers::pi;
  const float angle = static_cast<float>(degrees < 0 ? degrees + 360.0 : degrees);
  return angle < 360.0f ? angle : 0.0f;
}

std::vector<Descriptor> DescribePoints(const PyramidImage& octave,
                                       const std::vector<cv::KeyPoint>& corners) {
  if (corners.empty()) return {};
  // OpenCV describes the corners on the padded octave, as an image of one octave.
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
