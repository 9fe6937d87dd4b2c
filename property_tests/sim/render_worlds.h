#pragma once

#include <rapidcheck.h>

#include <cstring>
#include <opencv2/core/mat.hpp>
#include <optional>

#include "property_tests/generators/numbers.h"
#include "tests/sim/support/sim_worlds.h"

/// Generated rooms of boxes and cameras in them; all shrink towards fewer, plainer boxes.
namespace sim {

using generators::AnyInt;

/// One draw in ten is an end of the range.
inline double Real(double low, double high) {
  constexpr int kSteps = 1 << 20;
  const int end = AnyInt(0, 19);
  if (end < 2) return end == 0 ? low : high;
  return low + (high - low) * AnyInt(0, kSteps) / kSteps;
}

inline Eigen::Quaterniond AnyRotation() {
  const Eigen::Vector3d axis(Real(-1, 1), Real(-1, 1), Real(-1, 1));
  if (axis.norm() < 1e-3) return Eigen::Quaterniond::Identity();
  return Eigen::Quaterniond(Eigen::AngleAxisd(Real(-3, 3), axis.normalized()));
}

/// Floor, back and left wall of a room of 3 to 10 m, behind everything else.
inline void AddRoom(Scene& scene) {
  const double floor_z = Real(-3, -2.4), back_y = Real(7, 10), left_x = Real(-5, -3);
  const auto add = [&](int id, const Eigen::Vector3d& center, const Eigen::Vector3d& size) {
    scene.objects.push_back(
        BoxObject(id, "wall", Role::kStructure, center, size, Print::kPlain));
  };
  add(41, {0, 4, floor_z - 0.05}, {12, 14, 0.1});
  add(42, {0, back_y + 0.05, 0}, {12, 0.1, 8});
  add(43, {left_x - 0.05, 4, 0}, {0.1, 14, 8});
}

/// Boxes of 0.1 to 1 m, which may run through each other, 1.2 m and more away from a
/// camera near the origin that looks along +y: the camera is outside every box. Every other
/// time in a room.
inline Scene AnyScene(int most = 16) {
  Scene scene;
  scene.name = "generated";
  const int count = AnyInt(1, most);
  for (int id = 1; id <= count; ++id) {
    const Eigen::Vector3d size(Real(0.1, 1), Real(0.1, 1), Real(0.1, 1));
    const Eigen::Vector3d center(Real(-2, 2), Real(2.2, 6), Real(-1.5, 1.5));
    scene.objects.push_back(BoxObject(id, "box", Role::kRegular, center, size));
    scene.objects.back().q_wo = AnyRotation();
  }
  if (AnyInt(0, 1) == 1) AddRoom(scene);
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
  double z = 0;
  int object = 0;
  int plane = 0;  ///< counted as formats.md has it: six a box, -x +x -y +y -z +z
};

/// The nearest box on the ray, by slabs in each box's own frame: knows nothing of triangles.
inline std::optional<BoxHit> CastAtBoxes(const Scene& scene, const Eigen::Vector3d& origin_w,
                                         const Eigen::Vector3d& direction_w) {
  std::optional<BoxHit> nearest;
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    const Object& object = scene.objects[i];
    const Eigen::Vector3d o = object.q_wo.conjugate() * (origin_w - object.center_w);
    const Eigen::Vector3d d = object.q_wo.conjugate() * direction_w;
    double enter = 0, leave = 1e9;
    int face = -1;
    for (int axis = 0; axis < 3; ++axis) {
      const double a = (-0.5 * object.size[axis] - o[axis]) / d[axis];
      const double b = (0.5 * object.size[axis] - o[axis]) / d[axis];
      if (std::min(a, b) > enter) {
        enter = std::min(a, b);
        face = 2 * axis + (a < b ? 0 : 1);
      }
      leave = std::min(leave, std::max(a, b));
    }
    if (face < 0 || !(enter < leave) || (nearest && enter >= nearest->z)) continue;
    nearest = BoxHit{enter, object.id, 6 * static_cast<int>(i) + face + 1};
  }
  return nearest;
}

/// What the boxes show at a place of the image; nothing is {0, 0, 0}.
inline BoxHit BoxAt(const Scene& scene, const Camera& camera, const Pose& T_wc, double u,
                    double v) {
  return CastAtBoxes(scene, T_wc.t, T_wc.R * camera.Ray(u, v)).value_or(BoxHit{});
}

/// Whether the boxes show one plane all round a pixel's centre, a hundredth of a pixel away.
inline bool FarFromEdges(const Scene& scene, const Camera& camera, const Pose& T_wc, int u,
                         int v) {
  constexpr double kAway_px = 0.01;
  const int plane = BoxAt(scene, camera, T_wc, u, v).plane;
  for (int k = 0; k < 8; ++k) {
    const double du = kAway_px * std::cos(k * M_PI / 4), dv = kAway_px * std::sin(k * M_PI / 4);
    if (BoxAt(scene, camera, T_wc, u + du, v + dv).plane != plane) return false;
  }
  return true;
}

/// Same pixels, bit for bit.
inline bool Same(const cv::Mat& a, const cv::Mat& b) {
  if (a.size() != b.size() || a.type() != b.type()) return false;
  for (int v = 0; v < a.rows; ++v) {
    if (std::memcmp(a.ptr(v), b.ptr(v), a.elemSize() * static_cast<std::size_t>(a.cols)) != 0) {
      return false;
    }
  }
  return true;
}

}  // namespace sim
