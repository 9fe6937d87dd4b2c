#pragma once

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

}  // namespace slam
