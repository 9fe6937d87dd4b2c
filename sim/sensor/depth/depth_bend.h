#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <span>

#include "sim/camera/camera.h"

namespace sim {

/// How a device bends what is flat: z becomes z (1 + p), p a smooth pattern over the image. Its
/// larger part belongs to the device, the rest drifts while it records.
///
/// Measured on recordings of a first Kinect (docs/sensors.md): p has an rms of 0.33 % at any
/// distance, three quarters of its power are fixed, and it is a band across the image:
/// along x its autocorrelation is 0.44 after 32 pixels, 0 after 56 and -0.5 after 110; along y
/// 0.77 after 32 and 0.28 after 112. That the error is a share of z is CLAMS' model (Teichman,
/// Miller, Thrun, RSS 2013), and that it is a pattern of the device also Herrera's (PAMI 2012).
struct DepthBend {
  double rms = 0;             ///< of p; 0 = what is flat stays flat
  double drift_share = 0.25;  ///< share of p's power that is not the device's
  int device = 0;             ///< which device; 0 = the recording's seed draws one
};

inline constexpr double kRecordedBend = 0.0033;  ///< rms of p, measured as above

/// p over an image: a sum of plane waves, so that it is the same field at any size of the image.
class BendField {
 public:
  /// @param seed, frame  of the recording; they set the drifting part, and the device unless
  ///   it is named
  BendField(const DepthBend& bend, const Camera& camera, std::uint64_t seed,
            std::uint64_t frame);

  /// p at each pixel of row v, linear between knots some pixels apart, to 2 % of its rms.
  void Row(int v, std::span<float> p) const;

 private:
  int knot_px_;
  cv::Mat1f knots_;
};

/// The part of p that belongs to the device, height x width.
cv::Mat1f DevicePattern(const DepthBend& bend, const Camera& camera, std::uint64_t seed);

}  // namespace sim
