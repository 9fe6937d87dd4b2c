#pragma once

#include "sim/motion/trajectory.h"
#include "sim/write/simulator.h"
#include "sim/write/timing.h"

namespace sim {

/// When and from where the frames of a recording are taken: all that is decided before the
/// first is rendered. Files and a live camera both follow it.
struct Recording {
  std::vector<Shot> shots;      ///< frames that are not lost, by rising time
  std::vector<TimedPose> path;  ///< the camera between frames too; see PoseAt
  int lost = 0;                 ///< frames that TimingDefects::drop_ratio took
  bool scenes_own = false;      ///< the motion is the scene's, not one that was given

  int frames() const { return static_cast<int>(shots.size()); }
};

/// The scene's own motion, `frames` of rig.camera.fps with the defects of time of rig.sensor.
/// Between frames the camera follows the same motion at 240 Hz or more where something moves
/// within a frame. A longer recording begins with the frames of a shorter one.
/// @throws InputError for a scene without room for the camera; std::invalid_argument for
///   options out of range
Recording PlanRecording(const Scene& scene, const RigOptions& rig, int frames);

/// The same along a given trajectory.
/// @param path  poses closer in time than frames; empty: the trajectory, joined by straight
///   ways and steady turns
/// @throws std::invalid_argument for a trajectory that is empty or whose times do not grow
Recording PlanRecording(const std::vector<TimedPose>& trajectory, std::vector<TimedPose> path,
                        const RigOptions& rig);

/// Frame i of [0, recording.frames()).
SimulatedFrame Record(const Simulator& simulator, const Recording& recording, int i);

}  // namespace sim
