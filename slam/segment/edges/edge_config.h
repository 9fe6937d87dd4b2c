#pragma once

#include "slam/base/field_visitor.h"

namespace slam {

/// Where the boundary of a segment ends the surface (FindEdgePoints).
struct EdgeConfig {
  int step_px = 2;
  int reach_px = 4;
  /// The projector of a structured-light sensor casts a shadow without depth beside a near
  /// edge, on what lies behind. Pixels; 0 to 128. No key.
  int shadow_px = 32;
  double min_step_sigmas = 3;
  /// Beyond a crease the residual grows with the distance from it; beyond an occluder's edge it
  /// is all there at once.
  double max_crease_start = 0.6;
  /// What rises from a surface at a concave crease either ends it, as a wall does a floor and a
  /// desk the side of a book, or stands on it and hides the rest, as a book does on another.
  double min_rising_area = 0.5;
};

inline void VisitFields(EdgeConfig& c, FieldVisitor& v) {
  v.Integer("step_px", c.step_px, "[1, 64]", "spacing of edge points along the contour");
  v.Integer("reach_px", c.reach_px, "[2, 16]",
            "distance beyond the boundary at which depth is looked at");
  v.Number("min_step_sigmas", c.min_step_sigmas, "(0, inf)",
           "smallest depth step, in standard deviations of the depth");
  v.Number("max_crease_start", c.max_crease_start, "(0, 1)",
           "largest first residual beyond a crease, as a part of the last one");
  v.Number("min_rising_area", c.min_rising_area, "[0, inf)",
           "visible area of what ends a surface at a concave crease, as a part of the "
           "surface's; less stands on it");
}

}  // namespace slam
