#pragma once

#include "slam/base/camera.h"
#include "slam/extract/extraction_config.h"
#include "slam/model/frame.h"

namespace slam {

/// (B) of the paper for planes: segments the depth image of a frame into planes.
///
/// Blocks are clustered (ClusterBlocks), planes grow over pixels (AssignPixels), what is left
/// or does not fit is clustered again with finer blocks, touching parts of one plane are
/// merged, cut-off parts are reunited or separated, and each segment is fitted to all its
/// pixels. Where all that stands: docs of each function.
///
/// Reads frame.depth_m; fills frame.planes (largest first, at most 254, without what planes/
/// adds) and frame.plane_labels (index + 1, 0 = none). Never labels an unmeasured pixel.
///
/// @param rays  PixelRays(camera), computed once a camera
/// @throws std::invalid_argument if depth and rays differ in size.
///
/// Source: PEAC (Feng, Taguchi, Kamat, ICRA 2014), with changes for thin steps
/// (block_clusters.h).
void ExtractPlanes(Frame& frame, const Camera& camera, const cv::Mat2d& rays,
                   const PlaneExtractionConfig& config);

}  // namespace slam
