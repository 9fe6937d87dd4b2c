#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>

#include "slam/base/field_visitor.h"

namespace slam {

/// How a point's depth is read from the image.
struct PointDepthConfig {
  int window_px = 1;  ///< half width of the square looked at; domain [0, 5]
  double max_step_ratio =
      0.02;                  ///< depths in it may differ by this share of z, domain (0, 1) ...
  double max_step_m = 0.01;  ///< ... or by this much, whichever is more; domain (0, inf)
  double min_depth_m = 0.2;  ///< domain [0, inf)
  double max_depth_m = 8.0;  ///< domain (min_depth_m, inf)
};

inline void VisitFields(PointDepthConfig& c, FieldVisitor& v) {
  v.Integer("window_px", c.window_px, "[0, 5]", "half width of the square looked at");
  v.Number("max_step_ratio", c.max_step_ratio, "(0, 1)",
           "depths in it may differ by this share");
  v.Number("max_step_m", c.max_step_m, "(0, inf)", "or by this much, whichever is more");
  v.Number("min_depth_m", c.min_depth_m, "[0, inf)", "nearest depth used");
  v.Number("max_depth_m", c.max_depth_m, "(0, inf)", "farthest depth used");
}

/// Depth at a recorded pixel, metres: the median of the square around it. 0 where nothing was
/// measured at the pixel, or where the square spans a step between two surfaces: a corner there
/// may belong to either.
double DepthAt(const cv::Mat1f& depth_m, const Eigen::Vector2d& u_px,
               const PointDepthConfig& config);

}  // namespace slam
