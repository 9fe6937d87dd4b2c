#pragma once

#include <cstdint>
#include <vector>

#include "sim/base/pose.h"
#include "sim/scene/scene.h"

namespace sim {

/// Where the camera was at a moment.
struct TimedPose {
  double timestamp_s = 0;  ///< frame / fps, the first is 0
  Pose T_wc;               ///< camera (x right, y down, z forward) to world (z up)
};

/// A smooth handheld trajectory that looks at the scene as `scene.motion` says: C2 splines for
/// the camera and for what it looks at, plus band-limited tremor. Speeds at 30 Hz follow the
/// preset; the optical axis keeps its pitch; the camera keeps 15 cm from every object.
/// A longer call begins with the frames of a shorter one, and fps only samples the motion.
/// @param frames  at least 1
/// @param fps     frames a second, positive
/// @throws std::invalid_argument for frames or fps out of range; InputError when the scene's
///   motion block leaves the camera no place (says which limit to widen).
std::vector<TimedPose> MakeTrajectory(const Scene& scene, int frames, double fps,
                                      std::uint64_t seed);

}  // namespace sim
