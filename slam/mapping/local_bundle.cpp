#include "slam/mapping/local_bundle.h"

#include <ceres/ceres.h>

#include <algorithm>
#include <cmath>

#include "slam/base/chi_square.h"
#include "slam/mapping/bundle_window.h"

namespace slam {
namespace {

/// Ceres on one window.
class Solver {
 public:
  Solver(BundleWindow& window, const LocalBundleConfig& config)
      : window_(window), config_(config) {}

  ceres::Solver::Summary Solve(bool robust, int iterations) {
    ceres::Problem::Options ownership;
    ownership.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    ownership.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    ownership.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    ceres::Problem problem(ownership);
    ceres::HuberLoss stereo(std::sqrt(kChi2Of3At95)), mono(std::sqrt(kChi2Of2At95));
    // Poses, the fixed ones constant.
    PoseManifold manifold;
    for (std::size_t i = 0; i < window_.poses.size(); ++i) {
      problem.AddParameterBlock(window_.poses[i].data(), 7, &manifold);
      if (i >= window_.free_count) problem.SetParameterBlockConstant(window_.poses[i].data());
    }
    // Points are eliminated first: the Schur complement leaves the poses.
    ceres::ParameterBlockOrdering* order = new ceres::ParameterBlockOrdering;
    for (auto& position : window_.positions) {
      problem.AddParameterBlock(position.data(), 3);
      order->AddElementToGroup(position.data(), 0);
    }
    for (PoseBlock& pose : window_.poses) order->AddElementToGroup(pose.data(), 1);
    // Observations that are not outliers.
    for (const BundleWindow::Observation& o : window_.observations) {
      if (!o.inlier) continue;
      ceres::LossFunction* loss = o.stereo ? &stereo : &mono;
      problem.AddResidualBlock(o.term.get(), robust ? loss : nullptr,
                               window_.poses[o.pose_at].data(),
                               window_.positions[o.position_at].data());
    }
    ceres::Solver::Options options;
    constexpr std::size_t kMaxDense = 50;  // poses; with more, most pairs share no point
    options.linear_solver_type =
        window_.free_count > kMaxDense ? ceres::SPARSE_SCHUR : ceres::DENSE_SCHUR;
    options.linear_solver_ordering.reset(order);
    options.num_threads = 1;
    options.max_num_iterations = iterations;
    options.logging_type = ceres::SILENT;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem, &summary);
    return summary;
  }

  /// Observations of points behind their camera have no derivative to follow.
  void LeaveOutThoseBehind() {
    for (BundleWindow::Observation& o : window_.observations) {
      o.inlier = Residual(o).x() < BundleTerm::kBehind;
    }
  }

  /// Observations beyond the chi-square of their kind are no inliers any more.
  void Classify() {
    for (BundleWindow::Observation& o : window_.observations) {
      const double gate = o.stereo ? kChi2Of3At95 : kChi2Of2At95;
      o.inlier = Residual(o).squaredNorm() <= gate;
    }
  }

 private:
  Eigen::Vector3d Residual(const BundleWindow::Observation& o) const {
    const double* blocks[] = {window_.poses[o.pose_at].data(),
                              window_.positions[o.position_at].data()};
    Eigen::Vector3d residual;
    o.term->Evaluate(blocks, residual.data(), nullptr);
    return residual;
  }

  BundleWindow& window_;
  const LocalBundleConfig& config_;
};

bool AllFinite(const BundleWindow& window) {
  const auto finite = [](const auto& block) {
    return std::all_of(block.begin(), block.end(), [](double x) { return std::isfinite(x); });
  };
  return std::all_of(window.poses.begin(), window.poses.end(), finite) &&
         std::all_of(window.positions.begin(), window.positions.end(), finite);
}

}  // namespace

LocalBundleReport SolveWindow(BundleWindow& window, const LocalBundleConfig& config) {
  LocalBundleReport report;
  report.keyframes = static_cast<int>(window.free_count);
  report.fixed_keyframes = static_cast<int>(window.keyframes.size() - window.free_count);
  if (window.free_count == 0 || window.observations.empty()) return report;

  Solver solver(window, config);
  solver.LeaveOutThoseBehind();
  const ceres::Solver::Summary first = solver.Solve(true, config.first_iterations);
  solver.Classify();
  const ceres::Solver::Summary last = solver.Solve(false, config.last_iterations);
  solver.Classify();
  report.initial_cost = first.initial_cost;
  report.usable = first.IsSolutionUsable() && last.IsSolutionUsable() && AllFinite(window);
  if (!report.usable) return report;
  report.outliers = static_cast<int>(
      std::count_if(window.observations.begin(), window.observations.end(),
                    [](const BundleWindow::Observation& o) { return !o.inlier; }));
  return report;
}

LocalBundleReport AdjustLocalBundle(Map& map, int keyframe, const Camera& camera,
                                    const FeatureScale& scale, const LocalBundleConfig& config,
                                    const MapTurn& turn) {
  BundleWindow window;
  turn([&] { window = LocalWindow(map, keyframe, camera, scale, config); });
  const LocalBundleReport report = SolveWindow(window, config);
  if (report.usable) turn([&] { MergeWindow(window, scale, map); });
  return report;
}

}  // namespace slam
