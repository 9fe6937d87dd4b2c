#pragma once

#include <Eigen/Core>
#include <vector>

#include "sim/scene/scene.h"

namespace sim {

/// The presets keep this far from every object; nearer, real depth cameras see nothing.
inline constexpr double kCameraClearance_m = 0.15;

/// Where the camera can be: outside every object, toys by their boxes, and of the whole way of
/// what moves.
class FreeSpace {
 public:
  explicit FreeSpace(const Scene& scene);
  /// Whether every surface is at least `clearance_m` away and the point is in no object.
  bool Clear(const Eigen::Vector3d& x_w, double clearance_m) const;
  /// Whether no floor, wall or desk stands between the two points, but for the last 10 cm.
  bool InSight(const Eigen::Vector3d& from_w, const Eigen::Vector3d& to_w) const;

 private:
  struct Solid {
    Eigen::Matrix3d R_ow;
    Eigen::Vector3d center_w, half;
    bool structure;
    double Distance(const Eigen::Vector3d& x_w) const;
  };
  std::vector<Solid> solids_;
};

}  // namespace sim
