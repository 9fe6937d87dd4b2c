#include "slam/tracking/motion_filter.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>

namespace slam {
namespace {

double LargestSigma(const Eigen::Matrix3d& covariance) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(covariance, Eigen::EigenvaluesOnly);
  return std::sqrt(axes.eigenvalues()[2]);
}

}  // namespace

bool IsKnownWell(const Matrix6d& covariance, const MotionFilterConfig& config) {
  return LargestSigma(covariance.topLeftCorner<3, 3>()) < config.max_sigma_m &&
         LargestSigma(covariance.bottomRightCorner<3, 3>()) < config.max_sigma_rad;
}

Vector6d MotionFilter::SpeedVariance() const {
  const double v2 = config_.speed_mps * config_.speed_mps;
  const double w2 = config_.turn_rad_per_s * config_.turn_rad_per_s;
  Vector6d variance;
  variance << v2, v2, v2, w2, w2, w2;
  return variance;
}

MotionFilter::State MotionFilter::At(double timestamp_s) const {
  const double dt_s = timestamp_s - known_->timestamp_s;
  const double tau_s = config_.memory_s;
  const double kept = std::exp(-dt_s / tau_s);
  const double way_s = tau_s * (1 - kept);  // for so long the speed would have to last

  // The most likely pose: the speed carries on and dies away.
  State now;
  now.timestamp_s = timestamp_s;
  now.T_cw = Normalised(Exp(way_s * known_->speed) * known_->T_cw);
  now.speed = kept * known_->speed;

  // Its covariance: what was known of pose and speed, moved on ...
  Matrix12d F = Matrix12d::Identity();
  F.topRightCorner<6, 6>() = way_s * Matrix6d::Identity();
  F.bottomRightCorner<6, 6>() = kept * Matrix6d::Identity();
  now.covariance = F * known_->covariance * F.transpose();
  // ... and what the hand may have done since: the integrals of the process's noise.
  const Matrix6d S = SpeedVariance().asDiagonal();
  const double tau2 = tau_s * tau_s;
  now.covariance.topLeftCorner<6, 6>() +=
      tau2 * (2 * dt_s / tau_s - 3 + 4 * kept - kept * kept) * S;
  now.covariance.topRightCorner<6, 6>() += tau_s * (1 - kept) * (1 - kept) * S;
  now.covariance.bottomLeftCorner<6, 6>() += tau_s * (1 - kept) * (1 - kept) * S;
  now.covariance.bottomRightCorner<6, 6>() += (1 - kept * kept) * S;
  return now;
}

std::optional<UncertainPose> MotionFilter::Predict(double timestamp_s) const {
  if (!known_ || !(timestamp_s > known_->timestamp_s)) return std::nullopt;
  const State state = At(timestamp_s);
  return UncertainPose{state.T_cw, state.covariance.topLeftCorner<6, 6>()};
}

UncertainSpeed MotionFilter::Speed(double timestamp_s) const {
  if (!known_ && start_ && start_->timestamp_s == timestamp_s) return start_->speed;
  if (!known_ || !(timestamp_s > known_->timestamp_s)) {
    return {Vector6d::Zero(), SpeedVariance().asDiagonal()};
  }
  const State state = At(timestamp_s);
  return {state.speed, state.covariance.bottomRightCorner<6, 6>()};
}

SpeedByPose MotionFilter::SpeedOf(const State& predicted) {
  // The speed follows the pose by what the two have in common.
  const Matrix6d P = predicted.covariance.topLeftCorner<6, 6>();
  const Matrix6d in_common = predicted.covariance.topRightCorner<6, 6>();
  const Matrix6d gain = P.ldlt().solve(in_common).transpose();
  return {predicted.T_cw, predicted.speed, gain,
          predicted.covariance.bottomRightCorner<6, 6>() - gain * in_common};
}

std::optional<SpeedByPose> MotionFilter::SpeedAt(double timestamp_s) const {
  if (!known_ || !(timestamp_s > known_->timestamp_s)) return std::nullopt;
  return SpeedOf(At(timestamp_s));
}

void MotionFilter::Observe(double timestamp_s, const Pose& T_cw,
                           const MotionEvidence& evidence) {
  if (!known_) {
    // The first pose is the world, or was found by what is seen; nothing is known of the speed but
    // that a hand holds it, or what was said before.
    const UncertainSpeed speed = Speed(timestamp_s);
    if (!first_s_) first_s_ = timestamp_s;
    State first;
    first.timestamp_s = timestamp_s;
    first.T_cw = T_cw;
    if (const Eigen::FullPivLU<Matrix6d> seen(evidence.of_pose); seen.isInvertible())
      first.covariance.topLeftCorner<6, 6>() = seen.inverse();
    first.speed = speed.mean;
    first.covariance.bottomRightCorner<6, 6>() = speed.covariance;
    known_ = first;
    return;
  }
  // Kalman's update in the form that a singular information allows: the pose is found already.
  if (!(timestamp_s > known_->timestamp_s)) {
    known_->T_cw = T_cw;
    return;
  }
  const bool second = known_->timestamp_s == first_s_;
  State state = At(timestamp_s);
  state.speed = evidence.speed ? *evidence.speed : SpeedOf(state).At(T_cw);
  state.T_cw = T_cw;
  const double late_s = evidence.late_s;
  Matrix12d information;
  information << evidence.of_pose + evidence.of_late_pose, late_s * evidence.of_late_pose,
      late_s * evidence.of_late_pose, late_s * late_s * evidence.of_late_pose;
  state.covariance = (Matrix12d::Identity() + state.covariance * information)
                         .partialPivLu()
                         .solve(state.covariance);
  state.covariance = 0.5 * (state.covariance + state.covariance.transpose().eval());
  known_ = state;
  // A way tells as much of the speed at its beginning as of that at its end.
  if (second) {
    at_start_ = {*first_s_, {state.speed, state.covariance.bottomRightCorner<6, 6>()}};
  }
}

void MotionFilter::Correct(const Pose& T_cw) {
  if (known_) known_->T_cw = T_cw;
}

}  // namespace slam
