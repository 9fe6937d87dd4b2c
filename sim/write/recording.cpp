#include "sim/write/recording.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "sim/write/sequence_text.h"

namespace sim {
namespace {

/// Rate of the poses between frames: twenty a period of the fastest tremor (12 Hz).
constexpr double kPathRate_Hz = 240.0;

void CheckTimes(const std::vector<TimedPose>& trajectory) {
  if (trajectory.empty()) throw std::invalid_argument("a sequence needs at least one frame");
  for (std::size_t i = 1; i < trajectory.size(); ++i) {
    if (!(PrintedTime(trajectory[i].timestamp_s) >
          PrintedTime(trajectory[i - 1].timestamp_s))) {
      throw std::invalid_argument("timestamps must grow by a microsecond or more a frame");
    }
  }
}

/// How long after a frame's time the last of its images is exposed.
double Latest_s(const Sensor& sensor) {
  const Exposure& exposure = sensor.exposure;
  return std::max((std::abs(exposure.rolling_s) + exposure.shutter_s) / 2,
                  sensor.timing.depth_offset_s);
}

}  // namespace

Recording PlanRecording(const std::vector<TimedPose>& trajectory, std::vector<TimedPose> path,
                        const RigOptions& rig) {
  CheckTimes(trajectory);
  Recording recording;
  recording.shots = MakeShots(trajectory, rig.sensor.timing, rig.seed);
  recording.path = std::move(path);
  if (recording.path.empty()) recording.path = trajectory;
  recording.lost = static_cast<int>(trajectory.size()) - recording.frames();
  return recording;
}

Recording PlanRecording(const Scene& scene, const RigOptions& rig, int frames) {
  const double fps = rig.camera.fps;
  std::vector<TimedPose> path;
  const Sensor& sensor = rig.sensor;
  if (sensor.exposure.Moves() || sensor.timing.depth_offset_s != 0) {
    const int times = std::max(1, static_cast<int>(std::ceil(kPathRate_Hz / fps)));
    const double rate = fps * times;
    // Beyond all that the last frame asks for, so that it is what it is in a longer recording.
    const int after =
        std::max(times, static_cast<int>(std::floor(Latest_s(sensor) * rate)) + 1);
    path = MakeTrajectory(scene, (frames - 1) * times + after + 1, rate, rig.seed);
  }
  Recording recording =
      PlanRecording(MakeTrajectory(scene, frames, fps, rig.seed), std::move(path), rig);
  recording.scenes_own = true;
  return recording;
}

SimulatedFrame Record(const Simulator& simulator, const Recording& recording, int i) {
  const int exposed = recording.shots.at(static_cast<std::size_t>(i)).exposed;
  const Shot& shot = recording.shots.at(static_cast<std::size_t>(exposed));
  return simulator.Simulate(exposed, shot, [&](double later_s) {
    return PoseAt(recording.path, shot.time_s + later_s);
  });
}

}  // namespace sim
