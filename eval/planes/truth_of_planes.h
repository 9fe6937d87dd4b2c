#pragma once

#include <map>

#include "eval/formats/run/frame_planes.h"
#include "eval/planes/overlap.h"
#include "eval/planes/true_frame.h"

namespace eval {

/// Limits of the rule by geometry. A small face's normal is no better known than 30 degrees.
inline constexpr double kMaxTruthNormal_deg = 30.0;
inline constexpr double kMaxTruthOffset_m = 0.05;
inline constexpr double kMaxTruthGap_m = 0.05;  ///< from the polygon, in its plane
/// So far off is a plane that a first Kinect bends, at a desk's distance; as unlikely as that it has e
/// times the pixels that its truth shows.
inline constexpr double kTruthOffsetScale_m = 0.01;

/// Which scored true plane each plane of a segmentation shows: the one that holds most of its
/// pixels, 0 if most show none of them. Ties go to the lower id, before 0.
/// @param pairs  ids of true planes with labels, index of the frame plane + 1
/// @returns truth id by index of the frame plane; planes without a pixel are left out
std::map<int, int> TruthByPixels(const TrueFrame& frame, const LabelPairs& pairs);

/// The same without a segmentation, from the plane's parameters and its number of pixels: of the scored
/// planes that the frame shows, within kMaxTruthNormal_deg, at most kMaxTruthOffset_m from the
/// plane's centroid and with an outline at most kMaxTruthGap_m beside it, the one that is likest by
/// offset and by how many pixels it shows. 0 if there is none. A bent desk may pass nearer to a book's
/// centroid than the book does, but shows many times its pixels.
int TruthByGeometry(const TrueFrame& frame, const RunFramePlane& plane);

/// Pixels of true planes that count, 0 for others, by region of the machine; those of true planes
/// that do not count are left out.
/// @param pairs      ids of true planes with any labels
/// @param region_of  the region by label; a label that is not in it is none
LabelPairs CountedPairs(const TrueFrame& frame, const LabelPairs& pairs,
                        const std::map<int, int>& region_of);

}  // namespace eval
