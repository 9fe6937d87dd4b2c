#pragma once

#include <opencv2/core/types.hpp>
#include <vector>

#include "slam/geometry/plane_sums.h"
#include "slam/segment/extraction_config.h"
#include "slam/segment/pixel_labels.h"

namespace slam {

inline constexpr int kMaxSegments = 254;  ///< what an 8-bit label image has room for, 0 = none

/// A segment on its way into the frame.
struct Segment {
  int id = 0;  ///< in the label image
  PlaneSums sums;
  LabelPlane plane;
  PlaneSigmas sigmas;
  cv::Point low, high;  ///< first and last row and column
};

/// The labels whose pixels are enough (min_pixels) and tell well enough where the plane is
/// (max_angle_sigma_rad), the largest first, at most kMaxSegments. Their bounds are the
/// caller's to set.
void KeepMeasured(const std::vector<PlaneSums>& sums, const DepthNoise& noise,
                  const PlaneExtractionConfig& config, std::vector<Segment>& kept);

/// Sums of the pixels of `all` that are not those of `part`, a part of them.
PlaneSums Without(PlaneSums all, const PlaneSums& part);

}  // namespace slam
