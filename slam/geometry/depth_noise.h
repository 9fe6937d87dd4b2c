#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "slam/base/field_visitor.h"

namespace slam {

/// Standard deviation of one depth measurement, metres, as a function of depth and incidence:
///
///   sigma(z)        = floor_m + linear_per_m b + quadratic_per_m b^2
///   sigma(z, theta) = sigma(z) + grazing_m / sqrt(z) theta^2 / (pi/2 - theta)^2
///
/// with b = max(z - nearest_m, 0).
///
/// The defaults are those of the first Kinect. Source: Nguyen, Izadi, Lovell, 3DIMPVT 2012, who add the
/// last term beyond 60 degrees alone; from 0 on it has no jump (5 % more at 45 degrees and 1 m).
/// Those of other sensors: sensor_model.h.
struct DepthNoise {
  double floor_m = 0.0012;
  double linear_per_m = 0.0;
  double quadratic_per_m = 0.0019;
  double nearest_m = 0.4;
  double grazing_m = 0.0001;
  /// The matcher of a structured-light sensor smooths over a window, so n pixels average only
  /// like n / correlated_px.
  double correlated_px = 16.0;

  double Sigma(double z_m) const {
    const double beyond = std::max(z_m - nearest_m, 0.0);
    return floor_m + (linear_per_m + quadratic_per_m * beyond) * beyond;
  }

  /// sigma(z, theta) / sigma(z) for a surface whose normal makes `cosine` with the ray; >= 1.
  double GrazingFactor(double z_m, double cosine) const {
    const double theta = std::acos(std::clamp(cosine, kMinCosine, 1.0));
    const double ratio = theta / (0.5 * std::numbers::pi - theta);
    return 1.0 + grazing_m / std::sqrt(z_m) * ratio * ratio / Sigma(z_m);
  }

 private:
  static constexpr double kMinCosine = 0.05;  // 87 deg: nothing is measured beyond
};

inline void VisitFields(DepthNoise& c, FieldVisitor& v) {
  v.Number("floor_m", c.floor_m, "(0, inf)",
           "standard deviation of a depth at and below nearest_m");
  v.Number("linear_per_m", c.linear_per_m, "[0, inf)",
           "metres by which the standard deviation grows with each metre beyond nearest_m");
  v.Number("quadratic_per_m", c.quadratic_per_m, "[0, inf)",
           "metres by which it grows with the square of the metres beyond nearest_m");
  v.Number("nearest_m", c.nearest_m, "[0, inf)",
           "depth up to which the standard deviation is floor_m");
  v.Number("grazing_m", c.grazing_m, "[0, inf)",
           "growth of the standard deviation of a surface that is seen at a slant");
  v.Number("correlated_px", c.correlated_px, "[1, inf)",
           "number of pixels that share one independent error");
}

}  // namespace slam
