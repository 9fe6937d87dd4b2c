#pragma once

#include <Eigen/Dense>
#include <cmath>
#include <string>
#include <vector>

#include "sim/camera/camera.h"
#include "sim/motion/trajectory.h"
#include "sim/scene/scene.h"

/// Small worlds whose pictures follow from pencil and paper.
namespace sim {

inline Object BoxObject(int id, const std::string& class_name, Role role,
                        const Eigen::Vector3d& center_w, const Eigen::Vector3d& size,
                        Print print = Print::kSpeckle) {
  Object object;
  object.id = id;
  object.class_name = class_name;
  object.name = class_name + "_" + std::to_string(id);
  object.role = role;
  object.center_w = center_w;
  object.size = size;
  for (std::size_t face = 0; face < 6; ++face) {
    object.faces[face] = {print,
                          {0.7, 0.65, 0.6},
                          {0.1, 0.1, 0.12},
                          1.0,
                          static_cast<std::uint64_t>(id) * 16 + face};
  }
  return object;
}

/// Camera at `eye_w` with its optical axis through `at_w` and the world's z axis up.
inline Pose LookAt(const Eigen::Vector3d& eye_w, const Eigen::Vector3d& at_w) {
  Pose T_wc;
  const Eigen::Vector3d z = (at_w - eye_w).normalized();
  const Eigen::Vector3d x = z.cross(Eigen::Vector3d::UnitZ()).normalized();
  T_wc.R << x, z.cross(x), z;
  T_wc.t = eye_w;
  return T_wc;
}

/// Camera at the world's origin that looks along world +y, level.
inline Pose LookAlongY() { return LookAt(Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitY()); }

inline Camera SmallCamera() { return Resize(Camera{}, 160, 120); }

/// One upright board, square to LookAlongY(), its front `z_m` away.
inline Scene OneBoard(double z_m, double side_m = 20.0, Print print = Print::kSpeckle) {
  Scene scene;
  scene.name = "one_board";
  scene.objects.push_back(
      BoxObject(1, "wall", Role::kStructure, {0, z_m + 0.05, 0}, {side_m, 0.1, side_m}, print));
  return scene;
}

/// A desk with a wall, a floor, three boxes and a toy.
inline Scene SmallDesk() {
  Scene scene;
  scene.name = "small_desk";
  scene.objects = {
      BoxObject(1, "floor", Role::kStructure, {0, 0, -0.05}, {5, 5, 0.1}),
      BoxObject(2, "wall", Role::kStructure, {0, 1, 1.25}, {5, 0.1, 2.5}, Print::kCloth),
      BoxObject(3, "desk", Role::kStructure, {0, 0, 0.735}, {1.6, 0.8, 0.03}, Print::kWood),
      BoxObject(4, "book", Role::kRegular, {-0.25, -0.1, 0.765}, {0.16, 0.23, 0.03},
                Print::kCover),
      BoxObject(5, "book", Role::kRegular, {0.1, -0.2, 0.775}, {0.21, 0.30, 0.05},
                Print::kText),
      BoxObject(6, "keyboard", Role::kRegular, {0.45, -0.2, 0.7625}, {0.45, 0.13, 0.025},
                Print::kKeys),
      BoxObject(7, "teddy bear", Role::kUnstructured, {0.4, 0.15, 0.83}, {0.16, 0.16, 0.16})};
  scene.objects[6].shape = ShapeKind::kToy;
  scene.objects[6].seed = 3;
  return scene;
}

/// A short arc round the desk.
inline std::vector<TimedPose> SmallArc(int frames) {
  std::vector<TimedPose> trajectory;
  for (int i = 0; i < frames; ++i) {
    const double a = -0.2 + 0.02 * i;
    const Eigen::Vector3d at(0, 0, 0.8);
    trajectory.push_back(
        {i / 30.0, LookAt(at + Eigen::Vector3d(std::sin(a), -std::cos(a), 0.6), at)});
  }
  return trajectory;
}

}  // namespace sim
