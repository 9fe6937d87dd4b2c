#include "slam/places/pose_graph.h"

#include <ceres/ceres.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "slam/base/require.h"
#include "slam/mapping/bundle/bundle_terms.h"

namespace slam {
namespace {

constexpr double kSigma_m = 0.01, kSigma_rad = 0.01;  // a radian weighs as much as a metre
constexpr int kMaxIterations = 50;                    // bounds the work
constexpr double kFunctionTolerance = 1e-12;  // steps are cheap, and what follows starts here
constexpr double kDifferenceStep = 1e-6;      // metres, radians: rounding and curvature alike

/// Residual of an edge, whitened, by the two poses; derivatives by central differences.
class EdgeTerm : public ceres::SizedCostFunction<6, 7, 7> {
 public:
  explicit EdgeTerm(const PoseEdge& edge) : T_ji_(Inverse(edge.T_ij)) {}

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override {
    const Pose T_iw = PoseOf(parameters[0]), T_jw = PoseOf(parameters[1]);
    Eigen::Map<Vector6d>{residuals} = Residual(T_iw, T_jw);
    if (!jacobians) return true;
    for (int which = 0; which < 2; ++which) {
      if (!jacobians[which]) continue;
      Eigen::Map<Eigen::Matrix<double, 6, 7, Eigen::RowMajor>> J(jacobians[which]);
      J.setZero();
      for (int c = 0; c < 6; ++c) {
        Vector6d xi = Vector6d::Zero();
        xi[c] = kDifferenceStep;
        const Pose plus = Exp(xi), minus = Exp(-xi);
        const Vector6d forth =
            which == 0 ? Residual(plus * T_iw, T_jw) : Residual(T_iw, plus * T_jw);
        const Vector6d back =
            which == 0 ? Residual(minus * T_iw, T_jw) : Residual(T_iw, minus * T_jw);
        J.col(c) = (forth - back) / (2 * kDifferenceStep);
      }
    }
    return true;
  }

 private:
  Vector6d Residual(const Pose& T_iw, const Pose& T_jw) const {
    Vector6d r = Log(T_ji_ * T_iw * Inverse(T_jw));
    r.head<3>() *= 1.0 / kSigma_m;
    r.tail<3>() *= 1.0 / kSigma_rad;
    return r;
  }

  Pose T_ji_;
};

}  // namespace

bool OptimisePoseGraph(std::vector<Pose>& poses, const std::vector<PoseEdge>& edges) {
  const int count = static_cast<int>(poses.size());
  for (const PoseEdge& edge : edges) {
    Require(edge.i >= 0 && edge.j >= 0 && edge.i < count && edge.j < count && edge.i != edge.j,
            "OptimisePoseGraph: an edge names no two poses");
  }
  if (edges.empty()) return true;
  // A block a pose, of which the first is held; a term an edge.
  std::vector<PoseBlock> blocks;
  blocks.reserve(poses.size());
  for (const Pose& T_iw : poses) blocks.push_back(BlockOf(T_iw));
  ceres::Problem::Options ownership;
  ownership.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ownership.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::Problem problem(ownership);
  PoseManifold manifold;
  for (PoseBlock& block : blocks) problem.AddParameterBlock(block.data(), 7, &manifold);
  problem.SetParameterBlockConstant(blocks.front().data());
  std::vector<std::unique_ptr<EdgeTerm>> terms;
  for (const PoseEdge& edge : edges) {
    terms.push_back(std::make_unique<EdgeTerm>(edge));
    problem.AddResidualBlock(terms.back().get(), nullptr,
                             blocks[static_cast<std::size_t>(edge.i)].data(),
                             blocks[static_cast<std::size_t>(edge.j)].data());
  }
  // Solve, and take the poses over when they are numbers.
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  options.num_threads = 1;
  options.max_num_iterations = kMaxIterations;
  options.function_tolerance = kFunctionTolerance;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  const bool finite = std::all_of(blocks.begin(), blocks.end(), [](const PoseBlock& block) {
    return std::all_of(block.begin(), block.end(), [](double x) { return std::isfinite(x); });
  });
  if (!summary.IsSolutionUsable() || !finite) return false;
  for (std::size_t i = 1; i < poses.size(); ++i) poses[i] = PoseOf(blocks[i].data());
  return true;
}

}  // namespace slam
