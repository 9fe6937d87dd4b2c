#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>

#include "slam/geometry/camera.h"

namespace slam {

/// Lengths of a bend in pixels are stated for a camera of this focal length: a first Kinect's.
inline constexpr double kStatedFocal_px = 525.0;

/// Cells of equal size that an image is divided into, by rows from the top left.
struct WarpCells {
  int width = 0, height = 0;  ///< pixels of the image
  int cols = 0, rows = 0;

  int count() const { return cols * rows; }
  /// First pixel of a column or row of cells; that of the last + 1 is the image's size.
  int Left(int col) const { return col * width / cols; }
  int Top(int row) const { return row * height / rows; }
  /// Centre of a cell, pixels.
  double CentreU(int col) const { return 0.5 * (Left(col) + Left(col + 1) - 1); }
  double CentreV(int row) const { return 0.5 * (Top(row) + Top(row + 1) - 1); }
};

/// Cells of a camera: 20 pixels at a focal length of 525 pixels, so that a cell is the same part
/// of a device's view in an image of any size.
WarpCells CellsOf(const Camera& camera);

/// How a device bends what is flat: where z is true it measures z (1 + p), p a smooth pattern
/// over the image.
///
/// p has no part that is linear in the pixel: what all views of planes leave in doubt (the scale
/// of depth wholly, a tilt nearly) is 0.
struct DepthWarp {
  WarpCells cells;
  Eigen::VectorXd pattern;  ///< p at the centre of each cell
  Eigen::VectorXd sigma;    ///< its standard deviation

  /// Root mean square of p over the image.
  double Rms() const;
  /// The same of its standard deviation.
  double SigmaRms() const;
};

/// What is done with the depth of a frame.
struct Straightening {
  cv::Mat1f factors;  ///< that depths are multiplied with; empty: nothing is done
  double left_ratio =
      0.0;  ///< bend that is left for all that is known, rms, as a part of the depth
};

/// What a depth has to be multiplied with at each pixel, 1 / (1 + p); p is bilinear between the
/// centres of cells and constant beyond the outermost.
cv::Mat1f StraighteningFactors(const DepthWarp& warp);

/// Each depth times its factor, as a new image; 0 stays 0. The very image when there are no factors.
cv::Mat1f Straightened(const cv::Mat1f& depth_m, const cv::Mat1f& factors);

}  // namespace slam
