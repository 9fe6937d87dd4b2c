#pragma once

#include "eval/formats/sequence/sequence.h"

namespace eval {

/// When two faces of one thing count as one plane.
/// Distance of every corner from the other's plane.
inline constexpr double kSamePlane_m = 1e-4;
inline constexpr double kMaxJoint_m = 0.03;  ///< from outline to outline
/// The sequence as it is scored: faces of one thing (an object, or the objects of one
/// detection group) that are one plane with a joint between them, like the two doors of a
/// cabinet or the blocks of keys of a keyboard, are one true plane. Nothing that measures
/// depth can tell them apart, and nobody wants them apart. It goes by the least of their ids;
/// its outline is the convex hull, its holes are those of all, its area is the sum. Faces of
/// different things stay apart, even if they are one plane: that is an association to be got right.
Sequence WithUnitedFaces(Sequence sequence);

}  // namespace eval
