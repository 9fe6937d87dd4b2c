#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>

#include "slam/geometry/plane_sums.h"
#include "slam/segment/pixels/depth_grid.h"

namespace slam {

/// How much depth differs, off the plane, between pixels of a segment that are 8 px apart: half
/// the mean square, in variances of the noise. About 1 for a plane, bent by the sensor or not,
/// if noise is what its model says; more for stairs of tops and sides, which one slanted plane
/// fits. 0 when there are too few such pixels to say.
///
/// @param labels  `label` where the segment is
/// @param bounds  the segment has no pixel outside
/// @param step_px only every such pixel of every such row is looked at; domain [1, 64]
/// @throws std::invalid_argument for a step outside its domain
double MeasureRoughness(const DepthGrid& grid, const cv::Mat1b& labels, const cv::Rect& bounds,
                        std::uint8_t label, const InverseDepthPlane& plane,
                        const DepthNoise& noise, int step_px);

}  // namespace slam
