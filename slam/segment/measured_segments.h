#pragma once

#include <opencv2/core/types.hpp>
#include <vector>

#include "slam/geometry/plane_sums.h"
#include "slam/geometry/sensor_model.h"
#include "slam/segment/extraction_config.h"
#include "slam/segment/occluded_parts.h"
#include "slam/segment/pixels/pixel_labels.h"

namespace slam {

inline constexpr int kMaxSegments = 254;  ///< what an 8-bit label image has room for, 0 = none

/// A segment on its way into the frame.
struct Segment {
  int id = 0;  ///< in the label image
  PlaneSums sums;
  LabelPlane plane;
  PlaneSigmas sigmas;
  cv::Rect bounds;
};

/// The segments that are enough of the image (min_share), tell well enough where their plane is
/// (max_angle_sigma_rad), and are on average wider than the pixels that the sensor measures
/// together; the largest first, at most kMaxSegments. Their bounds are the caller's to set.
std::vector<Segment> KeepMeasured(const PartSegments& segments, const SensorModel& sensor,
                                  const PlaneExtractionConfig& config);

}  // namespace slam
