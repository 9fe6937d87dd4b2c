#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "sim/motion/trajectory.h"

namespace sim {

/// Reads a recorded trajectory in the TUM form, "timestamp tx ty tz qx qy qz qw" a line, `#`
/// for comments: seconds, metres, camera to world. The first timestamp becomes 0.
/// @throws InputError with file:line for a line that is not so, for timestamps that do not
///   increase, and for fewer than two poses.
std::vector<TimedPose> ReadTrajectory(const std::filesystem::path& path);

/// As many frames as the recording is long, times of six digits allowed for.
int FramesOf(const std::vector<TimedPose>& recorded, double fps);

/// The recording sampled like MakeTrajectory: frame i at i / fps, positions and rotations
/// interpolated between the two poses around it.
/// @param name  of the recording, for messages
/// @throws InputError when the recording is shorter than that or has a hole of more than half a
///   second; std::invalid_argument for frames or fps out of range
std::vector<TimedPose> Replay(const std::vector<TimedPose>& recorded, int frames, double fps,
                              const std::string& name = "trajectory");

}  // namespace sim
