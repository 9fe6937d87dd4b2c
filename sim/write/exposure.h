#pragma once

#include <cstdint>
#include <functional>
#include <opencv2/core/mat.hpp>

#include "sim/sensor/exposure.h"
#include "sim/trace/frame_renderer.h"

namespace sim {

/// T_wc at a time relative to the frame's own, seconds.
using PoseAround = std::function<Pose(double)>;

/// When the middle of row v, which may lie between two, is exposed, after the frame's time:
/// rolling_s (v / (height - 1) - 1/2).
double RowTime_s(const Exposure& exposure, double v, int height);

/// Linear radiance of a frame that is exposed while the camera moves, rendered again for each
/// moment, so that it holds for scenes in which something moves by itself (for others
/// carried_exposure.h is some 50 times faster): row v is centred on
/// rolling_s (v / (height - 1) - 1/2), by bands of 8 rows; the shutter's samples lie evenly
/// about that. So the pose of the frame's time is that of the middle of its exposure.
cv::Mat3f ExposeMoving(const FrameRenderer& renderer, const Exposure& exposure,
                       const PoseAround& around, double time_s = 0);

/// Factor of the light at a time: 2^(drift_stops s(t)), s smooth in [-1, 1], a new value drawn
/// every 1.5 s. 1 when there is no drift.
double ExposureGain(const Exposure& exposure, std::uint64_t seed, double time_s);

}  // namespace sim
