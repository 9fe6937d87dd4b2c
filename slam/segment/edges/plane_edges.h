#pragma once

#include <opencv2/core/mat.hpp>
#include <span>
#include <vector>

#include "slam/model/frame_plane.h"
#include "slam/segment/edges/edge_config.h"
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
/// @param labels    index + 1 of the segment at each pixel, 0 = none
/// @param bounds    the segment has no pixel outside
/// @param value     the segment's in the labels
/// @param plane     its plane
/// @param areas_m2  visible areas of all segments, by value - 1
std::vector<EdgePoint> FindEdgePoints(const DepthGrid& grid, const cv::Mat1b& labels,
                                      const cv::Rect& bounds, int value,
                                      const LabelPlane& plane, std::span<const double> areas_m2,
                                      const EdgeConfig& config);

}  // namespace slam
