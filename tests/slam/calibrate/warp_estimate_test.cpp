#include "slam/calibrate/warp_estimate.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <random>
#include <vector>

namespace slam {
namespace {

/// Few cells, over which the prior is so smooth that hardly any of it lies beyond its modes.
Camera FewCells() {
  Camera camera;
  camera.width = 160, camera.height = 120;
  camera.fx = camera.fy = 525.0, camera.cx = 79.5, camera.cy = 59.5;
  return camera;
}

DepthWarpConfig Smooth() {
  DepthWarpConfig config;
  config.reach_x_px = 60.0, config.reach_y_px = 120.0;
  return config;
}

/// The inverse depth of a board seen at a slant: it changes threefold over the view.
double SlantedQ(double x, double y, int view) {
  const double turn = 2.0 * view;
  return 1.0 + 3.3 * (std::cos(turn) * x + std::sin(turn) * y);
}

/// The same posterior without modes and in covariance form: p and the planes of all views are one
/// Gaussian vector, of which the views measure p_i - ray_i . plane / q_i.
struct Dense {
  Eigen::MatrixXd covariance;
  Eigen::VectorXd mean;
};

Eigen::MatrixXd PriorCovariance(const WarpCells& cells, const DepthWarpConfig& config) {
  const auto matern = [](double distance, double reach) {
    const double s = std::sqrt(3.0) * distance / reach;
    return (1 + s) * std::exp(-s);
  };
  Eigen::MatrixXd prior(cells.count(), cells.count());
  for (int i = 0; i < cells.count(); ++i) {
    for (int j = 0; j < cells.count(); ++j) {
      const double du = cells.CentreU(i % cells.cols) - cells.CentreU(j % cells.cols);
      const double dv = cells.CentreV(i / cells.cols) - cells.CentreV(j / cells.cols);
      prior(i, j) = config.bend_rms * config.bend_rms * (1 - config.drift_share) *
                    matern(std::abs(du), config.reach_x_px) *
                    matern(std::abs(dv), config.reach_y_px);
    }
  }
  return prior;
}

Dense Solve(const std::vector<SurfaceView>& views, const WarpCells& cells,
            const DepthWarpConfig& config) {
  const Eigen::Index n = cells.count(), planes = 3 * static_cast<Eigen::Index>(views.size());
  Eigen::Index rows = 0;
  for (const SurfaceView& view : views) rows += static_cast<Eigen::Index>(view.cells.size());
  // Each epoch, here one for all views, shows the fixed pattern and a drift of the same smoothness.
  const Eigen::MatrixXd fixed = PriorCovariance(cells, config);
  const double drift = config.drift_share / (1 - config.drift_share);
  constexpr double kAnyPlane = 10.0;
  Eigen::MatrixXd prior = Eigen::MatrixXd::Zero(n + planes, n + planes);
  prior.topLeftCorner(n, n) = (1 + drift) * fixed;
  prior.bottomRightCorner(planes, planes).diagonal().setConstant(kAnyPlane * kAnyPlane);
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(rows, n + planes);
  Eigen::VectorXd r(rows), noise2(rows);
  Eigen::Index row = 0;
  for (std::size_t k = 0; k < views.size(); ++k) {
    for (const CellMean& cell : views[k].cells) {
      A(row, cell.cell) = 1.0;
      A.block<1, 3>(row, n + 3 * static_cast<Eigen::Index>(k)) =
          Eigen::RowVector3d(cell.x, cell.y, 1.0) / cell.q;
      r[row] = SlantedQ(cell.x, cell.y, static_cast<int>(k)) / cell.q - 1.0;
      noise2[row++] = cell.sigma * cell.sigma;
    }
  }
  const Eigen::MatrixXd seen = A * prior * A.transpose() + Eigen::MatrixXd(noise2.asDiagonal());
  const Eigen::MatrixXd cross = fixed * A.leftCols(n).transpose();
  const Eigen::MatrixXd gain = seen.ldlt().solve(cross.transpose()).transpose();
  return {fixed - gain * cross.transpose(), gain * r};
}

// Where all depths are the same the two laws differ by a factor alone: that by which p is stated.
TEST(WarpEstimate, ByDisparityIsThatByDepthWhereAllIsAtOneDistance) {
  const Camera camera = FewCells();
  const WarpCells cells = CellsOf(camera);
  constexpr double kDepth_m = 0.25 * kBendDistance_m, kGrowth = 0.25;
  DepthWarpConfig by_disparity = Smooth(), by_depth = by_disparity;
  by_depth.bend_rms = kGrowth * by_disparity.bend_rms;
  WarpEstimate disparity(cells, camera, by_disparity, BendLaw::kDisparity);
  WarpEstimate depth(cells, camera, by_depth, BendLaw::kDepth);
  std::mt19937 random(9);
  std::normal_distribution<double> normal(0.0, 0.001);
  for (int epoch = 0; epoch < 2; ++epoch) {
    SurfaceView view;
    for (int cell = 0; cell < cells.count(); ++cell) {
      const double x = (cells.CentreU(cell % cells.cols) - camera.cx) / camera.fx;
      const double y = (cells.CentreV(cell / cells.cols) - camera.cy) / camera.fy;
      // Seen at one distance to a part in a thousand.
      view.cells.push_back({cell, x, y, (1 + normal(random)) / kDepth_m, 0.0005});
    }
    disparity.Add(view), depth.Add(view);
    EXPECT_NEAR(disparity.CloseEpoch(), depth.CloseEpoch(), 0.01);
  }
  // What is linear in the pixel no view tells, and it is not applied.
  const Eigen::VectorXd expected = WithoutLinearPart(cells, depth.pattern());
  const Eigen::VectorXd found = WithoutLinearPart(cells, disparity.pattern());
  ASSERT_GT(expected.norm(), 0.0);
  EXPECT_LT((kGrowth * found - expected).norm(), 0.01 * expected.norm());
  EXPECT_LT((kGrowth * disparity.sigma() - depth.sigma()).norm(), 0.01 * depth.sigma().norm());
}

// What a plane explains must not be taken for seen.
TEST(WarpEstimate, IsTheLeastSquaresEstimateOfAPatternAndOfAPlaneForEachView) {
  const Camera camera = FewCells();
  const WarpCells cells = CellsOf(camera);
  const DepthWarpConfig config = Smooth();
  std::mt19937 random(4);
  std::normal_distribution<double> normal;
  const Eigen::VectorXd truth =
      Eigen::LLT<Eigen::MatrixXd>(PriorCovariance(cells, config)).matrixL() *
      Eigen::VectorXd::NullaryExpr(cells.count(), [&] { return normal(random); });

  std::vector<SurfaceView> views(3);
  WarpEstimate estimate(cells, camera, config, BendLaw::kDepth);
  for (int k = 0; k < 3; ++k) {
    for (int cell = 0; cell < cells.count(); ++cell) {
      if ((cell + k) % 4 == 0) continue;  // hidden by something
      const double x = (cells.CentreU(cell % cells.cols) - camera.cx) / camera.fx;
      const double y = (cells.CentreV(cell / cells.cols) - camera.cy) / camera.fy;
      const double sigma = 0.003 * (1 + cell % 3);
      const double p = truth[cell] + sigma * normal(random);
      views[static_cast<std::size_t>(k)].cells.push_back(
          {cell, x, y, SlantedQ(x, y, k) / (1 + p), sigma});
    }
    estimate.Add(views[static_cast<std::size_t>(k)]);
  }
  estimate.CloseEpoch();

  const Dense dense = Solve(views, cells, config);
  const Eigen::VectorXd sigma = dense.covariance.diagonal().cwiseSqrt();
  EXPECT_LT((estimate.sigma() - sigma).norm(), 0.005 * sigma.norm());
  // Its modes leave out a hundredth of the power, which is a tenth of the root mean square.
  EXPECT_LT((estimate.pattern() - dense.mean).norm(), 0.1 * dense.mean.norm());
}

// Twice as many rows for the same view are the same cells with the same rays.
TEST(WarpEstimate, IsTheSameForAnImageWhosePixelsAreHalfAsHigh) {
  const Camera square = FewCells();
  Camera low = square;
  low.height *= 2, low.fy *= 2, low.cy = 2 * square.cy + 0.5;
  const WarpCells cells = CellsOf(square);
  ASSERT_EQ(CellsOf(low).count(), cells.count());
  WarpEstimate of_square(cells, square, Smooth(), BendLaw::kDepth);
  WarpEstimate of_low(CellsOf(low), low, Smooth(), BendLaw::kDepth);
  std::mt19937 random(6);
  std::normal_distribution<double> normal(0.0, 0.003);
  for (int epoch = 0; epoch < 2; ++epoch) {
    SurfaceView view;
    for (int cell = 0; cell < cells.count(); ++cell) {
      const double x = (cells.CentreU(cell % cells.cols) - square.cx) / square.fx;
      const double y = (cells.CentreV(cell / cells.cols) - square.cy) / square.fy;
      view.cells.push_back({cell, x, y, SlantedQ(x, y, epoch) / (1 + normal(random)), 0.002});
    }
    of_square.Add(view), of_low.Add(view);
    EXPECT_NEAR(of_low.CloseEpoch(), of_square.CloseEpoch(), 1e-6);
  }
  ASSERT_GT(of_square.pattern().norm(), 0.0);
  EXPECT_LT((of_low.pattern() - of_square.pattern()).norm(), 1e-6 * of_square.pattern().norm());
  EXPECT_LT((of_low.sigma() - of_square.sigma()).norm(), 1e-6 * of_square.sigma().norm());
}

}  // namespace
}  // namespace slam
