#include "sim/scene/geometry.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sim {
namespace {

/// Products of nearly parallel edges give no axis of their own.
constexpr double kMinAxisNorm = 1e-9;

double HalfExtent(const Pose& T_wo, const Eigen::Vector3d& half,
                  const Eigen::Vector3d& axis_w) {
  return (T_wo.R.transpose() * axis_w).cwiseAbs().dot(half);
}

}  // namespace

Pose ObjectPose(const Object& object) {
  return {object.q_wo.toRotationMatrix(), object.center_w};
}

std::array<Eigen::Vector3d, 8> Corners(const Object& object) {
  const Pose T_wo = ObjectPose(object);
  std::array<Eigen::Vector3d, 8> corners_w;
  for (unsigned i = 0; i < 8; ++i) {
    const Eigen::Vector3d sign(i & 1 ? 0.5 : -0.5, i & 2 ? 0.5 : -0.5, i & 4 ? 0.5 : -0.5);
    corners_w[i] = T_wo * sign.cwiseProduct(object.size);
  }
  return corners_w;
}

double OverlapDepth(const Object& a, const Object& b) {
  const Pose T_wa = ObjectPose(a), T_wb = ObjectPose(b);
  const Eigen::Vector3d between_w = T_wb.t - T_wa.t;
  double depth = std::numeric_limits<double>::infinity();
  const auto try_axis = [&](const Eigen::Vector3d& axis_w) {
    const double norm = axis_w.norm();
    if (!(norm > kMinAxisNorm)) return;
    const double reach =
        HalfExtent(T_wa, a.size / 2, axis_w) + HalfExtent(T_wb, b.size / 2, axis_w);
    depth = std::min(depth, (reach - std::abs(between_w.dot(axis_w))) / norm);
  };
  for (int i = 0; i < 3; ++i) {
    try_axis(T_wa.R.col(i));
    try_axis(T_wb.R.col(i));
    for (int j = 0; j < 3; ++j) try_axis(T_wa.R.col(i).cross(T_wb.R.col(j)));
  }
  return depth;
}

double DistanceToBox(const Object& object, const Eigen::Vector3d& x_w) {
  const Eigen::Vector3d x_o = ObjectPose(object).R.transpose() * (x_w - object.center_w);
  const Eigen::Vector3d beyond = x_o.cwiseAbs() - object.size / 2;
  const double inside = std::min(beyond.maxCoeff(), 0.0);
  return beyond.cwiseMax(0.0).norm() + inside;
}

}  // namespace sim
