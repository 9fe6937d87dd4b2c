#pragma once

#include "sim/write/exposure.h"

namespace sim {

/// Whether CarryExposure may stand in for ExposeMoving: nothing in the scene moves by itself.
bool CanCarry(const FrameRenderer& renderer);

/// Turns the radiance of one rendering, of the middle of the exposure, into that of a frame
/// exposed while the camera moves, as ExposeMoving's with a time of its own for each row and
/// enough samples, but without another ray. The point that a pixel sees is carried to where the
/// rendering shows it at the begin and at the end of the exposure of the pixel's row, through
/// the lens, and the light along the straight way between is averaged. So shutters are to be
/// short against the hand's tremor (up to 12 Hz). Where the camera stands still nothing
/// changes, bit for bit.
///
/// What the rendering does not show is missing: beyond its border the border is repeated, and
/// background that comes out from behind something at another moment is taken from beside it.
/// A pixel blurs as what it sees in the middle of its exposure: of what only passes through it
/// just the part that it meets on that way. Light between pixels is linear, a little soft.
///
/// Whatever moves by itself does not follow the camera: use ExposeMoving there.
/// exposure.shutter_samples is not used; there is a tap a pixel of the way.
/// @pre CanCarry(renderer)
/// @param T_wc       of the rendering
/// @param rendering  whole, with colour; depth and ids stay those of T_wc
void CarryExposure(const FrameRenderer& renderer, const Exposure& exposure,
                   const PoseAround& around, const Pose& T_wc, Rendering& rendering);

}  // namespace sim
