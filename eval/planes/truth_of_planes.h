#pragma once

#include <map>

#include "eval/formats/frame_planes.h"
#include "eval/planes/overlap.h"
#include "eval/planes/true_frame.h"

namespace eval {

/// Limits of the rule by geometry.
inline constexpr double kMaxTruthNormal_deg = 20.0;
inline constexpr double kMaxTruthOffset_m = 0.05;
inline constexpr double kSameOffset_m = 0.005;  ///< nearer than this, planes are told by place
inline constexpr double kMaxTruthGap_m = 0.05;  ///< from the polygon, in its plane

/// Which scored true plane each plane of a segmentation shows: the one that holds most of its
/// pixels, 0 if most show none of them. Ties go to the lower id, before 0.
/// @param pairs  ids of true planes with labels, index of the frame plane + 1
/// @returns truth id by index of the frame plane; planes without a pixel are left out
std::map<int, int> TruthByPixels(const TrueFrame& frame, const LabelPairs& pairs);

/// The same without a segmentation, from the plane's parameters: of the scored planes that the
/// frame shows, within kMaxTruthNormal_deg, those with the least offset at the plane's centroid
/// (at most kMaxTruthOffset_m; equal within kSameOffset_m), and of these the one whose polygon
/// is nearest to the centroid (at most kMaxTruthGap_m). 0 if there is none.
int TruthByGeometry(const TrueFrame& frame, const RunFramePlane& plane);

/// Pixels of true planes that count, 0 for others, by region of the machine; those of true planes
/// that do not count are left out.
/// @param pairs      ids of true planes with any labels
/// @param region_of  the region by label; a label that is not in it is none
LabelPairs CountedPairs(const TrueFrame& frame, const LabelPairs& pairs,
                        const std::map<int, int>& region_of);

}  // namespace eval
