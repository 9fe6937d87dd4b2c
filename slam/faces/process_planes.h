#pragma once

#include "slam/faces/box_link.h"
#include "slam/faces/edge_lines.h"
#include "slam/faces/refit.h"
#include "slam/faces/select.h"
#include "slam/faces/vertices.h"
#include "slam/geometry/camera.h"
#include "slam/geometry/sensor_model.h"
#include "slam/model/frame.h"

namespace slam {

/// What a plane that no detection speaks for must show to have corners: its shape is then the
/// only evidence that it is a rectangle.
struct UnlinkedConfig {
  double min_contour_share = 0.08;
  double min_length_px = 20.0;
  double max_parallel_angle_rad = 0.09;
  double max_square_error_rad = 0.10;
};

inline void VisitFields(UnlinkedConfig& c, FieldVisitor& v) {
  v.Number("min_contour_share", c.min_contour_share, "[0, 1)",
           "smallest share of the plane's edge points on a line");
  v.Number("min_length_px", c.min_length_px, "(0, inf)", "shortest line");
  v.Degrees("max_parallel_angle_deg", c.max_parallel_angle_rad, "(0, 90)",
            "largest angle between opposite sides");
  v.Degrees("max_square_error_deg", c.max_square_error_rad, "(0, 90)",
            "largest deviation of a corner from a right angle");
}

struct PlaneProcessingConfig {
  RefitConfig refit;
  BoxLinkConfig box_link;
  EdgeLineConfig edge_lines;
  VertexConfig vertices;
  UnlinkedConfig unlinked;
  SelectConfig select;
  std::uint64_t seed = 1;  ///< for RANSAC; any value
};

inline void VisitFields(PlaneProcessingConfig& c, FieldVisitor& v) {
  v.Section("refit", "robust re-fit of each plane", c.refit);
  v.Section("box_link", "link of a plane with a detection", c.box_link);
  v.Section("edge_lines", "straight edges of a plane", c.edge_lines);
  v.Section("vertices", "corners of a rectangular face", c.vertices);
  v.Section("unlinked", "what a plane without a detection must show to have corners",
            c.unlinked);
  v.Section("select", "which planes are trusted", c.select);
}

/// (C) of the paper: makes planes out of segments that can be trusted, and says which cannot.
///
/// Re-fit, link to detection boxes, edge lines and vertices of faces that may be rectangles,
/// selection, in this order, for every plane of the frame. Reads frame.planes (ExtractPlanes),
/// frame.detections and frame.index; fills the rest of each FramePlane. Deterministic.
void ProcessPlanes(Frame& frame, const Camera& camera, const SensorModel& sensor,
                   const PlaneProcessingConfig& config);

}  // namespace slam
