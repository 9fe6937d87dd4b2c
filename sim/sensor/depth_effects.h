#pragma once

#include <opencv2/core/mat.hpp>
#include <span>

#include "sim/sensor/noise.h"
#include "sim/trace/frame_renderer.h"

namespace sim {

/// What the depth sensors' models share. Draws 0 to 7 of a pixel belong to depth.
enum DepthDraw : std::uint32_t {
  kAxialDraw = 0,
  kJitterUDraw = 1,
  kJitterVDraw = 2,
  kLossDraw = 3,
  kWhiteDraw = 4,
  kSessionDraw = 5
};

/// White noise averaged over (2 radius + 1)^2 pixels, sd restored to 1. Defined beyond the
/// border too: no pixel has less of it.
cv::Mat1f SmoothNoise(const cv::Size& size, int radius, const PixelNoise& noise,
                      std::uint32_t draw);

/// The same of `images.size()` draws from `first` on, into images that are used again.
void SmoothNoise(const cv::Size& size, int radius, const PixelNoise& noise, std::uint32_t first,
                 std::span<cv::Mat1f> images);

/// Angle between ray and normal, radians, from its cosine, to 3e-8 (Abramowitz and Stegun
/// 4.4.46; no libm, so the same bits with every C library).
double Incidence(float cosine);

/// Both pixels show the same plane of the same object.
bool SameSurface(const Rendering& rendering, cv::Point a, cv::Point b);

/// z rounded to whole multiples of step_m; unchanged when step_m is 0.
double RoundDepth(double z_m, double step_m);

/// Gaussian sd that, with roundings to steps a and b (variance step^2/12 each), gives `sigma`
/// in all; never below a sixth of the larger step, where the sum of variances would not hold.
double SigmaBeforeRounding(double sigma, double step_a, double step_b);

}  // namespace sim
