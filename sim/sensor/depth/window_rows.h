#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

// What matching windows look at, eight pixels at a time. Same bits on every processor.
namespace sim {

/// Disparity and surface of each pixel, in a frame of pixels that show nothing, at least as wide as
/// a window reaches, and eight more to the right.
struct MatchView {
  const float* steps = nullptr;           ///< of pixel (0, 0); 0 = nothing to match
  const std::int32_t* surface = nullptr;  ///< of pixel (0, 0)
  std::ptrdiff_t stride = 0;              ///< from row to row
  float max_apart_steps = 0;              ///< surfaces nearer than this match as one
};

/// Pixels of a window that show the surface of its middle, or one that matches as that; and those
/// that show a nearer one. Of eight windows side by side.
struct WindowCounts {
  static constexpr int kWindows = 8;
  std::array<std::int32_t, kWindows> same, nearer;
};

/// Of the windows of `reach` pixels about (u, v) and the seven pixels to the right of it.
WindowCounts CountWindows(const MatchView& view, int u, int v, int reach);

/// Marks with 255 where pixel i of one row and of another do not match as one; leaves the rest.
/// @param from, to  the first pixels' places in the view
void MarkApart(const MatchView& view, std::ptrdiff_t from, std::ptrdiff_t to, int count,
               std::uint8_t* marks);

/// Disparity: steps_m / z where a surface is lit, 0 elsewhere.
/// @param lit  null: all of it is
void DisparitySteps(const double* z_m, const std::uint8_t* lit, double steps_m, int count,
                    float* steps);

}  // namespace sim
