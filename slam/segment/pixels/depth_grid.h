#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "slam/geometry/depth_noise.h"
#include "slam/segment/pixels/pixel_set.h"

namespace slam {

inline constexpr int kVoteReach_px = 2;  ///< rows and columns around a pixel that vote on it

/// A depth image in the form that planes are fitted in; row-major, one entry a pixel.
struct DepthGrid {
  int width = 0, height = 0;
  std::vector<float> x, y;  ///< ray (x, y, 1)
  std::vector<float> q;     ///< inverse depth, 1/metres; 0 = no measurement
  std::vector<float> g;     ///< 1 / sigma_q = z^2 / sigma(z); 0 = no measurement

  /// For cameras without distortion x of each column; empty otherwise.
  std::vector<float> column_x;

  int Index(int u, int v) const { return v * width + u; }
};

/// Sets the size of a grid and its x and y. @param rays  PixelRays of the camera
void SetRays(const cv::Mat2d& rays, DepthGrid& grid);

/// Sets q and g.
/// @param depth_m  planar z, metres; anything not finite, not positive or not below max_depth_m
///                 is no measurement
/// @throws std::invalid_argument if depth and rays differ in size.
void SetDepth(const cv::Mat1f& depth_m, const DepthNoise& noise, double max_depth_m,
              DepthGrid& grid);

}  // namespace slam
