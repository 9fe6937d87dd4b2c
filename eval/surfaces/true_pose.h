#pragma once

#include <optional>

#include "eval/formats/pose.h"

namespace eval {

/// Poses further apart than this are not interpolated: at 30 Hz three frames, in which a
/// hand-held camera moves by some centimetres on a nearly straight way.
inline constexpr double kMaxPoseGap_s = 0.1;

/// The pose at a moment, between its two neighbours: positions along the line, rotations along
/// the shortest turn.
/// @param poses  by rising stamp
/// @returns nothing before the first and after the last pose, and in gaps over kMaxPoseGap_s
std::optional<Pose> PoseAt(const Trajectory& poses, double stamp_s);

}  // namespace eval
