#pragma once

#include <cstdint>

#include "sim/base/pose.h"
#include "sim/camera/camera.h"

// A rendered view as the camera sees it from a little beside, by rows. Same bits on every
// processor.
namespace sim {

/// A view's light and inverse depth side by side: red, green, blue, 1/z in 1/m, 0 where nothing
/// is hit. One column and one row more than the image, which repeat its last ones.
struct LitView {
  const float* pixels = nullptr;
  int width = 0, height = 0;  ///< of the image
  int Stride() const { return 4 * (width + 1); }
};

/// One row of a LitView.
/// @param radiance  3 width floats
/// @param depth_m   0 where nothing is hit
/// @param lit       4 (width + 1) floats
void LightRow(const float* radiance, const double* depth_m, int width, float* lit);

/// Raises nearest[i] to the inverse depths of a row's pixels from i block_px on.
void RaiseBlocks(const float* lit, int width, int block_px, float* nearest);

/// What the pixels of an exposed row see, and where that is in the view.
struct CarriedRow {
  const double *x, *y;  ///< rays (x, y, 1) of the pixels
  double* inverse_z;    ///< of what they see, 1/m, in the camera of the row
  double *u, *v;        ///< where the view shows it, pixels; at most an image's size outside
};

/// Fills u and v from inverse_z.
/// @param T_vr  from the camera of the row to that of the view
void CarryRow(const Pose& T_vr, const Camera& camera, const CarriedRow& row);

/// Where the view shows something nearer at u, v than inverse_z says, puts that there.
/// @param T_vr  turns as that of CarryRow did; its way is left out
void LookNearer(const LitView& view, const Pose& T_vr, const CarriedRow& row);

/// Per pixel a straight way through the view, in multiples of 2^-16 px, and its taps.
struct TapRow {
  std::int32_t *u, *v;            ///< first tap
  std::int32_t *step_u, *step_v;  ///< to the next one
  std::int32_t* count;            ///< at least 1
};

/// Lays taps evenly on the way from begin to end, at most a pixel apart (64 of them at most).
void PlaceTaps(const double* begin_u, const double* begin_v, const double* end_u,
               const double* end_v, int width, const TapRow& taps);

/// Mean of the taps' light, linear between four pixels; outside the image that of its border.
/// @param radiance  3 width floats
void MeanOfTaps(const LitView& view, const TapRow& taps, float* radiance);

}  // namespace sim
