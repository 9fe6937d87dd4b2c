#include "sim/scene/geometry.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/base/angle.h"

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

Object ObjectAt(const Object& object, double time_s) {
  if (object.way.empty()) return object;
  const auto after = std::find_if(object.way.begin(), object.way.end(),
                                  [&](const Waypoint& p) { return p.time_s > time_s; });
  const Waypoint& b = after == object.way.end() ? object.way.back() : *after;
  const Waypoint& a = after == object.way.begin() ? b : *(after - 1);
  const double gap_s = b.time_s - a.time_s;
  const double part = gap_s > 0 ? (time_s - a.time_s) / gap_s : 0;
  Object there = object;
  there.center_w = a.center_w + part * (b.center_w - a.center_w);
  const double yaw_deg = a.yaw_deg + part * (b.yaw_deg - a.yaw_deg);
  there.q_wo = QuaternionFromRpyDeg({0, 0, yaw_deg}) * object.q_wo;
  there.way.clear();
  return there;
}

Pose ObjectPoseAt(const Object& object, double time_s) {
  return ObjectPose(ObjectAt(object, time_s));
}

std::vector<double> MomentsOf(const Object& object, double step_m) {
  if (object.way.empty()) return {0};
  std::vector<double> moments{object.way.front().time_s};
  for (std::size_t i = 1; i < object.way.size(); ++i) {
    const Waypoint &a = object.way[i - 1], &b = object.way[i];
    const double turn_m = DegToRad(std::abs(b.yaw_deg - a.yaw_deg)) * object.size.norm() / 2;
    const double length = (b.center_w - a.center_w).norm() + turn_m;
    const int steps = std::max(1, static_cast<int>(std::ceil(length / step_m)));
    for (int k = 1; k <= steps; ++k) {
      moments.push_back(a.time_s + (b.time_s - a.time_s) * k / steps);
    }
  }
  return moments;
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
