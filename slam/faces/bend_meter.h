#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

#include "slam/geometry/camera.h"
#include "slam/geometry/plane.h"
#include "slam/geometry/plane_sums.h"
#include "slam/geometry/sensor_model.h"
#include "slam/model/frame.h"

namespace slam {

/// Measures, frame by frame, by how much the depth of a run bends what is flat: the unevenness of
/// large planes over distances at which noise averages out. What it says of a sensor that is not
/// known, or whose depth has been straightened, is what the frames show.
///
/// It starts from what is known of the sensor, as if a few cells of a frame had shown it, and
/// forgets frames that are long past.
class BendMeter {
 public:
  /// @param rays  PixelRays(camera)
  BendMeter(const cv::Mat2d& rays, const SensorModel& sensor);

  /// Takes in a frame with depth, labels and planes, or one without planes, and writes what is
  /// known of bends (Frame::bend_ratio) and the standard deviations that they, and what planes do
  /// not show (SensorModel::unseen_ratio), give each of its planes (FramePlane::bend_...).
  /// @param left_ratio  Straightening::left_ratio: planes take up, and so do not show, a part of it,
  ///                    and a warp that was learnt from the same planes takes out more of theirs
  void Measure(double left_ratio, Frame& frame);

  /// Root mean square of the bend as a part of the depth, as far as it is known.
  double ratio() const { return std::sqrt(std::max(0.0, squares_) / cells_); }

 private:
  /// A plane as the rays see it.
  struct SeenPlane {
    InverseDepthPlane plane;
    double grazing = 1.0;  ///< DepthNoise::GrazingFactor
  };
  /// How far a plane is from itself, over the cells that it fills.
  struct Unevenness {
    double squares = 0.0;  ///< sum over the cells
    int cells = 0;
  };

  std::optional<double> SquareIn(const cv::Rect& cell, std::uint8_t label,
                                 const SeenPlane& seen, const Frame& frame) const;
  std::vector<Unevenness> UnevennessIn(const Frame& frame) const;

  cv::Mat2d rays_;
  DepthNoise noise_;
  double unseen_ = 0.0;      ///< SensorModel::unseen_ratio
  double pixel_rad2_ = 0.0;  ///< solid angle of a pixel in the middle of the image
  double cells_ = 0.0;       ///< cells of large planes that stand behind the estimate
  double squares_ = 0.0;     ///< sum of their squared deviations, noise taken out
};

/// Standard deviations of a plane that is fitted to a patch of a bent depth image.
struct BendSigmas {
  double offset_m = 0.0;         ///< at its centroid
  double angle_rad = 0.0;        ///< of its normal
  double curvature_per_m = 0.0;  ///< in any one direction
};

/// The bend is a smooth random field of which a patch shows a part: one much wider than
/// kBendLength_rad averages over many bends, one much smaller is lifted and tilted as a whole.
/// Depth that is too long moves each point along its ray, so a plane moves by that share of its own
/// distance from the camera, and the more slantingly it is seen, the less it tilts.
/// @param ratio  root mean square of the bend, as a part of the depth
/// @param solid_angle_rad2  of the patch
/// @return  angle_rad is that about the axis about which it tilts most
BendSigmas SigmasOfBend(double ratio, const Plane& pi_c, const Eigen::Vector3d& centroid_c,
                        double solid_angle_rad2);

}  // namespace slam
