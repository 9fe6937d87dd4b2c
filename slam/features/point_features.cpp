#include "slam/features/point_features.h"

#include <algorithm>
#include <cmath>
#include <opencv2/features2d.hpp>

#include "slam/base/require.h"
#include "slam/features/image_pyramid.h"
#include "slam/features/point_descriptor.h"
#include "slam/features/point_spread.h"

namespace slam {
namespace {

/// Corners this near to an octave's border are left out: 16 pixels as the descriptor's patch
/// asks, less in small images, where that would leave no image.
int BorderOf(const cv::Size& size) {
  constexpr int kBorder_px = 16, kMinBorder_px = 4, kBorders = 15;  // of a side
  return std::clamp(std::min(size.width, size.height) / kBorders, kMinBorder_px, kBorder_px);
}

/// FAST in a rectangle of the octave; positions on the octave's image, row by row.
std::vector<cv::KeyPoint> Corners(const cv::Mat1b& image, const cv::Rect& area, int threshold) {
  // The detector needs a ring of 3 pixels around every corner.
  constexpr int kRing_px = 3;
  const cv::Rect with_ring(area.x - kRing_px, area.y - kRing_px, area.width + 2 * kRing_px,
                           area.height + 2 * kRing_px);
  std::vector<cv::KeyPoint> corners;
  cv::FAST(image(with_ring), corners, threshold, true);
  for (cv::KeyPoint& corner : corners) {
    corner.pt.x += static_cast<float>(with_ring.x);
    corner.pt.y += static_cast<float>(with_ring.y);
  }
  return corners;
}

/// Corners of one octave: with the high threshold everywhere, with the low one in the cells
/// that stayed empty.
std::vector<cv::KeyPoint> CornersOfOctave(const cv::Mat1b& image, const cv::Rect& area,
                                          const PointFeatureConfig& config) {
  std::vector<cv::KeyPoint> corners = Corners(image, area, config.fast_threshold);
  const int columns = std::max(1, area.width / config.cell_px);
  const int rows = std::max(1, area.height / config.cell_px);
  const auto left = [&](int c) { return area.x + c * area.width / columns; };
  const auto top = [&](int r) { return area.y + r * area.height / rows; };

  // Which cells have a corner already: the last that begins at or before the corner's pixel.
  const auto cell_at = [](int pixel, int cells, int length) {
    return ((pixel + 1) * cells - 1) / length;
  };
  cv::Mat1b occupied(rows, columns, std::uint8_t{0});
  for (const cv::KeyPoint& corner : corners) {
    const int c = cell_at(static_cast<int>(corner.pt.x) - area.x, columns, area.width);
    const int r = cell_at(static_cast<int>(corner.pt.y) - area.y, rows, area.height);
    occupied(std::clamp(r, 0, rows - 1), std::clamp(c, 0, columns - 1)) = 1;
  }
  // The empty cells are asked again with the low threshold.
  const auto strong = static_cast<std::ptrdiff_t>(corners.size());
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < columns; ++c) {
      if (occupied(r, c) != 0) continue;
      const cv::Rect cell(left(c), top(r), left(c + 1) - left(c), top(r + 1) - top(r));
      const auto weak = Corners(image, cell, config.min_fast_threshold);
      corners.insert(corners.end(), weak.begin(), weak.end());
    }
  }
  // One order for both: row by row.
  const auto by_row = [](const cv::KeyPoint& a, const cv::KeyPoint& b) {
    return a.pt.y != b.pt.y ? a.pt.y < b.pt.y : a.pt.x < b.pt.x;
  };
  std::sort(corners.begin() + strong, corners.end(), by_row);
  std::inplace_merge(corners.begin(), corners.begin() + strong, corners.end(), by_row);
  return corners;
}

/// Whether an image patch tells its place in both directions: along a straight edge every patch
/// looks like the next. The ratio of the structure tensor's eigenvalues is bounded as in SIFT
/// (Lowe 2004, section 4.1).
bool TellsItsPlace(const cv::Mat1b& padded, int x, int y) {
  constexpr int kRadius_px = 3;       // that of FAST's ring
  constexpr double kMaxRatio = 10.0;  // Lowe 2004
  double xx = 0.0, xy = 0.0, yy = 0.0;
  for (int v = y - kRadius_px; v <= y + kRadius_px; ++v) {
    const std::uint8_t* above = padded[v - 1];
    const std::uint8_t* here = padded[v];
    const std::uint8_t* below = padded[v + 1];
    int row_xx = 0, row_xy = 0, row_yy = 0;
    for (int u = x - kRadius_px; u <= x + kRadius_px; ++u) {
      const int dx = here[u + 1] - here[u - 1], dy = below[u] - above[u];
      row_xx += dx * dx, row_xy += dx * dy, row_yy += dy * dy;
    }
    xx += row_xx, xy += row_xy, yy += row_yy;
  }
  const double trace = xx + yy, determinant = xx * yy - xy * xy;
  return trace * trace * kMaxRatio < (kMaxRatio + 1) * (kMaxRatio + 1) * determinant;
}

/// Features wanted of each octave, in proportion to its side length.
std::vector<int> Shares(const FeatureScale& scale, std::size_t octaves, int count) {
  double sum = 0.0;
  for (std::size_t o = 0; o < octaves; ++o) sum += 1.0 / scale.Scale(static_cast<int>(o));
  std::vector<int> shares;
  for (std::size_t o = 0; o < octaves; ++o) {
    shares.push_back(cvRound(count / (sum * scale.Scale(static_cast<int>(o)))));
  }
  return shares;
}

PointFeature MakeFeature(const cv::KeyPoint& corner, const Descriptor& descriptor, int octave,
                         const PyramidImage& image, const Camera& camera) {
  // Pixel centres are integers in every octave; the half pixel keeps them aligned.
  const Eigen::Vector2d recorded_px((corner.pt.x + 0.5) * image.scale_u - 0.5,
                                    (corner.pt.y + 0.5) * image.scale_v - 0.5);
  PointFeature feature;
  feature.u_px = camera.Undistort(recorded_px);
  feature.octave = octave;
  feature.angle_deg = corner.angle;
  feature.descriptor = descriptor;
  feature.on_edge = !TellsItsPlace(image.padded, cvRound(corner.pt.x) + kPyramidPadding_px,
                                   cvRound(corner.pt.y) + kPyramidPadding_px);
  return feature;
}

}  // namespace

std::vector<PointFeature> ExtractPointFeatures(const cv::Mat1b& gray, const Camera& camera,
                                               const PointFeatureConfig& config) {
  Require(gray.cols == camera.width && gray.rows == camera.height,
          "ExtractPointFeatures: the image has not the camera's size");
  const std::vector<PyramidImage> octaves = BuildImagePyramid(gray, config.scale);
  const std::vector<int> shares = Shares(config.scale, octaves.size(), config.count);

  std::vector<PointFeature> features;
  constexpr std::size_t kSpare = 16;  // two an octave: SpreadEvenly may exceed its count so
  features.reserve(static_cast<std::size_t>(config.count) + kSpare);
  for (std::size_t o = 0; o < octaves.size(); ++o) {
    const cv::Mat1b& image = octaves[o].image;
    // Corners of the octave, spread evenly over it.
    const int border = BorderOf(image.size());
    const cv::Rect area(border, border, image.cols - 2 * border, image.rows - 2 * border);
    auto corners = SpreadEvenly(CornersOfOctave(image, area, config), area, shares[o]);
    // Orientation and descriptor of each, then its place and depth in the recorded image.
    for (cv::KeyPoint& corner : corners) {
      corner.angle = PatchAngle(octaves[o], cvRound(corner.pt.x), cvRound(corner.pt.y));
    }
    const auto descriptors = DescribePoints(octaves[o], corners);
    for (std::size_t i = 0; i < corners.size(); ++i) {
      features.push_back(
          MakeFeature(corners[i], descriptors[i], static_cast<int>(o), octaves[o], camera));
    }
  }
  return features;
}

}  // namespace slam
