#include "sim/motion/trajectory.h"

#include <cmath>
#include <stdexcept>

#include "sim/motion/camera_path.h"
#include "sim/motion/pattern_path.h"

namespace sim {
namespace {

template <typename Path>
std::vector<TimedPose> Sample(Path path, int frames, double fps) {
  std::vector<TimedPose> trajectory;
  for (int i = 0; i < frames; ++i) {
    const double time_s = i / fps;
    trajectory.push_back({time_s, path.At(time_s)});
  }
  return trajectory;
}

}  // namespace

std::vector<TimedPose> MakeTrajectory(const Scene& scene, int frames, double fps,
                                      std::uint64_t seed) {
  if (!(frames >= 1)) throw std::invalid_argument("a trajectory has at least one frame");
  if (!(fps > 0 && std::isfinite(fps))) throw std::invalid_argument("fps must be positive");
  if (PatternPath::Has(scene.motion.preset)) {
    return Sample(PatternPath(scene, seed), frames, fps);
  }
  return Sample(CameraPath(scene, seed), frames, fps);
}

}  // namespace sim
