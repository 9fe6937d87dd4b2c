#include "sim/motion/free_space.h"

#include <algorithm>

#include "sim/scene/geometry.h"

namespace sim {

FreeSpace::FreeSpace(const Scene& scene) {
  constexpr double kStep_m = 0.1;
  for (const Object& given : scene.objects) {
    for (const double time_s : MomentsOf(given, kStep_m)) {
      const Object object = ObjectAt(given, time_s);
      solids_.push_back({object.q_wo.toRotationMatrix().transpose(), object.center_w,
                         object.size / 2, object.role == Role::kStructure});
    }
  }
}

double FreeSpace::Solid::Distance(const Eigen::Vector3d& x_w) const {
  const Eigen::Vector3d beyond = (R_ow * (x_w - center_w)).cwiseAbs() - half;
  return beyond.cwiseMax(0.0).norm() + std::min(beyond.maxCoeff(), 0.0);
}

bool FreeSpace::Clear(const Eigen::Vector3d& x_w, double clearance_m) const {
  return std::all_of(solids_.begin(), solids_.end(),
                     [&](const Solid& solid) { return solid.Distance(x_w) >= clearance_m; });
}

bool FreeSpace::InSight(const Eigen::Vector3d& from_w, const Eigen::Vector3d& to_w) const {
  constexpr double kNearTarget_m = 0.10, kStride_m = 0.01;
  const Eigen::Vector3d way = to_w - from_w;
  const double length = way.norm() - kNearTarget_m;
  for (double at = 0; at < length; at += kStride_m) {
    const Eigen::Vector3d x_w = from_w + way.normalized() * at;
    for (const Solid& solid : solids_) {
      if (solid.structure && solid.Distance(x_w) <= 0) return false;
    }
  }
  return true;
}

}  // namespace sim
