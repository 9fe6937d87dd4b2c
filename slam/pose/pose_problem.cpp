#include "slam/pose/pose_problem.h"

#include <Eigen/Cholesky>
#include <cmath>

#include "slam/base/chi_square.h"
#include "slam/pose/factors/box.h"
#include "slam/pose/factors/parallel.h"
#include "slam/pose/factors/perpendicular.h"
#include "slam/pose/factors/plane.h"
#include "slam/pose/factors/point.h"
#include "slam/pose/factors/point_plane.h"
#include "slam/pose/factors/rotation.h"
#include "slam/pose/factors/vertex.h"
#include "slam/pose/robust.h"
#include "slam/pose/solve.h"

namespace slam {
namespace {

constexpr double kNormalTolerance = 1e-6;  // a normal farther from unit length is not one

bool Positive(double sigma) { return sigma > 0 && std::isfinite(sigma); }

/// Whether a constraint is finite: others are left out of the sums.
bool Sane(const PointConstraint& c) {
  return c.p_w.allFinite() && c.u_px.allFinite() && Positive(c.sigma_px) &&
         (c.depth_m == 0 || (Positive(c.depth_m) && Positive(c.depth_sigma_m)));
}

bool IsNormal(const Eigen::Vector3d& n) {
  return n.allFinite() && std::abs(n.norm() - 1) < kNormalTolerance;
}

bool Sane(const Plane& pi) { return std::isfinite(pi.d) && IsNormal(pi.n); }

bool Sane(const PlaneConstraint& c) {
  return Sane(c.pi_w) && Sane(c.pi_c) && c.centroid_c.allFinite() &&
         Positive(c.angle_sigma_rad) && Positive(c.offset_sigma_m);
}

bool Sane(const BoxConstraint& c) {
  for (const Eigen::Vector3d& p_w : c.corners_w) {
    if (!p_w.allFinite()) return false;
  }
  return !c.box_obs_px.empty() && Positive(c.sigma_px);
}

bool Sane(const PointPlaneConstraint& c) {
  return c.p_w.allFinite() && Sane(c.pi_c) && Positive(c.sigma_m);
}

bool Sane(const VertexConstraint& c) {
  return c.p_w.allFinite() && c.p_c.allFinite() && c.sqrt_information.allFinite();
}

bool Sane(const DirectionConstraint& c) {
  return IsNormal(c.n_w) && IsNormal(c.n_c) && Positive(c.sigma_rad);
}

bool Sane(const RotationConstraint& c) {
  return (c.R_cw * c.R_cw.transpose()).isIdentity(kNormalTolerance) &&
         c.sqrt_information.allFinite();
}

/// Adds a whitened block: H += w J^T J, g += w J^T r, upper triangle only.
template <int kRows>
void Add(const Linearised<kRows>& f, double huber, NormalEquations& sum) {
  const HuberLoss loss = Huber(f.r.squaredNorm(), huber);
  const Eigen::Matrix<double, kRows, 6> WJ = loss.weight * f.J;
  for (int i = 0; i < 6; ++i) {
    for (int j = i; j < 6; ++j) sum.H(i, j) += WJ.col(i).dot(f.J.col(j));
    sum.g[i] += WJ.col(i).dot(f.r);
  }
  sum.cost += loss.cost;
}

/// The factor in sigmas.
template <int kRows>
Linearised<kRows> Whitened(Linearised<kRows> f, double inv_sigma) {
  f.r *= inv_sigma;
  f.J *= inv_sigma;
  return f;
}

/// Sums the factors of one problem at a pose, eq13.
class Evaluator {
 public:
  Evaluator(const PoseProblem& problem, const Camera& camera, const PoseProblemConfig& config)
      : problem_(problem), camera_(camera), config_(config) {
    sane_.reserve(problem.points.size());
    for (const PointConstraint& c : problem.points) sane_.push_back(Sane(c));
    used = sane_;
    if (problem.prior) {
      prior_information_ = problem.prior->covariance.ldlt().solve(Matrix6d::Identity());
      T_wc_prior_ = Inverse(problem.prior->T_cw);
    }
  }

  std::vector<bool> used;     ///< points that take part
  bool robust_points = true;  ///< Huber on points
  double plane_sigmas = 1.0;  ///< factor on the standard deviations of all planes

  NormalEquations operator()(const Pose& T_cw) const {
    NormalEquations sum = Measured(T_cw);
    AddPrior(T_cw, sum);
    return sum;
  }

  /// The step away from the prior is small, so its Jacobian is taken as the identity.
  void AddPrior(const Pose& T_cw, NormalEquations& sum) const {
    if (!problem_.prior) return;
    const Vector6d moved = Log(T_cw * T_wc_prior_);
    const Vector6d g = prior_information_ * moved;
    sum.H += prior_information_;
    sum.g += g;
    sum.cost += 0.5 * moved.dot(g);
  }

  /// The sum without the prior.
  NormalEquations Measured(const Pose& T_cw) const {
    NormalEquations sum = AtItsTime(T_cw);
    if (!problem_.late) return sum;
    const NormalEquations late = problem_.late->OfPose(Late(T_cw));
    sum.H += late.H;
    sum.g += late.g;
    sum.cost += late.cost;
    return sum;
  }

  /// What was measured at the time of the pose.
  NormalEquations AtItsTime(const Pose& T_cw) const {
    NormalEquations sum;
    if (config_.use_points) AddPoints(T_cw, sum);  // eq14
    if (config_.use_boxes) AddBoxes(T_cw, sum);    // eq17
    if (!problem_.late) AddSeenPlanes(T_cw, sum);
    return sum;
  }

  /// What late planes say of where they were seen from.
  NormalEquations Late(const Pose& T_cw) const {
    NormalEquations sum;
    AddSeenPlanes(problem_.late->SeenFrom(T_cw), sum);
    return sum;
  }

  /// How many of their standard deviations the planes are off by, root mean square; 1 at least.
  double PlaneDisagreement(const Pose& T_cw) const {
    constexpr int kDof = 3;  // a normal and an offset
    const Pose seen_from = problem_.late ? problem_.late->SeenFrom(T_cw) : T_cw;
    double chi2 = 0.0;
    int dof = 0;
    for (const PlaneConstraint& c : problem_.planes) {
      const Linearised<4> f = WhitenedPlane(c, seen_from);
      if (f.valid) chi2 += f.r.squaredNorm(), dof += kDof;
    }
    return std::sqrt(std::max(1.0, chi2 / std::max(dof, 1)));
  }

  /// Takes as inliers the points whose chi-square passes at T_cw.
  int Classify(const Pose& T_cw) {
    int inliers = 0;
    for (std::size_t i = 0; i < used.size(); ++i) {
      used[i] = false;
      if (!sane_[i]) continue;
      const PointConstraint& c = problem_.points[i];
      const Linearised<3> f = PointFactor(c, T_cw, camera_);
      used[i] = f.valid && f.r.squaredNorm() < Chi2(c);
      inliers += used[i] ? 1 : 0;
    }
    return inliers;
  }

 private:
  double Chi2(const PointConstraint& c) const {
    return c.depth_m > 0 ? kChi2Of3At95 : kChi2Of2At95;
  }

  void AddPoints(const Pose& T_cw, NormalEquations& sum) const {
    for (std::size_t i = 0; i < used.size(); ++i) {
      if (!used[i]) continue;
      const PointConstraint& c = problem_.points[i];
      const double huber = robust_points ? std::sqrt(Chi2(c)) : 0.0;
      const Linearised<3> f = PointFactor(c, T_cw, camera_);
      if (!f.valid) {
        // A point behind the camera costs as much as the worst that the loss lets pass: else
        // turning away would look like an improvement.
        sum.cost += Huber(kBehindSigmas * kBehindSigmas, huber).cost;
        continue;
      }
      Add(f, huber, sum);
    }
  }

  static Linearised<4> WhitenedPlane(const PlaneConstraint& c, const Pose& T_cw) {
    if (!Sane(c)) return {};
    Linearised<4> f = PlaneFactor(c, T_cw);
    f.r.head<3>() /= c.angle_sigma_rad;
    f.J.topRows<3>() /= c.angle_sigma_rad;
    f.r[3] /= c.offset_sigma_m;
    f.J.row(3) /= c.offset_sigma_m;
    return f;
  }

  void AddPlanes(const Pose& T_cw, NormalEquations& sum) const {
    for (const PlaneConstraint& c : problem_.planes) {
      const Linearised<4> f = WhitenedPlane(c, T_cw);
      if (f.valid) Add(Whitened(f, 1 / plane_sigmas), config_.huber_planes, sum);
    }
  }

  void AddBoxes(const Pose& T_cw, NormalEquations& sum) const {
    for (const BoxConstraint& c : problem_.boxes) {
      if (!Sane(c)) continue;
      const Linearised<4> f = BoxFactor(c, T_cw, camera_);
      if (f.valid) Add(Whitened(f, 1 / c.sigma_px), config_.huber_planes, sum);
    }
  }

  /// All that planes of the frame say of where they are seen from.
  void AddSeenPlanes(const Pose& T_cw, NormalEquations& sum) const {
    if (config_.use_planes) AddPlanes(T_cw, sum);             // eq15, eq16
    if (config_.use_point_planes) AddPointPlanes(T_cw, sum);  // eq18
    if (config_.use_vertices) AddVertices(T_cw, sum);
    AddParallels(T_cw, sum);       // eq19
    AddPerpendiculars(T_cw, sum);  // eq20
    AddRotations(T_cw, sum);
  }

  void AddPointPlanes(const Pose& T_cw, NormalEquations& sum) const {
    for (const PointPlaneConstraint& c : problem_.point_planes) {
      if (!Sane(c)) continue;
      Add(Whitened(PointPlaneFactor(c, T_cw), 1 / c.sigma_m), config_.huber_planes, sum);
    }
  }

  void AddVertices(const Pose& T_cw, NormalEquations& sum) const {
    for (const VertexConstraint& c : problem_.vertices) {
      if (Sane(c)) Add(VertexFactor(c, T_cw), config_.huber_planes, sum);
    }
  }

  void AddParallels(const Pose& T_cw, NormalEquations& sum) const {
    for (const DirectionConstraint& c : problem_.parallels) {
      if (!Sane(c)) continue;
      const Linearised<3> f = ParallelFactor(c, T_cw);
      if (f.valid) Add(Whitened(f, 1 / c.sigma_rad), config_.huber_planes, sum);
    }
  }

  void AddPerpendiculars(const Pose& T_cw, NormalEquations& sum) const {
    for (const DirectionConstraint& c : problem_.perpendiculars) {
      if (!Sane(c)) continue;
      const Linearised<1> f = PerpendicularFactor(c, T_cw);
      if (f.valid) Add(Whitened(f, 1 / c.sigma_rad), config_.huber_planes, sum);
    }
  }

  void AddRotations(const Pose& T_cw, NormalEquations& sum) const {
    for (const RotationConstraint& c : problem_.rotations) {
      if (!Sane(c)) continue;
      const Linearised<3> f = RotationFactor(c, T_cw);
      if (f.valid) Add(f, config_.huber_planes, sum);
    }
  }

  static constexpr double kBehindSigmas = 100.0;  // far beyond any gate

  const PoseProblem& problem_;
  const Camera& camera_;
  const PoseProblemConfig& config_;
  std::vector<bool> sane_;
  Matrix6d prior_information_ = Matrix6d::Zero();
  Pose T_wc_prior_;
};

bool FinitePose(const Pose& T) { return T.R.allFinite() && T.t.allFinite(); }

}  // namespace

PoseSummary OptimisePose(const PoseProblem& problem, const Camera& camera,
                         const PoseProblemConfig& config) {
  PoseSummary out;
  out.T_cw = problem.T_cw;
  out.point_inliers.assign(problem.points.size(), false);
  if (!FinitePose(problem.T_cw)) return out;

  Evaluator evaluate(problem, camera, config);
  // Optimise, classify the points, and again without the outliers; the last round is plain.
  for (int round = 0; round < config.rounds; ++round) {
    evaluate.robust_points = config.rounds == 1 || round + 1 < config.rounds;
    const SolveSummary solved = SolvePose(out.T_cw, config.iterations, evaluate);
    if (!solved.finite || !FinitePose(solved.T_cw)) return out;
    out.T_cw = solved.T_cw;
    out.inlier_count = evaluate.Classify(out.T_cw);
  }
  // What the solution is worth. Planes that disagree with each other or with the points by more than
  // they say are worth less than they say.
  evaluate.plane_sigmas = evaluate.PlaneDisagreement(out.T_cw);
  out.evidence.of_pose = evaluate.AtItsTime(out.T_cw).H.selfadjointView<Eigen::Upper>();
  if (problem.late) {
    const NormalEquations seen = evaluate.Late(out.T_cw);
    out.evidence.of_late_pose = seen.H.selfadjointView<Eigen::Upper>();
    out.evidence.late_s = problem.late->late_s;
    out.evidence.speed = problem.late->SpeedAt(out.T_cw, seen);
  }
  const NormalEquations last = evaluate(out.T_cw);
  const Matrix6d H = last.H.selfadjointView<Eigen::Upper>();
  out.point_inliers = evaluate.used;
  out.nullity = Nullity(H);
  out.usable = out.nullity == 0 && std::isfinite(last.cost);
  if (out.usable) out.covariance = H.ldlt().solve(Matrix6d::Identity());
  return out;
}

}  // namespace slam
