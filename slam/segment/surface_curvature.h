#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>

#include "slam/model/frame_plane.h"
#include "slam/segment/pixels/depth_grid.h"

namespace slam {

/// The curvature of a quadric over a segment's plane, least squares by the noise of its pixels.
/// @param labels  `plane.index + 1` where the segment is
/// @param bounds  the segment has no pixel outside
/// @param plane   its parameters, centroid, area and number of pixels are read
SurfaceCurvature MeasureCurvature(const DepthGrid& grid, const cv::Mat1b& labels,
                                  const cv::Rect& bounds, const FramePlane& plane,
                                  const DepthNoise& noise);

}  // namespace slam
