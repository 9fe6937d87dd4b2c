#include "slam/pose/late_planes.h"

#include <Eigen/LU>

namespace slam {
namespace {

/// By how much the unknown part of the speed blunts what is said of the later pose: a factor.
Matrix6d Blunt(const LatePlanes& late, const Matrix6d& H) {
  const Matrix6d unknown = late.late_s * late.late_s * late.speed.covariance;
  return (Matrix6d::Identity() + H * unknown).inverse();
}

Matrix6d Full(const Matrix6d& upper) { return upper.selfadjointView<Eigen::Upper>(); }

}  // namespace

Pose LatePlanes::SeenFrom(const Pose& T_cw) const {
  return Exp(late_s * (speed.At(T_cw) - compensated_speed)) * T_cw;
}

NormalEquations LatePlanes::OfPose(const NormalEquations& seen) const {
  const Matrix6d H = Full(seen.H);
  const Matrix6d blunt = Blunt(*this, H);
  // A step of T_cw on the left moves the later pose by so much, to the first order in late_s.
  const Matrix6d J = Matrix6d::Identity() + late_s * speed.gain;
  NormalEquations out;
  out.H = J.transpose() * (blunt * H) * J;
  out.g = J.transpose() * (blunt * seen.g);
  out.cost =
      seen.cost - 0.5 * late_s * late_s * seen.g.dot(speed.covariance * (blunt * seen.g));
  return out;
}

Vector6d LatePlanes::SpeedAt(const Pose& T_cw, const NormalEquations& seen) const {
  return speed.At(T_cw) - late_s * (speed.covariance * (Blunt(*this, Full(seen.H)) * seen.g));
}

}  // namespace slam
