#pragma once

#include <vector>

#include "slam/geometry/camera.h"
#include "slam/geometry/sensor_model.h"
#include "slam/model/frame.h"

namespace slam {

/// Sets the standard deviation of each feature's depth: noise and bend of the sensor, and what the
/// camera's motion makes of an error of the stamps of colour and depth.
void WeighDepths(const SensorModel& sensor, const Camera& camera, const UncertainSpeed& speed,
                 std::vector<PointFeature>& features);

}  // namespace slam
