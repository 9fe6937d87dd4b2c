#pragma once

#include <opencv2/core/mat.hpp>

#include "sim/sensor/report/sensor_report.h"

namespace sim {

/// Stated curves and measured points: by depth on the left, by tilt on the right.
cv::Mat3b DrawReport(const Sensor& sensor, const SensorReport& report);

}  // namespace sim
