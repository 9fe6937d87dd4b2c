#pragma once

#include "slam/base/field_visitor.h"

namespace slam {

/// Where the boundary of a segment ends the surface (FindEdgePoints).
struct EdgeConfig {
  int step_px = 2;   ///< spacing along the contour; domain [1, 64]
  int reach_px = 4;  ///< how far beyond the boundary is looked; domain [2, 16]
  /// The projector of a structured-light sensor casts a shadow without depth beside a near
  /// edge, on what lies behind. Beyond a gap up to this wide the depth decides; domain [0,
  /// 128].
  int shadow_px = 32;
  double min_step_sigmas = 3;  ///< a depth step is at least this; domain (0, inf)
  /// Beyond a crease the residual grows with the distance from it; beyond an occluder's edge it
  /// is all there at once. A crease's first residual is below this part of the last. Domain (0,
  /// 1).
  double max_crease_start = 0.6;
  /// What rises from a surface at a concave crease either ends it, as a wall does a floor and a
  /// desk the side of a book, or stands on it and hides the rest, as a book does on another. It
  /// ends it if its visible area is at least this part of the surface's. Domain [0, inf).
  double min_rising_area = 0.5;
};

inline void VisitFields(EdgeConfig& c, FieldVisitor& v) {
  v.Integer("step_px", c.step_px, "[1, 64]", "spacing along the contour");
  v.Integer("reach_px", c.reach_px, "[2, 16]", "how far beyond the boundary is looked");
  v.Number("min_step_sigmas", c.min_step_sigmas, "(0, inf)", "a depth step is at least this");
  v.Number("max_crease_start", c.max_crease_start, "(0, 1)",
           "first residual over last beyond a crease");
  v.Number("min_rising_area", c.min_rising_area, "[0, inf)",
           "of what ends a surface at a concave crease, over the surface's");
}

}  // namespace slam
