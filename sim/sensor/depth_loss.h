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

/// Loss where a matching window sees two surfaces and the pixel's own has no clear majority.
struct MatchWindow {
  int side_px = 0;          ///< odd; 0 = no pixel is lost
  double min_share = 0.45;  ///< of the window's dots that must lie on the pixel's own surface
  /// Dots in a window that shows one surface: their share on a part of it varies as that of so many
  /// thrown at random. 0 = it is the part's area.
  double dots = 9;
  double max_apart_steps = 16;  ///< surfaces nearer than this in disparity match as one
};

/// measured on fr1/xyz: a black display at 0.93 m keeps all its depth at 32 deg of incidence, half
/// at 37.5 deg and none at 40 deg, which with screens' albedo (surface_light.h) sets the threshold
/// and its spread. A face of albedo 0.05 is lost from 2 m on, a white one never within the range.
/// The spot is our choice: no recording at hand faces a display.
inline constexpr ReturnLoss kRecordedReturn{
    .min_return_per_m2 = 0.012, .spread_ln = 0.2, .mirror_spot_rad = 0.05};

/// The window is that of Konolige and Mihelich 2011 and of BlenSor (Gschwandtner et al. 2011);
/// one pixel in nine of the pattern is a dot. The share gives the missing line along edges
/// without shadow (upper and lower ones): none at half of the places, as measured on fr1/xyz
/// (0.55) and a real kitchen (0.48), at others mostly 1 or 2 px. Steps: books 5 cm thick at
/// 1.2 m have no such line in fr1/xyz, things 20 cm before others have.
inline constexpr MatchWindow kRecordedWindow{
    .side_px = 9, .min_share = 0.45, .dots = 9, .max_apart_steps = 16};

/// s of the law above, times z^2.
double ReturnAtOneMetre(double infrared, double gloss, double cosine);

/// Marks (255) what is lost in an image of the rendering's size. Without infrared in the rendering
/// none is.
void MarkReturnLoss(const Rendering& rendering, const ReturnLoss& model,
                    const PixelNoise& noise, cv::Mat1b& lost);

/// The same for the window. @param disparity_m_steps  disparity in steps is this / z
void MarkMixedWindows(const Rendering& rendering, const MatchWindow& model,
                      double disparity_m_steps, const PixelNoise& noise, cv::Mat1b& lost);

}  // namespace sim
