#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

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

/// How the bend of a device goes with the distance.
enum class BendLaw {
  kDepth,     ///< it is the same share of the depth everywhere
  kDisparity  ///< disparity is off by the same everywhere: the share grows with the depth
};
/// In this order, as in files.
const std::vector<std::string>& BendLawNames();
inline const std::string& NameOf(BendLaw law) {
  return BendLawNames()[static_cast<std::size_t>(law)];
}

/// Where p is stated for a bend that grows with the depth: about where kKinectBend was measured.
inline constexpr double kBendDistance_m = 2.4;

/// Share of the depth that is bent at a measured depth over p.
inline double BendGrowth(BendLaw law, double z_m) {
  return law == BendLaw::kDisparity ? z_m / kBendDistance_m : 1.0;
}

/// How a device bends what is flat: where it measures z the true depth is z / (1 + p g), p a smooth
/// pattern over the image and g as BendGrowth says of z.
///
/// p has no part that is linear in the pixel: what all views of planes leave in doubt (of disparity
/// exactly this; of depth its scale wholly, a tilt nearly) is 0.
struct DepthWarp {
  WarpCells cells;
  BendLaw law = BendLaw::kDepth;
  Eigen::VectorXd pattern;  ///< p at the centre of each cell
  Eigen::VectorXd sigma;    ///< its standard deviation

  /// Root mean square of p over the image.
  double Rms() const;
  /// The same of its standard deviation.
  double SigmaRms() const;
};

/// What is done with the depth of a frame.
struct Straightening {
  cv::Mat1f pattern;  ///< p at each pixel; empty: nothing is done
  BendLaw law = BendLaw::kDepth;
  double left_ratio = 0.0;  ///< bend that is left, rms, as a part of the depth
};

/// p is bilinear between the centres of cells and constant beyond the outermost.
Straightening StraighteningBy(const DepthWarp& warp);

/// The true depths, as a new image; 0 stays 0. The very image when nothing is to be done.
cv::Mat1f Straightened(const cv::Mat1f& depth_m, const Straightening& straightening);

}  // namespace slam
