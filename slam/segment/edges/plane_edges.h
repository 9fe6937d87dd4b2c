#pragma once

#include <span>
#include <vector>

#include "slam/model/frame_plane.h"
#include "slam/segment/edges/edge_config.h"
#include "slam/segment/edges/outer_contours.h"
#include "slam/segment/pixels/depth_grid.h"
#include "slam/segment/pixels/pixel_labels.h"

namespace slam {

/// The outer boundary of a segment, ordered along each of its contours (counter-clockwise in the image,
/// the longest contour first), with what lies beyond each point (EdgeKind):
///   nothing measured, nor a step beyond it   kMissing
///   the image's border                      kBorder
///   farther than the plane                  kSurface (a step down, or a convex crease)
///   nearer, and suddenly                    kOccluded
///   nearer, but growing from the boundary   a concave crease: kSurface, or kOccluded where a
///                                           small thing stands on the surface
/// p_c is the measured point of the boundary pixel.
///
/// @param contours  those of the label image, index + 1 of the segment at each pixel
/// @param value     the segment's value in it
/// @param plane     its plane
/// @param areas_m2  visible areas of all segments, by value - 1
/// @param edge      what is found; what was in it is forgotten
void FindEdgePoints(const DepthGrid& grid, const OuterContours& contours, int value,
                    const LabelPlane& plane, std::span<const double> areas_m2,
                    const EdgeConfig& config, std::vector<EdgePoint>& edge);

}  // namespace slam
