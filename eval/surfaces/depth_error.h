#pragma once

#include <cmath>

namespace eval {

/// How far a measured point may rightly lie from the flat thing that it shows: what tolerances
/// are made of. A device bends flat things by a share of the distance, its noise grows with
/// the square of the distance, and the camera's truth is not exact.
struct DepthError {
  /// Bend of a first Kinect, as a share of the distance. Measured: residuals of 16 x 16 block
  /// means of walls and desks from each view's own plane, 5 to 9 mm at 1.5 to 2.5 m.
  static constexpr double kBend = 0.0033;
  /// Of the camera's pose. Balances: motion capture is good to some millimetres, a pose from
  /// fusion to some centimetres over a recording; larger blurs steps of thin things.
  static constexpr double kPose_m = 0.005;
  /// 3 sigmas: 1 in 370 beyond.
  static constexpr double kSigmas = 3.0;

  double noise_per_m = 0.0016;  ///< of one pixel's inverse depth; default: a first Kinect's

  /// Of the distance of one pixel's point from its plane, metres.
  /// @param slope  |n . r| of the ray r = (x, y, 1): what an error of depth moves along n
  double OfPixel_m(double depth_m, double slope) const {
    const double noise_m = noise_per_m * depth_m * depth_m;
    return std::hypot(slope * std::hypot(kBend * depth_m, noise_m), kPose_m);
  }
  /// The same of a mean over many pixels and views: noise is averaged out, bend is not.
  static double OfMean_m(double depth_m) { return std::hypot(kBend * depth_m, kPose_m); }
  /// Over a centimetre or two a bend is smooth and the pose is the same: what is more than that
  /// and the noise of two means over `points` is a step.
  double OfStep_m(double depth_m, int points) const {
    // Balances: blur of a depth edge against a phone's 8 mm.
    constexpr double kMinStep_m = 0.003;
    const double noise_m = noise_per_m * depth_m * depth_m * std::sqrt(2.0 / points);
    return std::hypot(std::max(kMinStep_m, kBend * depth_m), kSigmas * noise_m);
  }
};

}  // namespace eval
