#include "slam/calibrate/warp_estimate.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <numeric>

namespace slam {
namespace {

constexpr double kModesShare = 0.99;    // of the expected power; the rest stays in sigma
constexpr std::size_t kMaxModes = 256;  // bounds the time of an epoch to some 20 ms

/// Matern's correlation of order 3/2: once differentiable, as a bend is.
double Correlation(double distance, double reach) {
  const double s = std::sqrt(3.0) * distance / reach;
  return (1 + s) * std::exp(-s);
}

/// Eigenvectors of the correlation between `count` cells in a line, as columns, each with the
/// square root of its eigenvalue as its length.
Eigen::MatrixXd ModesOfLine(int count, double spacing, double reach) {
  Eigen::MatrixXd correlation(count, count);
  for (int i = 0; i < count; ++i)
    for (int j = 0; j < count; ++j)
      correlation(i, j) = Correlation(spacing * std::abs(i - j), reach);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(correlation);
  return solver.eigenvectors() * solver.eigenvalues().cwiseMax(0.0).cwiseSqrt().asDiagonal();
}

/// The strongest modes of a field of unit variance over the cells: products of modes along x
/// and y.
Eigen::MatrixXd ModesOfField(const WarpCells& cells, const Camera& camera,
                             const DepthWarpConfig& config) {
  const double step_x = kStatedFocal_px / camera.fx * cells.width / cells.cols;
  const double step_y = kStatedFocal_px / camera.fy * cells.height / cells.rows;
  const Eigen::MatrixXd along_x = ModesOfLine(cells.cols, step_x, config.reach_x_px);
  const Eigen::MatrixXd along_y = ModesOfLine(cells.rows, step_y, config.reach_y_px);
  const auto power = [&](int mode) {
    return along_x.col(mode % cells.cols).squaredNorm() *
           along_y.col(mode / cells.cols).squaredNorm();
  };
  std::vector<int> order(static_cast<std::size_t>(cells.count()));
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return power(a) > power(b); });

  // As many as hold the share of the power.
  std::size_t kept = 0;
  for (double sum = 0;
       kept < order.size() && kept < kMaxModes && sum < kModesShare * cells.count(); ++kept) {
    sum += power(order[kept]);
  }
  Eigen::MatrixXd modes(cells.count(), static_cast<Eigen::Index>(kept));
  for (std::size_t k = 0; k < kept; ++k) {
    const int x = order[k] % cells.cols, y = order[k] / cells.cols;
    for (int cell = 0; cell < cells.count(); ++cell) {
      modes(cell, static_cast<Eigen::Index>(k)) =
          along_x(cell % cells.cols, x) * along_y(cell / cells.cols, y);
    }
  }
  return modes;
}

}  // namespace

WarpEstimate::WarpEstimate(const WarpCells& cells, const Camera& camera,
                           const DepthWarpConfig& config, BendLaw law)
    : law_(law),
      drift_rms_(config.bend_rms * std::sqrt(config.drift_share)),
      drift_(config.drift_share / (1 - config.drift_share)) {
  const double variance = config.bend_rms * config.bend_rms * (1 - config.drift_share);
  modes_ = std::sqrt(variance) * ModesOfField(cells, camera, config);
  beyond_ = (variance - modes_.rowwise().squaredNorm().array()).cwiseMax(0.0);
  information_ = Eigen::MatrixXd::Zero(modes_.cols(), modes_.cols());
  information_vector_ = Eigen::VectorXd::Zero(modes_.cols());
  weight_ = weighted_ = Eigen::VectorXd::Zero(modes_.rows());
  Solve();
}

void WarpEstimate::Add(const SurfaceView& view) {
  // The view's plane through what was measured, and each cell's residual from it: r = p g + noise.
  PlaneSums sums;
  for (const CellMean& cell : view.cells) {
    const double sigma = cell.sigma * cell.q;
    sums.Add(cell.x, cell.y, cell.q, 1 / (sigma * sigma));
  }
  const std::optional<PlaneFit> fit = Fit(sums);
  if (!fit) return;
  // A change of the plane moves r by the ray over q; it is eliminated by N^-1 = (L L^T)^-1.
  Eigen::Matrix3d N = Eigen::Matrix3d::Zero();
  Eigen::MatrixXd U = Eigen::MatrixXd::Zero(3, modes_.cols());
  for (const CellMean& cell : view.cells) {
    const double w = 1 / (cell.sigma * cell.sigma);
    const double r = fit->plane.InverseDepth(cell.x, cell.y) / cell.q - 1;
    const double g = BendGrowth(law_, 1 / cell.q);
    const Eigen::Vector3d ray = Eigen::Vector3d(cell.x, cell.y, 1) / cell.q;
    N += w * ray * ray.transpose();
    U += w * g * ray * modes_.row(cell.cell);
    weight_[cell.cell] += w * g * g;
    weighted_[cell.cell] += w * g * r;
    squares_ += w * r * r;
  }
  const Eigen::MatrixXd away = N.llt().matrixL().solve(U);
  for (Eigen::Index k = 0; k < away.rows(); ++k) eliminated_.push_back(away.row(k));
}

double WarpEstimate::CloseEpoch() {
  // The epoch's information on p + d, in modes.
  const Eigen::Index count = modes_.cols();
  Eigen::MatrixXd taken(static_cast<Eigen::Index>(eliminated_.size()), count);
  for (std::size_t k = 0; k < eliminated_.size(); ++k) {
    taken.row(static_cast<Eigen::Index>(k)) = eliminated_[k];
  }
  const Eigen::MatrixXd weighed = weight_.cwiseSqrt().asDiagonal() * modes_;
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(count, count);
  H.selfadjointView<Eigen::Lower>().rankUpdate(weighed.transpose());
  H.selfadjointView<Eigen::Lower>().rankUpdate(taken.transpose(), -1.0);
  H.triangularView<Eigen::StrictlyUpper>() = H.transpose();
  const Eigen::VectorXd b = modes_.transpose() * weighted_;

  // What the epochs before foretold of this one.
  const double gain = 2 * b.dot(coefficients_) - coefficients_.dot(H * coefficients_);
  const double share = squares_ > 0 ? gain / squares_ : 0.0;

  // Its information on p alone: (H^-1 + drift)^-1.
  const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(count, count);
  const Eigen::LLT<Eigen::MatrixXd> drifting(identity + drift_ * H);
  information_ += drifting.solve(H);
  information_vector_ += drifting.solve(b);
  ++epochs_;
  Solve();
  weight_.setZero(), weighted_.setZero(), eliminated_.clear();
  squares_ = 0.0;
  return share;
}

void WarpEstimate::Solve() {
  const Eigen::Index count = modes_.cols();
  const Eigen::LLT<Eigen::MatrixXd> posterior(information_ +
                                              Eigen::MatrixXd::Identity(count, count));
  coefficients_ = posterior.solve(information_vector_);
  pattern_ = modes_ * coefficients_;
  const Eigen::MatrixXd spread = posterior.matrixL().solve(modes_.transpose());
  sigma_ = (spread.colwise().squaredNorm().transpose() + beyond_).cwiseSqrt();
}

Eigen::VectorXd WithoutLinearPart(const WarpCells& cells, const Eigen::VectorXd& pattern) {
  Eigen::MatrixX3d linear(cells.count(), 3);
  for (int cell = 0; cell < cells.count(); ++cell) {
    linear.row(cell) << cells.CentreU(cell % cells.cols), cells.CentreV(cell / cells.cols), 1;
  }
  return pattern - linear * linear.colPivHouseholderQr().solve(pattern);
}

}  // namespace slam
