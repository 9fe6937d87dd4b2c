#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>

#include "slam/base/field_visitor.h"
#include "slam/geometry/camera.h"
#include "slam/geometry/pose.h"

namespace slam {

/// How a point's depth is read from the image.
struct PointDepthConfig {
  int window_px = 1;
  double max_step_ratio = 0.02;  // balances slanted surfaces against steps between two objects
  double max_step_m = 0.01;      // the same, where noise is more than the share of the depth
  double min_depth_m = 0.2;      // depth cameras are blind below
  double max_depth_m = 8.0;      // the noise of depth grows with its square
};

inline void VisitFields(PointDepthConfig& c, FieldVisitor& v) {
  v.Integer("window_px", c.window_px, "[0, 5]",
            "half width of the square around a feature whose depths are read");
  v.Number("max_step_ratio", c.max_step_ratio, "(0, 1)",
           "largest spread of the depths in the square, as a share of their median");
  v.Number("max_step_m", c.max_step_m, "(0, inf)",
           "the spread that is allowed in any case, whichever is more");
  v.Number("min_depth_m", c.min_depth_m, "[0, inf)", "nearest depth used");
  v.Number("max_depth_m", c.max_depth_m, "(0, inf)", "farthest depth used");
}

/// Depth at a recorded pixel, metres: the median of the square around it. 0 where nothing was
/// measured at the pixel, or where the square spans a step between two surfaces: a corner there
/// may belong to either.
double DepthAt(const cv::Mat1f& depth_m, const Eigen::Vector2d& u_px,
               const PointDepthConfig& config);

/// The same of a camera that was elsewhere when depth was measured: planar z, as seen now, of the
/// point that shows now at the undistorted pixel `u_px`. 0 also where depth does not show it.
/// @param T_dc  from the camera of now to that of the depth image; a small motion
double DepthFrom(const Pose& T_dc, const cv::Mat1f& depth_m, const Camera& camera,
                 const Eigen::Vector2d& u_px, const PointDepthConfig& config);

}  // namespace slam
