#pragma once

#include "slam/base/camera.h"
#include "slam/model/frame.h"
#include "slam/planes/box_link.h"
#include "slam/planes/edge_lines.h"
#include "slam/planes/refit.h"
#include "slam/planes/select.h"
#include "slam/planes/vertices.h"

namespace slam {

struct PlaneProcessingConfig {
  DepthNoise noise;  ///< that of PlaneExtractionConfig
  RefitConfig refit;
  BoxLinkConfig box_link;
  EdgeLineConfig edge_lines;
  VertexConfig vertices;
  SelectConfig select;
  std::uint64_t seed = 1;  ///< of RANSAC; any value
};

/// (C) of the paper: makes planes out of segments that can be trusted, and says which cannot.
///
/// Re-fit, link to detection boxes, edge lines and vertices of the faces of regular objects,
/// selection, in this order, for every plane of the frame. Reads frame.planes (ExtractPlanes),
/// frame.detections and frame.index; fills the rest of each FramePlane. Deterministic.
void ProcessPlanes(Frame& frame, const Camera& camera, const PlaneProcessingConfig& config);

}  // namespace slam
