#include "slam/pose/held_directions.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace slam {
namespace {

void AddAxes(const Eigen::Matrix3d& predicted, const Eigen::Matrix3d& estimated, bool turn,
             std::vector<MotionAxis>& axes) {
  constexpr double kMostOfIt = 0.5;  // of the variance
  // Along which functionals of the motion is most of the variance left?
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::Matrix3d> left(estimated, predicted);
  if (left.info() != Eigen::Success) return;
  for (int i = 2; i >= 0 && left.eigenvalues()[i] > kMostOfIt; --i) {
    // The functional's own direction of motion.
    axes.push_back({turn, (predicted * left.eigenvectors().col(i)).normalized()});
  }
}

/// Along one of the steps.
Vector6d Along(const Eigen::Vector3d& step_c) {
  Vector6d d = Vector6d::Zero();
  d.head<3>() = step_c;
  return d;
}

}  // namespace

std::vector<Eigen::Vector3d> UnseenSteps(const std::vector<PlaneConstraint>& planes,
                                         const Eigen::Matrix3d& R_cw) {
  constexpr double kMaxSine =
      0.17;  // 10 degrees: several times what the normal of a patch errs by
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  const auto normal_c = [&](const PlaneConstraint& plane) -> Eigen::Vector3d {
    return R_cw * plane.pi_w.n;
  };
  for (const PlaneConstraint& plane : planes)
    spread += normal_c(plane) * normal_c(plane).transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(spread);
  std::vector<Eigen::Vector3d> unseen;
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d step_c = axes.eigenvectors().col(i);
    const auto tells = [&](const PlaneConstraint& plane) {
      return std::abs(normal_c(plane).dot(step_c)) > kMaxSine;
    };
    if (std::none_of(planes.begin(), planes.end(), tells)) unseen.push_back(step_c);
  }
  return unseen;
}

UncertainPose HeldAlong(const UncertainPose& predicted,
                        const std::vector<Eigen::Vector3d>& steps_c) {
  constexpr double kTakenAway = 1 - 1e-6;  // of the variance: all, but for the inverse
  UncertainPose held = predicted;
  for (const Eigen::Vector3d& step_c : steps_c) {
    const Vector6d shared = held.covariance * Along(step_c);
    held.covariance -= kTakenAway / Along(step_c).dot(shared) * shared * shared.transpose();
  }
  return held;
}

Matrix6d WithoutSteps(const Matrix6d& information,
                      const std::vector<Eigen::Vector3d>& steps_c) {
  Matrix6d seen = Matrix6d::Identity();
  for (const Eigen::Vector3d& step_c : steps_c)
    seen -= Along(step_c) * Along(step_c).transpose();
  return seen * information * seen;
}

std::vector<MotionAxis> HeldByPrediction(const Matrix6d& predicted, const Matrix6d& estimated) {
  std::vector<MotionAxis> axes;
  AddAxes(predicted.topLeftCorner<3, 3>(), estimated.topLeftCorner<3, 3>(), false, axes);
  AddAxes(predicted.bottomRightCorner<3, 3>(), estimated.bottomRightCorner<3, 3>(), true, axes);
  return axes;
}

}  // namespace slam
