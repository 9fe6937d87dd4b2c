#pragma once

#include <rapidcheck.h>

#include <optional>

#include "tests/sim/support/sim_worlds.h"

/// Generated rooms of boxes and cameras in them; all shrink towards fewer, plainer boxes.
namespace sim {

inline double Real(double low, double high) {
  constexpr int kSteps = 1 << 20;
  return low + (high - low) * *rc::gen::inRange(0, kSteps + 1) / kSteps;
}

inline Eigen::Quaterniond AnyRotation() {
  const Eigen::Vector3d axis(Real(-1, 1), Real(-1, 1), Real(-1, 1));
  if (axis.norm() < 1e-3) return Eigen::Quaterniond::Identity();
  return Eigen::Quaterniond(Eigen::AngleAxisd(Real(-3, 3), axis.normalized()));
}

/// 1 to 12 boxes of 0.1 to 1 m, 1.2 m and more away from a camera near the origin that looks
/// along +y: the camera is outside every box.
inline Scene AnyScene() {
  Scene scene;
  scene.name = "generated";
  const int count = *rc::gen::inRange(1, 13);
  for (int id = 1; id <= count; ++id) {
    const Eigen::Vector3d size(Real(0.1, 1), Real(0.1, 1), Real(0.1, 1));
    const Eigen::Vector3d center(Real(-2, 2), Real(2.2, 6), Real(-1.5, 1.5));
    scene.objects.push_back(BoxObject(id, "box", Role::kRegular, center, size));
    scene.objects.back().q_wo = AnyRotation();
  }
  return scene;
}

/// Within 0.15 m and 0.15 rad an axis of LookAlongY().
inline Pose AnyView() {
  Pose T_wc = LookAlongY();
  T_wc.t = {Real(-0.15, 0.15), Real(-0.15, 0.15), Real(-0.15, 0.15)};
  const Eigen::Vector3d turn(Real(-0.15, 0.15), Real(-0.15, 0.15), Real(-0.15, 0.15));
  if (turn.norm() > 1e-9) {
    T_wc.R = Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix() * T_wc.R;
  }
  return T_wc;
}

inline Camera AnyCamera() {
  Camera camera = SmallCamera();
  camera.fx = Real(50, 300);
  camera.fy = Real(50, 300);
  camera.cx += Real(-8, 8);
  camera.cy += Real(-6, 6);
  return camera;
}

struct BoxHit {
  double z;
  int object;
};

/// The nearest box on the ray, by slabs in each box's own frame: knows nothing of triangles.
inline std::optional<BoxHit> CastAtBoxes(const Scene& scene, const Eigen::Vector3d& origin_w,
                                         const Eigen::Vector3d& direction_w) {
  std::optional<BoxHit> nearest;
  for (const Object& object : scene.objects) {
    const Eigen::Vector3d o = object.q_wo.conjugate() * (origin_w - object.center_w);
    const Eigen::Vector3d d = object.q_wo.conjugate() * direction_w;
    double enter = 0, leave = 1e9;
    for (int axis = 0; axis < 3; ++axis) {
      const double a = (-0.5 * object.size[axis] - o[axis]) / d[axis];
      const double b = (0.5 * object.size[axis] - o[axis]) / d[axis];
      enter = std::max(enter, std::min(a, b));
      leave = std::min(leave, std::max(a, b));
    }
    if (enter < leave && (!nearest || enter < nearest->z)) nearest = BoxHit{enter, object.id};
  }
  return nearest;
}

}  // namespace sim
