#pragma once

#include <algorithm>
#include <cmath>

namespace slam {

/// Scales of the image pyramid in which points are found: octave o is smaller by factor^o. One
/// value for extraction, matching and mapping.
struct ScalePyramid {
  int octaves = 8;      ///< domain [1, 16]
  double factor = 1.2;  ///< between neighbouring octaves; domain (1, 2]

  double Scale(int octave) const { return std::pow(factor, octave); }
  /// Variance of a feature's position, pixels^2 of the full image; 1 at octave 0.
  double Variance(int octave) const { return std::pow(factor, 2 * octave); }

  /// Octave in which a point shows at `distance_m` that octave 0 resolves up to
  /// `max_distance_m`; clamped to the pyramid.
  int PredictOctave(double distance_m, double max_distance_m) const {
    if (!(distance_m > 0) || !(max_distance_m > distance_m)) return 0;
    const double octave = std::round(std::log(max_distance_m / distance_m) / std::log(factor));
    return static_cast<int>(std::clamp(octave, 0.0, octaves - 1.0));
  }
};

}  // namespace slam
