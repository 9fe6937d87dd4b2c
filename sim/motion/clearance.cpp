#include "sim/motion/clearance.h"

#include <cmath>
#include <limits>

#include "io/input_error.h"
#include "io/number_text.h"
#include "sim/motion/free_space.h"
#include "sim/scene/geometry.h"

namespace sim {

NearestPass NearestPassOf(const Scene& scene, const std::vector<TimedPose>& trajectory,
                          PassKind kind) {
  NearestPass nearest;
  nearest.distance_m = std::numeric_limits<double>::infinity();
  for (const TimedPose& pose : trajectory) {
    for (const Object& object : scene.objects) {
      if ((object.shape == ShapeKind::kBox) != (kind == PassKind::kBox)) continue;
      const double distance_m = DistanceToBox(ObjectAt(object, pose.timestamp_s), pose.T_wc.t);
      if (!(distance_m < nearest.distance_m)) continue;
      nearest = {pose.timestamp_s, object.name, distance_m};
    }
  }
  return nearest;
}

std::string ClearanceWarning(const Scene& scene, const std::vector<TimedPose>& trajectory) {
  const NearestPass box = NearestPassOf(scene, trajectory, PassKind::kBox);
  const NearestPass body = NearestPassOf(scene, trajectory, PassKind::kBody);
  const NearestPass& pass = box.distance_m < kCameraClearance_m ? box : body;
  if (pass.distance_m >= kCameraClearance_m) return "";
  const auto millimetres = [](double length_m) {
    return io::NumberText(std::round(std::abs(length_m) * 1e3)) + " mm";
  };
  const std::string when =
      "at " + io::NumberText(std::round(pass.timestamp_s * 1e3) / 1e3) + " s";
  if (box.distance_m < 0) {
    throw io::InputError("trajectory", when + " the camera is " + millimetres(pass.distance_m) +
                                           " inside '" + pass.object +
                                           "'; move the object or the trajectory");
  }
  return "trajectory: " + when + " the camera is " +
         (pass.distance_m < 0 ? "inside the box of '" + pass.object + "'"
                              : millimetres(pass.distance_m) + " from '" + pass.object + "'") +
         "; depth sensors see nothing that near (15 cm are kept by the presets)";
}

}  // namespace sim
