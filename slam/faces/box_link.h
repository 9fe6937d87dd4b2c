#pragma once

#include <vector>

#include "slam/base/field_visitor.h"
#include "slam/model/detection.h"
#include "slam/model/frame_plane.h"

namespace slam {

/// When a plane belongs to a detected object. Strict bounds, as the paper prints them.
struct BoxLinkConfig {
  double min_iou = 0.10;
  double min_edge_share = 0.8;
  double margin_px = 4.0;
  double min_score = 0.3;
};

inline void VisitFields(BoxLinkConfig& c, FieldVisitor& v) {
  v.Number("min_iou", c.min_iou, "[0, 1)",
           "intersection over union that the plane's rectangle and the box must exceed");
  v.Number("min_edge_share", c.min_edge_share, "[0, 1)",
           "share of the plane's edge points inside the box that must be exceeded");
  v.Number("margin_px", c.margin_px, "[0, inf)", "inexactness of a box");
  v.Number("min_score", c.min_score, "[0, 1)",
           "score that a detection must exceed to be linked");
}

/// Links each plane to at most one detection: FramePlane::detection and class_name; a plane
/// with none has an empty class name (the paper's -1). One box may hold several faces.
///
/// A pair is possible when more than min_edge_share of the plane's edge points lie in the box
/// (a desk's do not, however many objects stand on it) and the rectangle that bounds them
/// overlaps the box by more than min_iou. The best pair has the greatest IoU times share; ties
/// go to the smaller box, then to the one first in reading order, never to the order of the
/// list.
///
/// Source: PAS-SLAM, Associating Planes with Object Detection Boxes.
void LinkBoxes(std::vector<FramePlane>& planes, const std::vector<Detection>& detections,
               const BoxLinkConfig& config);

/// Share of a plane's edge points inside a box; 0 when it has none.
double EdgeShare(const FramePlane& plane, const Box& box_px, double margin_px);

}  // namespace slam
