#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "slam/calibrate/depth_warp.h"
#include "slam/geometry/plane_sums.h"

namespace slam {

/// What a surface shows in one cell.
struct CellMean {
  int cell = 0;
  double x = 0.0, y = 0.0;  ///< mean ray
  double q = 0.0;           ///< mean inverse depth, 1/metres, as measured
  double sigma = 0.0;       ///< standard deviation of q, as a part of it; the bend is not in it
};

/// A large surface as one frame shows it, and the plane through it.
struct SurfaceView {
  std::vector<CellMean> cells;
  InverseDepthPlane plane;  ///< through the cells, less the pattern that is known already
};

/// The large flat surfaces of a depth image. Segments that touch without a step and lie on one
/// plane, within what a device bends, are one surface here: a bend breaks large surfaces into
/// pieces, whose own planes would take up what is to be learnt.
///
/// @param depth_m   as measured, not straightened; labels: see Frame::plane_labels
/// @param rays      PixelRays(camera)
/// @param known     p of each cell as far as it is known; zeros at first
/// @param spread    standard deviation of what the device shows in each cell beyond that
/// @param law       how both go with the depth
std::vector<SurfaceView> ViewSurfaces(const cv::Mat1f& depth_m, const cv::Mat1b& labels,
                                      const cv::Mat2d& rays, const WarpCells& cells,
                                      const DepthNoise& noise, const Eigen::VectorXd& known,
                                      const Eigen::VectorXd& spread, BendLaw law);

}  // namespace slam
