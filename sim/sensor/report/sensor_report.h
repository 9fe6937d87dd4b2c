#pragma once

#include <string>
#include <vector>

#include "sim/sensor/sensor.h"

namespace sim {

/// A wall as a sensor measures it, against what its model states. Metres.
struct WallMeasurement {
  double z_m = 0, tilt_rad = 0;
  double stated_sd_m = 0, sd_m = 0;      ///< without the stated bias
  double stated_bias_m = 0, bias_m = 0;  ///< mean error; stated for walls without tilt
  double stated_step_m = 0, step_m = 0;  ///< median gap between the depths that occur
};

struct SensorReport {
  std::vector<WallMeasurement> by_depth;  ///< frontal, 0.6 m to 3 m
  std::vector<WallMeasurement> by_tilt;   ///< at 1 m, 0 to 75 deg
};

/// Renders walls in a narrow view (rays within 2.2 deg of the axis) and measures them. The
/// offset that a session draws, what the device bends (bend_report.h), the blind band of a stereo
/// pair and the field of view are left out.
SensorReport MeasureWalls(const Sensor& sensor);

/// The report as a table for people, a line a wall.
std::string ReportTable(const SensorReport& report);

}  // namespace sim
