#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

#include "slam/geometry/sensor_model.h"

namespace slam {

/// How depth scatters within windows of a few pixels, by which a recording tells what measured
/// it. Where nothing but a plane is seen, that is the sensor's noise. It is looked at in inverse
/// depth, which on a plane is a linear function of the pixel.
class DepthScatter {
 public:
  /// @param depth_m  planar z, metres; what is not a positive number is no measurement
  void Add(const cv::Mat1f& depth_m);

  /// Nothing when too little was measured where sensors differ, or when it is like that of
  /// none of them.
  std::optional<DepthSensor> TellSensor() const;

  /// Of the calmer half of the windows, in which there is mostly one plane: medians of ...
  struct Figures {
    double level = 0.0;  ///< standard deviation, in those of the first Kinect at that depth
    double alike = 0.0;  ///< correlation of the errors of two pixels side by side
    std::size_t windows = 0;  ///< all that were looked at
  };
  Figures Measure() const;

 private:
  struct Window {
    double level, alike;
  };
  std::vector<Window> windows_;
};

}  // namespace slam
