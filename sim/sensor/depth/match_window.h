#pragma once

#include <opencv2/core/mat.hpp>

#include "sim/sensor/noise.h"
#include "sim/trace/frame_renderer.h"

namespace sim {

/// Loss where a matching window sees two surfaces and the pixel's own has no clear majority.
struct MatchWindow {
  int side_px = 0;          ///< odd; 0 = no pixel is lost
  double min_share = 0.45;  ///< of the window's dots that must lie on the pixel's own surface
  /// Dots in a window that shows one surface: their share on a part of it varies as that of so many
  /// thrown at random. 0 = it is the part's area.
  double dots = 9;
  double max_apart_steps = 16;  ///< surfaces nearer than this in disparity match as one
};

/// The window is that of Konolige and Mihelich 2011 and of BlenSor (Gschwandtner et al. 2011);
/// one pixel in nine of the pattern is a dot. The share gives the missing line along edges
/// without shadow (upper and lower ones): none at many places, of fr1/xyz
/// (0.55), a real kitchen (0.48) and here (0.35), at others mostly 1 or 2 px. Steps: books 5 cm thick at
/// 1.2 m have no such line in fr1/xyz, things 20 cm before others have.
inline constexpr MatchWindow kRecordedWindow{
    .side_px = 9, .min_share = 0.45, .dots = 9, .max_apart_steps = 16};

/// Marks (255) what is lost in an image of the rendering's size.
/// @param disparity_m_steps  disparity in steps is this / z
void MarkMixedWindows(const Rendering& rendering, const MatchWindow& model,
                      double disparity_m_steps, const PixelNoise& noise, cv::Mat1b& lost);

}  // namespace sim
