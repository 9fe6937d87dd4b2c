#include "slam/mapping/bundle/local_bundle.h"

#include <ceres/ceres.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "slam/base/chi_square.h"
#include "slam/mapping/bundle/bundle_window.h"
#include "slam/mapping/bundle/coplanar_points.h"

namespace slam {
namespace {

/// Ceres on one window.
class Solver {
 public:
  explicit Solver(BundleWindow& window) : window_(window) {}

  ceres::Solver::Summary Solve(bool robust, int iterations) {
    ceres::Problem::Options ownership;
    ownership.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    ownership.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    ownership.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    ceres::Problem problem(ownership);
    // Points are eliminated first: the Schur complement leaves the poses, and the planes, which
    // are few.
    ceres::Solver::Options options;
    options.linear_solver_ordering = std::make_shared<ceres::ParameterBlockOrdering>();
    AddUnknowns(problem, *options.linear_solver_ordering);
    AddPointTerms(problem, robust);
    AddPlaneTerms(problem, robust);
    AddCornerTerms(problem, robust);
    constexpr std::size_t kMaxDense = 50;  // poses; with more, most pairs share no point
    options.linear_solver_type =
        window_.free_count > kMaxDense ? ceres::SPARSE_SCHUR : ceres::DENSE_SCHUR;
    options.num_threads = 1;
    options.max_num_iterations = iterations;
    options.logging_type = ceres::SILENT;
    ceres::Solver::Summary summary;
    PlaceInPlanes(window_);
    ceres::Solve(options, &problem, &summary);
    PlaceInWorld(window_);
    return summary;
  }

  /// Observations of points behind their camera, and of planes face to face with what was seen,
  /// have no derivative to follow.
  void LeaveOutThoseBehind() {
    for (auto& o : window_.observations) o.inlier = Residual(o).x() < BundleTerm::kBehind;
    for (auto& o : window_.plane_observations) {
      o.inlier = Residual(o).x() < PlaneTerm::kRefused;
    }
  }

  /// Observations beyond the chi-square of their kind are no inliers any more.
  void Classify() {
    for (auto& o : window_.observations) {
      const double gate = o.stereo ? kChi2Of3At95 : kChi2Of2At95;
      o.inlier = Residual(o).squaredNorm() <= gate;
    }
    // Planes are few, and have passed association by this bound already.
    for (auto& o : window_.plane_observations) {
      o.inlier = Residual(o).squaredNorm() <= kChi2Of3At999;
    }
    for (auto& o : window_.points_on_planes) {
      o.inlier = Residual(o).squaredNorm() <= kChi2Of1At95;
    }
    for (auto& o : window_.corner_observations) {
      o.inlier = Residual(o).squaredNorm() <= kChi2Of2At999;
    }
  }

 private:
  /// Poses, the fixed ones constant, points and planes.
  void AddUnknowns(ceres::Problem& problem, ceres::ParameterBlockOrdering& order) {
    for (std::size_t i = 0; i < window_.poses.size(); ++i) {
      problem.AddParameterBlock(window_.poses[i].data(), 7, &pose_manifold_);
      if (i >= window_.free_count) problem.SetParameterBlockConstant(window_.poses[i].data());
      order.AddElementToGroup(window_.poses[i].data(), 1);
    }
    for (std::size_t i = 0; i < window_.positions.size(); ++i) {
      double* position = window_.positions[i].data();
      problem.AddParameterBlock(position, window_.IsHeld(i) ? 2 : 3);
      order.AddElementToGroup(position, 0);
    }
    for (PlaneBlock& plane : window_.plane_blocks) {
      problem.AddParameterBlock(plane.data(), 4, &plane_manifold_);
      order.AddElementToGroup(plane.data(), 2);  // never sorted with poses by address
    }
    for (InPlaneBlock& corner : window_.corner_blocks) {
      problem.AddParameterBlock(corner.data(), 2);
      order.AddElementToGroup(corner.data(), 3);
    }
  }

  void AddPointTerms(ceres::Problem& problem, bool robust) {
    for (const BundleWindow::Observation& o : window_.observations) {
      if (!o.inlier) continue;
      ceres::LossFunction* loss = !robust ? nullptr : o.stereo ? &three_ : &two_;
      double* pose = window_.poses[o.pose_at].data();
      double* position = window_.positions[o.position_at].data();
      if (window_.IsHeld(o.position_at)) {
        double* plane =
            window_.plane_blocks[window_.coplanar.at(o.position_at).plane_at].data();
        problem.AddResidualBlock(o.in_plane.get(), loss, pose, plane, position);
      } else {
        problem.AddResidualBlock(o.term.get(), loss, pose, position);
      }
    }
  }

  void AddCornerTerms(ceres::Problem& problem, bool robust) {
    for (const BundleWindow::CornerObservation& o : window_.corner_observations) {
      if (!o.inlier) continue;
      problem.AddResidualBlock(
          o.in_plane.get(), robust ? &two_ : nullptr, window_.poses[o.pose_at].data(),
          window_.plane_blocks[window_.corners[o.corner_at].plane_at].data(),
          window_.corner_blocks[o.corner_at].data());
    }
  }

  void AddPlaneTerms(ceres::Problem& problem, bool robust) {
    for (const BundleWindow::PlaneObservation& o : window_.plane_observations) {
      if (!o.inlier) continue;
      problem.AddResidualBlock(o.term.get(), robust ? &three_ : nullptr,
                               window_.poses[o.pose_at].data(),
                               window_.plane_blocks[o.plane_at].data());
    }
    for (std::size_t i = 0; i < window_.stays.size(); ++i) {
      problem.AddResidualBlock(window_.stays[i].get(), nullptr, window_.poses[i].data());
    }
    for (std::size_t i = 0; i < window_.planes.size(); ++i) {
      PlanePriorTerm* prior = window_.planes[i].prior.get();
      if (prior != nullptr)
        problem.AddResidualBlock(prior, nullptr, window_.plane_blocks[i].data());
    }
    for (const BundleWindow::PointOnPlane& o : window_.points_on_planes) {
      if (!o.inlier) continue;
      problem.AddResidualBlock(o.term.get(), robust ? &one_ : nullptr,
                               window_.positions[o.position_at].data(),
                               window_.plane_blocks[o.plane_at].data());
    }
  }

  Eigen::Vector3d Residual(const BundleWindow::Observation& o) const {
    return Evaluated<3>(*o.term, window_.poses[o.pose_at].data(),
                        window_.positions[o.position_at].data());
  }
  Eigen::Vector4d Residual(const BundleWindow::PlaneObservation& o) const {
    return Evaluated<4>(*o.term, window_.poses[o.pose_at].data(),
                        window_.plane_blocks[o.plane_at].data());
  }
  Eigen::Matrix<double, 1, 1> Residual(const BundleWindow::PointOnPlane& o) const {
    return Evaluated<1>(*o.term, window_.positions[o.position_at].data(),
                        window_.plane_blocks[o.plane_at].data());
  }
  Eigen::Vector2d Residual(const BundleWindow::CornerObservation& o) const {
    const BundleWindow::Corner& corner = window_.corners[o.corner_at];
    const InPlanePoint place =
        PointOf(corner.axes, window_.plane_blocks[corner.plane_at].data(),
                window_.corner_blocks[o.corner_at].data());
    return Evaluated<2>(*o.term, window_.poses[o.pose_at].data(), place.p_w.data());
  }
  template <int kRows>
  static Eigen::Matrix<double, kRows, 1> Evaluated(const ceres::CostFunction& term,
                                                   const double* one, const double* other) {
    const double* blocks[] = {one, other};
    Eigen::Matrix<double, kRows, 1> residual;
    term.Evaluate(blocks, residual.data(), nullptr);
    return residual;
  }

  BundleWindow& window_;
  PoseManifold pose_manifold_;
  PlaneManifold plane_manifold_;
  // By degrees of freedom.
  ceres::HuberLoss one_{std::sqrt(kChi2Of1At95)}, two_{std::sqrt(kChi2Of2At95)},
      three_{std::sqrt(kChi2Of3At95)};
};

bool AllFinite(const BundleWindow& window) {
  const auto finite = [](const auto& block) {
    return std::all_of(block.begin(), block.end(), [](double x) { return std::isfinite(x); });
  };
  return std::all_of(window.poses.begin(), window.poses.end(), finite) &&
         std::all_of(window.positions.begin(), window.positions.end(), finite) &&
         std::all_of(window.plane_blocks.begin(), window.plane_blocks.end(), finite) &&
         std::all_of(window.corner_blocks.begin(), window.corner_blocks.end(), finite);
}

}  // namespace

LocalBundleReport SolveWindow(BundleWindow& window, const LocalBundleConfig& config) {
  LocalBundleReport report;
  report.keyframes = static_cast<int>(window.free_count);
  report.fixed_keyframes = static_cast<int>(window.keyframes.size() - window.free_count);
  report.planes =
      static_cast<int>(std::count_if(window.planes.begin(), window.planes.end(),
                                     [](const WindowPlane& plane) { return !plane.supposed; }));
  if (window.free_count == 0) return report;
  if (window.observations.empty() && window.plane_observations.empty()) return report;

  Solver solver(window);
  solver.LeaveOutThoseBehind();
  const ceres::Solver::Summary first = solver.Solve(true, config.first_iterations);
  LetGoOfThoseOff(config.point_plane_sigma_m, window);
  solver.Classify();
  const ceres::Solver::Summary last = solver.Solve(false, config.last_iterations);
  solver.Classify();
  report.initial_cost = first.initial_cost;
  report.usable = first.IsSolutionUsable() && last.IsSolutionUsable() && AllFinite(window);
  if (!report.usable) return report;
  report.outliers = static_cast<int>(
      std::count_if(window.observations.begin(), window.observations.end(),
                    [](const BundleWindow::Observation& o) { return !o.inlier; }));
  report.plane_outliers = static_cast<int>(
      std::count_if(window.plane_observations.begin(), window.plane_observations.end(),
                    [&](const BundleWindow::PlaneObservation& o) {
                      return !o.inlier && !window.planes[o.plane_at].supposed;
                    }));
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
