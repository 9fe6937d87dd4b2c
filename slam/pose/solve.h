#pragma once

#include <Eigen/Core>

#include "slam/geometry/pose.h"

namespace slam {

/// Normal equations of a least-squares problem over one pose: H = J^T W J, g = J^T W r, for
/// T <- Exp(xi) T. Only the upper triangle of H is written while summing.
struct NormalEquations {
  Matrix6d H = Matrix6d::Zero();
  Vector6d g = Vector6d::Zero();
  double cost = 0.0;
};

struct SolveSummary {
  Pose T_cw;
  NormalEquations at;  ///< at the solution, H symmetric
  bool finite = true;  ///< false: the cost was not finite at the first guess
};

/// Directions of the pose that H says nothing about, 0 to 6: eigenvalues below 1e-9 of the
/// largest after each unknown is scaled by its own curvature (metres against radians must not
/// decide).
int Nullity(const Matrix6d& H);

namespace solve_detail {
/// One damped step (H + lambda D) xi = -g; not finite when the system has no answer.
Vector6d DampedStep(const NormalEquations& at, double lambda);
bool Finite(const NormalEquations& at);
bool StepIsSmall(const Vector6d& xi);
}  // namespace solve_detail

/// Levenberg-Marquardt over one pose.
/// @param evaluate  NormalEquations(const Pose&); its H may be upper triangular
/// Stops when the step is below 1e-10, when the cost falls by less than one part in 10^9, or
/// after `max_iterations` trial steps. Never returns a pose worse than T_cw.
template <typename Evaluate>
SolveSummary SolvePose(const Pose& T_cw, int max_iterations, const Evaluate& evaluate) {
  // Relative to the curvature: nearly Gauss-Newton at first; beyond the bounds nothing changes.
  constexpr double kFirstLambda = 1e-4, kMinLambda = 1e-12, kMaxLambda = 1e12;
  constexpr double kLambdaDown = 0.1, kLambdaUp = 10.0;  // Marquardt 1963
  constexpr double kMinRelativeDecrease = 1e-9;
  SolveSummary out;
  out.T_cw = T_cw;
  out.at = evaluate(T_cw);
  out.finite = solve_detail::Finite(out.at);
  double lambda = kFirstLambda;
  bool converged = false;
  for (int trial_step = 0; out.finite && !converged && trial_step < max_iterations;
       ++trial_step) {
    const Vector6d xi = solve_detail::DampedStep(out.at, lambda);
    if (!xi.allFinite()) break;
    const Pose trial_cw = Exp(xi) * out.T_cw;
    const NormalEquations trial = evaluate(trial_cw);
    const bool small = solve_detail::StepIsSmall(xi);
    if (solve_detail::Finite(trial) && trial.cost < out.at.cost) {
      converged = small || out.at.cost - trial.cost < kMinRelativeDecrease * out.at.cost;
      out.T_cw = trial_cw;
      out.at = trial;
      lambda = lambda > kMinLambda ? kLambdaDown * lambda : lambda;
    } else {
      converged = small || !(lambda < kMaxLambda);
      lambda *= kLambdaUp;
    }
  }
  out.T_cw = Normalised(out.T_cw);
  out.at.H = out.at.H.selfadjointView<Eigen::Upper>();
  return out;
}

}  // namespace slam
