#pragma once

#include <algorithm>
#include <cmath>

namespace slam {

/// In what scale points are found and measured: one value for extraction, matching, pose and
/// map.
///
/// Octave o of the image pyramid is smaller by factor^o. How near a depth is to be trusted goes by the
/// baseline b of a virtual second camera beside the first; pose and bundle weigh it by the sensor's own
/// noise.
struct FeatureScale {
  int octaves = 8;        ///< levels of the image pyramid
  double factor = 1.2;    ///< ratio of the scales of neighbouring octaves
  double bf_px_m = 40.0;  ///< b f, focal length times virtual baseline
  /// A depth is trusted up to so many virtual baselines. Source: Mur-Artal and Tardos 2017,
  /// III-B.
  double close_baselines = 40.0;

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

  /// Disparity of a point at z_m between the two cameras.
  double Disparity_px(double z_m) const { return bf_px_m / z_m; }
  /// Depth up to which measured points are trusted, metres.
  double CloseDepth_m(double fx_px) const { return close_baselines * bf_px_m / fx_px; }
};

}  // namespace slam
