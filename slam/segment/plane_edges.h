#pragma once

#include <span>
#include <vector>

#include "slam/model/frame_plane.h"
#include "slam/segment/depth_grid.h"
#include "slam/segment/outer_contours.h"
#include "slam/segment/pixel_labels.h"

namespace slam {

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

/// The outer boundary of a segment, ordered along each of its contours (clockwise in the image,
/// the longest contour first), with what lies beyond each point (EdgeKind):
///   nothing measured, nor a step beyond it   kMissing
///   the image's border                      kBorder
///   farther than the plane                  kSurface (a step down, or a convex crease)
///   nearer, and suddenly                    kOccluded
///   nearer, but growing from the boundary   a concave crease: kSurface, or kOccluded where a
///                                           small thing stands on the surface
/// p_c is the measured point of the boundary pixel.
///
/// @param contours  of the label image, index + 1 of the segment at each pixel
/// @param value     the segment's value in it
/// @param plane     its plane
/// @param areas_m2  visible areas of all segments, by value - 1
/// @param edge      what is found; what was in it is forgotten
void FindEdgePoints(const DepthGrid& grid, const OuterContours& contours, int value,
                    const LabelPlane& plane, std::span<const double> areas_m2,
                    const EdgeConfig& config, std::vector<EdgePoint>& edge);

}  // namespace slam
