#pragma once

#include <opencv2/core/types.hpp>
#include <optional>
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

/// A segment of these pixels, if they are enough (min_pixels) and say precisely enough where it
/// is (max_angle_sigma_rad). Its bounds are the caller's to set.
std::optional<Segment> Measure(const PlaneSums& sums, int id, const DepthNoise& noise,
                               const PlaneExtractionConfig& config);

/// The largest first; of equal ones that of the smaller id.
void SortBySize(std::vector<Segment>& segments);

/// The labels that are segments, the largest first, at most kMaxSegments.
void KeepMeasured(const std::vector<PlaneSums>& sums, const DepthNoise& noise,
                  const PlaneExtractionConfig& config, std::vector<Segment>& kept);

/// Sums of the pixels of `all` that are not those of `part`, a part of them.
PlaneSums Without(PlaneSums all, const PlaneSums& part);

/// Adds pixels within the bounds [low, high] to a segment.
void Extend(const PlaneSums& more, const cv::Point& low, const cv::Point& high,
            const DepthNoise& noise, const PlaneExtractionConfig& config, Segment& segment);

}  // namespace slam
