#include "sim/motion/trajectory.h"

#include <cmath>
#include <stdexcept>

#include "sim/motion/camera_path.h"

namespace sim {

std::vector<TimedPose> MakeTrajectory(const Scene& scene, int frames, double fps,
                                      std::uint64_t seed) {
  if (!(frames >= 1)) throw std::invalid_argument("a trajectory has at least one frame");
  if (!(fps > 0 && std::isfinite(fps))) throw std::invalid_argument("fps must be positive");
  CameraPath path(scene, seed);
  std::vector<TimedPose> trajectory;
  for (int i = 0; i < frames; ++i) {
    const double time_s = i / fps;
    trajectory.push_back({time_s, path.At(time_s)});
  }
  return trajectory;
}

}  // namespace sim
