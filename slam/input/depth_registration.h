#pragma once

#include <opencv2/core/mat.hpp>

#include "slam/geometry/camera.h"
#include "slam/geometry/pose.h"

namespace slam {

/// Lays the depth of one camera on the image of another, as RealSense's `rs2::align` does: every
/// pixel of depth becomes the rectangle of colour pixels that its area falls on, and the nearest
/// depth counts. Pixels that no depth falls on are 0.
class DepthRegistration {
 public:
  /// @param T_cd  from the depth camera to the colour camera
  DepthRegistration(const Camera& depth, const Camera& colour, const Pose& T_cd);

  cv::Size depth_size() const { return {corner_rays_.cols - 1, corner_rays_.rows - 1}; }

  /// @param depth_m  of the depth camera's size, planar z in metres; 0 = no measurement
  /// @returns planar z of the colour camera, of its size
  cv::Mat1f Register(const cv::Mat1f& depth_m) const;

 private:
  Camera colour_;
  Pose T_cd_;
  /// Rays of the corners of the depth pixels: (rows + 1) x (columns + 1).
  cv::Mat2d corner_rays_;
};

}  // namespace slam
