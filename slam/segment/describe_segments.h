#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "slam/model/frame_plane.h"
#include "slam/segment/extraction_config.h"
#include "slam/segment/measured_segments.h"
#include "slam/segment/pixels/depth_grid.h"

namespace slam {

/// The planes of a frame, without what faces/ adds. @param labels  index + 1 of the segment at each
/// pixel, 0 = none
std::vector<FramePlane> DescribeSegments(const DepthGrid& grid, const cv::Mat1b& labels,
                                         const std::vector<Segment>& segments,
                                         const DepthNoise& noise,
                                         const PlaneExtractionConfig& config);

}  // namespace slam
