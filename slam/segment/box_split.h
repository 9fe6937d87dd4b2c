#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <optional>

#include "slam/geometry/box.h"
#include "slam/segment/depth_grid.h"
#include "slam/segment/extraction_config.h"
#include "slam/segment/pixel_labels.h"
#include "slam/segment/raised_region.h"

namespace slam {

/// The bounds of what is found in a box fill at least this part of it: what is smaller is
/// another thing, or a piece of noise.
inline constexpr double kMinFilledShare = 0.1;

/// Finds the top of a thin thing that became part of what it lies on, inside a detection box.
///
/// A box says that something is there, and about where; the pixels say the rest. Where the
/// segment's pixels within the box are of two heights over its plane, those around each pixel
/// vote on it, and the largest connected region of higher ones is the top if
///   - its step is more than votes of noise alone would make (min_step_votes),
///   - its mean height is beyond doubt (min_evidence_sigmas),
///   - what is around the box is not as high (max_high_around), so that the box is not itself
///     in the middle of something high,
///   - the step is there at once along its boundary, as it is not where the sensor bends what
///     is flat, and
///   - it fills the box, alone or with the segments that the box has (min_box_iou).
/// The box's outline does not bound the region: boxes are several pixels inexact.
///
/// @param labels   `label` where the segment is
/// @param plane    the segment's
/// @param box_px   the detection's
/// @param own_px   bounds of the segments that lie in the box; empty: there are none
/// @returns nothing where there is no such region
/// Cost: linear in the pixels of the box.
std::optional<PixelRegion> FindThinTop(const DepthGrid& grid, const cv::Mat1b& labels,
                                       std::uint8_t label, const LabelPlane& plane,
                                       const Box& box_px, const Box& own_px,
                                       const DepthNoise& noise,
                                       const PlaneExtractionConfig& config);

}  // namespace slam
