#pragma once

#include <optional>

#include "eval/formats/pose/pose.h"

namespace eval {

/// Poses further apart than this are not interpolated: truth of 10 Hz is still
/// interpolated; in that time a hand-held camera moves by some centimetres, nearly straight.
inline constexpr double kMaxPoseGap_s = 0.11;

/// The pose at a moment, between its two neighbours: positions along the line, rotations along
/// the shortest turn.
/// @param poses  by rising stamp
/// @returns nothing before the first and after the last pose, and in gaps over kMaxPoseGap_s
std::optional<Pose> PoseAt(const Trajectory& poses, double stamp_s);

}  // namespace eval
