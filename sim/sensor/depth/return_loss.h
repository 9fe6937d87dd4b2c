#pragma once

#include <opencv2/core/mat.hpp>

#include "sim/sensor/noise.h"
#include "sim/trace/frame_renderer.h"

namespace sim {

/// Loss where too little of the projected light comes back, or too much.
///
/// What comes back: s = (a cos(theta) (1 - g F)^2 + g B(theta)) / z^2, per m^2; 1 is a white face
/// square to the ray at 1 m. a is the face's infrared albedo, g its gloss, F Schlick's reflection of
/// glass, B the lobe of a rough glass face lit from beside the camera (Beckmann, Torrance and
/// Sparrow 1967). A pixel is lost with probability Phi(ln(min_return / s) / spread), in blobs of
/// some pixels. Recordings show no such loss on bright faces at any angle.
struct ReturnLoss {
  double min_return_per_m2 = 0;  ///< at which half of the pixels are lost; 0 = none is lost
  double spread_ln = 0.2;        ///< sd of the threshold's logarithm, from blob to blob
  /// Where gloss is 1: half angle, about a face's normal, of the camera's and projector's
  /// directions within which the mirrored light saturates. In proportion to gloss; 0 = never.
  double mirror_spot_rad = 0;
};

/// measured on fr1/xyz: a black display at 0.93 m keeps all its depth at 32 deg of incidence, half
/// at 37.5 deg and none at 40 deg, which with screens' albedo (surface_light.h) sets the threshold
/// and its spread. A face of albedo 0.05 is lost from 2 m on, a white one never within the range.
/// The spot is our choice: no recording at hand faces a display.
inline constexpr ReturnLoss kRecordedReturn{
    .min_return_per_m2 = 0.012, .spread_ln = 0.2, .mirror_spot_rad = 0.05};

/// s of the law above, times z^2.
double ReturnAtOneMetre(double infrared, double gloss, double cosine);

/// Marks (255) what is lost in an image of the rendering's size. Without infrared in the rendering
/// none is.
void MarkReturnLoss(const Rendering& rendering, const ReturnLoss& model,
                    const PixelNoise& noise, cv::Mat1b& lost);

}  // namespace sim
