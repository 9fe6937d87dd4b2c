#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>

#include "slam/geometry/plane_sums.h"
#include "slam/model/frame_plane.h"
#include "slam/segment/pixels/depth_grid.h"

namespace slam {

/// How rough a segment is. About 1 for a plane, bent by the sensor or not, if noise is what its
/// model says and pixels are measured each by itself; coarsely more for stairs of tops and
/// sides, which one slanted plane fits.
///
/// @param labels  `label` where the segment is
/// @param bounds  the segment has no pixel outside
/// @param step_px only every such pixel of every such row is looked at; domain [1, 64]
/// @throws std::invalid_argument for a step outside its domain
Roughness MeasureRoughness(const DepthGrid& grid, const cv::Mat1b& labels,
                           const cv::Rect& bounds, std::uint8_t label,
                           const InverseDepthPlane& plane, const DepthNoise& noise,
                           int step_px);

}  // namespace slam
