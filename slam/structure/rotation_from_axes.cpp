#include "slam/structure/rotation_from_axes.h"

#include <Eigen/Eigenvalues>

#include "slam/pose/factors/plane.h"

namespace slam {
namespace {

constexpr int kIterations = 10;
constexpr double kConverged_rad = 1e-10;
// Two axes a tenth of a degree apart, or one alone: the turn about them is not observed.
constexpr double kMinInformationRatio = 3e-6;
constexpr double kMaxTurn_rad = 0.5;  // farther off, axes were confused

struct WahbaSum {
  Eigen::Matrix3d H = Eigen::Matrix3d::Zero();
  Eigen::Vector3d g = Eigen::Vector3d::Zero();
  bool valid = true;
};

/// Sum of w |turn between n_c and R a_w|^2 for R <- Exp(omega) R.
WahbaSum SumOf(const std::vector<AxisObservation>& axes, const Eigen::Matrix3d& R_cw) {
  WahbaSum sum;
  for (const AxisObservation& o : axes) {
    const Eigen::Vector3d a_c = R_cw * o.axis_w;
    const NormalDifference turn = TurnBetween(o.n_c, a_c);
    sum.valid = sum.valid && turn.valid && turn.r.norm() < kMaxTurn_rad;
    const double weight = 1 / (o.sigma_rad * o.sigma_rad);
    sum.H += weight * (Eigen::Matrix3d::Identity() - a_c * a_c.transpose());
    sum.g += weight * turn.r;
  }
  return sum;
}

}  // namespace

std::optional<RotationConstraint> RotationFromAxes(const std::vector<AxisObservation>& axes,
                                                   const Eigen::Matrix3d& R_cw) {
  if (axes.empty()) return std::nullopt;
  RotationConstraint out;
  out.R_cw = R_cw;
  for (int i = 0; i < kIterations; ++i) {
    const WahbaSum sum = SumOf(axes, out.R_cw);
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(sum.H);
    if (!sum.valid || eigen.info() != Eigen::Success) return std::nullopt;
    // The shortest step; what is not observed stays.
    Eigen::Vector3d step = Eigen::Vector3d::Zero();
    out.sqrt_information.setZero();
    for (int k = 0; k < 3; ++k) {
      const double value = eigen.eigenvalues()[k];
      if (!(value > kMinInformationRatio * eigen.eigenvalues()[2])) continue;
      const Eigen::Vector3d v = eigen.eigenvectors().col(k);
      step -= v * v.dot(sum.g) / value;
      out.sqrt_information.row(k) = std::sqrt(value) * v.transpose();
    }
    out.R_cw = ExpSo3(step) * out.R_cw;
    if (step.norm() < kConverged_rad) return out;
  }
  return out;
}

}  // namespace slam
