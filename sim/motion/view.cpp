#include "sim/motion/view.h"

#include <algorithm>
#include <cmath>

#include "sim/base/angle.h"

namespace sim {

double TurnBetween_deg(const Pose& a, const Pose& b) {
  // |log(Ra^T Rb)| from the chord: exact for every angle and steady near zero.
  const double chord = (a.R - b.R).norm() / std::sqrt(8.0);
  return RadToDeg(2 * AsinRad(chord));
}

View Blend(const std::array<View, 4>& knots, double u) {
  const double v = 1 - u;
  const std::array<double, 4> weight{v * v * v / 6, (3 * u * u * u - 6 * u * u + 4) / 6,
                                     (3 * v * v * v - 6 * v * v + 4) / 6, u * u * u / 6};
  View view;
  for (std::size_t i = 0; i < 4; ++i) {
    view.camera_w += weight[i] * knots[i].camera_w;
    view.gaze_w += weight[i] * knots[i].gaze_w;
    view.roll_deg += weight[i] * knots[i].roll_deg;
  }
  return view;
}

View Along(const std::vector<View>& knots, double at) {
  const auto first = static_cast<std::size_t>(at);
  // Where a stretch begins its fourth view has no weight: at the last place it is not there.
  const std::size_t fourth = std::min(first + 3, knots.size() - 1);
  return Blend({knots[first], knots[first + 1], knots[first + 2], knots[fourth]},
               at - static_cast<double>(first));
}

Pose PoseOf(const View& view) {
  const Eigen::Vector3d forward = (view.gaze_w - view.camera_w).normalized();
  const Eigen::Vector3d right = forward.cross(Eigen::Vector3d::UnitZ()).normalized();
  const Eigen::Vector3d down = forward.cross(right);
  const SinCos roll = SinCosDeg(view.roll_deg);
  Pose T_wc;
  T_wc.R.col(0) = roll.cos * right + roll.sin * down;
  T_wc.R.col(1) = roll.cos * down - roll.sin * right;
  T_wc.R.col(2) = forward;
  T_wc.t = view.camera_w;
  return T_wc;
}

}  // namespace sim
