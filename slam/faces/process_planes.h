#pragma once

#include "slam/faces/box_link.h"
#include "slam/faces/edge_lines.h"
#include "slam/faces/refit.h"
#include "slam/faces/select.h"
#include "slam/faces/vertices.h"
#include "slam/geometry/camera.h"
#include "slam/model/frame.h"

namespace slam {

/// What a plane that no detection speaks for must show to have corners: its shape is then the
/// only evidence that it is a rectangle.
struct UnlinkedConfig {
  double min_contour_share = 0.08;       ///< part of its edge points on a line; [0, 1)
  double min_length_px = 20.0;           ///< a line's; domain (0, inf)
  double max_parallel_angle_rad = 0.09;  ///< between opposite sides; domain (0, pi/2)
  double max_square_error_rad = 0.10;    ///< a corner's, from a right angle; domain (0, pi/2)
};

struct PlaneProcessingConfig {
  DepthNoise noise;  ///< that of PlaneExtractionConfig
  RefitConfig refit;
  BoxLinkConfig box_link;
  EdgeLineConfig edge_lines;
  VertexConfig vertices;
  UnlinkedConfig unlinked;
  SelectConfig select;
  std::uint64_t seed = 1;  ///< for RANSAC; any value
};

/// (C) of the paper: makes planes out of segments that can be trusted, and says which cannot.
///
/// Re-fit, link to detection boxes, edge lines and vertices of faces that may be rectangles,
/// selection, in this order, for every plane of the frame. Reads frame.planes (ExtractPlanes),
/// frame.detections and frame.index; fills the rest of each FramePlane. Deterministic.
void ProcessPlanes(Frame& frame, const Camera& camera, const PlaneProcessingConfig& config);

}  // namespace slam
