#pragma once

#include "slam/extract/extraction_config.h"
#include "slam/extract/patches.h"
#include "slam/extract/pixel_labels.h"

namespace slam {

/// Numbers the segments that connected parts of labels make, across what hides parts of them,
/// and writes them into `labels`; 0, 1, ... in place of labels, kNoLabel where a part is too
/// small to be one.
///
/// Two parts are one plane though nothing joins them in the image if the smaller lies on the
/// larger's extension, and both what surrounds the smaller and what lies between them is in
/// front of it, so that the plane can pass behind. Two book tops of one height have the desk
/// between them, which is behind, and stay apart.
///
/// @param labels  label of each pixel, roots of `joined`
/// @returns the number of segments
int SegmentParts(const DepthGrid& grid, const PatchUnion& joined,
                 const PlaneExtractionConfig& config, LabelImage& labels);

}  // namespace slam
