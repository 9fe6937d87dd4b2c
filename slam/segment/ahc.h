#pragma once

#include "slam/segment/pixels/depth_grid.h"
#include "slam/segment/pixels/label_runs.h"

namespace slam {

/// Planes of a depth image by PEAC as it was published, to compare with: blocks of 10 x 10
/// pixels, a graph of those that are planar, clustering by the mean squared error of what a
/// merge makes, the border blocks of each plane given back and grown over pixel by pixel, and
/// the planes that meet then clustered again. Its bounds are lengths and angles that grow with
/// the distance, whatever the sensor.
///
/// @returns a label for each pixel, 0, 1, ... in no particular order; kNoLabel: none
/// Source: Feng, Taguchi, Kamat, "Fast plane extraction in organized point clouds using
/// agglomerative hierarchical clustering", ICRA 2014; bounds: the authors' program's defaults.
LabelImage SegmentByAhc(const DepthGrid& grid);

}  // namespace slam
