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

using Matrix12d = Eigen::Matrix<double, 12, 12>;

/// Turns each three of a vector by R.
template <int kSize>
Eigen::Matrix<double, kSize, kSize> Turn(const Eigen::Matrix3d& R) {
  Eigen::Matrix<double, kSize, kSize> turn = Eigen::Matrix<double, kSize, kSize>::Zero();
  for (int i = 0; i < kSize; i += 3) turn.template block<3, 3>(i, i) = R;
  return turn;
}

/// The same matrix in axes that are turned by R.
Matrix12d Turned(const Eigen::Matrix3d& R, const Matrix12d& A) {
  const Matrix12d turn = Turn<12>(R);
  return turn * A * turn.transpose();
}

}  // namespace

Vector6d MotionFilter::State::Speed() const { return Turn<6>(T_cw.R) * speed_w; }
MotionFilter::Matrix12d MotionFilter::State::Covariance() const {
  return Turned(T_cw.R, covariance_w);
}
void MotionFilter::State::SetSpeed(const Vector6d& speed) {
  speed_w = Turn<6>(T_cw.R).transpose() * speed;
}

bool IsKnownWell(const Matrix6d& covariance, const MotionFilterConfig& config) {
  return LargestSigma(covariance.topLeftCorner<3, 3>()) < config.max_sigma_m &&
         LargestSigma(covariance.bottomRightCorner<3, 3>()) < config.max_sigma_rad;
}

MotionFilter::State MotionFilter::At(double timestamp_s) const {
  const double dt_s = timestamp_s - known_->timestamp_s;
  const double tau_s = config_.memory_s;
  const double kept = std::exp(-dt_s / tau_s);
  const double way_s = tau_s * (1 - kept);  // for so long the speed would have to last

  // The most likely pose: the speed carries on and dies away.
  State now;
  now.timestamp_s = timestamp_s;
  const Vector6d way = way_s * known_->Speed();
  const Eigen::Matrix3d turn = ExpSo3(way.tail<3>());
  now.T_cw = Normalised({turn * known_->T_cw.R, turn * (known_->T_cw.t + way.head<3>())});
  now.speed_w = kept * known_->speed_w;

  // Its covariance: what was known of pose and speed, moved on ...
  Matrix12d F = Matrix12d::Identity();
  F.topRightCorner<6, 6>() = way_s * Matrix6d::Identity();
  F.bottomRightCorner<6, 6>() = kept * Matrix6d::Identity();
  now.covariance_w = F * known_->covariance_w * F.transpose();
  // ... and what the hand may have done since: the integrals of the process's noise.
  const Matrix6d S = SpeedCovariance();
  const double tau2 = tau_s * tau_s;
  now.covariance_w.topLeftCorner<6, 6>() +=
      tau2 * (2 * dt_s / tau_s - 3 + 4 * kept - kept * kept) * S;
  now.covariance_w.topRightCorner<6, 6>() += tau_s * (1 - kept) * (1 - kept) * S;
  now.covariance_w.bottomLeftCorner<6, 6>() += tau_s * (1 - kept) * (1 - kept) * S;
  now.covariance_w.bottomRightCorner<6, 6>() += (1 - kept * kept) * S;
  return now;
}

std::optional<UncertainPose> MotionFilter::Predict(double timestamp_s) const {
  if (!known_ || !(timestamp_s > known_->timestamp_s)) return std::nullopt;
  const State state = At(timestamp_s);
  return UncertainPose{state.T_cw, state.Covariance().topLeftCorner<6, 6>()};
}

UncertainSpeed MotionFilter::Speed(double timestamp_s) const {
  if (!known_ && start_ && start_->timestamp_s == timestamp_s) return start_->speed;
  if (!known_ || !(timestamp_s > known_->timestamp_s)) {
    return {Vector6d::Zero(), SpeedCovariance()};
  }
  const State state = At(timestamp_s);
  return {state.Speed(), state.Covariance().bottomRightCorner<6, 6>()};
}

SpeedByPose MotionFilter::SpeedOf(const State& predicted) {
  // The speed follows the pose by what the two have in common.
  const Matrix12d covariance = predicted.Covariance();
  const Matrix6d P = covariance.topLeftCorner<6, 6>();
  const Matrix6d in_common = covariance.topRightCorner<6, 6>();
  const Matrix6d gain = P.ldlt().solve(in_common).transpose();
  return {predicted.T_cw, predicted.Speed(), gain,
          covariance.bottomRightCorner<6, 6>() - gain * in_common};
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
    Matrix12d covariance = Matrix12d::Zero();
    if (const Eigen::FullPivLU<Matrix6d> seen(evidence.of_pose); seen.isInvertible())
      covariance.topLeftCorner<6, 6>() = seen.inverse();
    covariance.bottomRightCorner<6, 6>() = speed.covariance;
    first.covariance_w = Turned(T_cw.R.transpose(), covariance);
    first.SetSpeed(speed.mean);
    known_ = first;
    return;
  }
  // Kalman's update in the form that a singular information allows: the pose is found already.
  if (!(timestamp_s > known_->timestamp_s)) return Correct(T_cw);
  const bool second = known_->timestamp_s == first_s_;
  State state = At(timestamp_s);
  const Vector6d speed = evidence.speed ? *evidence.speed : SpeedOf(state).At(T_cw);
  state.T_cw = T_cw;
  state.SetSpeed(speed);
  const double late_s = evidence.late_s;
  Matrix12d information;
  information << evidence.of_pose + evidence.of_late_pose, late_s * evidence.of_late_pose,
      late_s * evidence.of_late_pose, late_s * late_s * evidence.of_late_pose;
  const Matrix12d information_w = Turned(T_cw.R.transpose(), information);
  state.covariance_w = (Matrix12d::Identity() + state.covariance_w * information_w)
                           .partialPivLu()
                           .solve(state.covariance_w);
  state.covariance_w = 0.5 * (state.covariance_w + state.covariance_w.transpose().eval());
  // A way tells as much of the speed at its beginning as of that at its end.
  if (second) {
    State first = state;
    first.T_cw = known_->T_cw;
    at_start_ = {*first_s_, {first.Speed(), first.Covariance().bottomRightCorner<6, 6>()}};
  }
  known_ = state;
}

void MotionFilter::Correct(const Pose& T_cw) {
  if (!known_) return;
  // The camera goes on as before, as it sees itself.
  const Eigen::Matrix3d turn = T_cw.R.transpose() * known_->T_cw.R;
  known_->T_cw = T_cw;
  known_->speed_w = Turn<6>(turn) * known_->speed_w;
  known_->covariance_w = Turned(turn, known_->covariance_w);
}

}  // namespace slam
