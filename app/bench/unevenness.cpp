#include "app/bench/unevenness.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace app {
namespace {

constexpr double kStepsTimesMetres = 351.3;  // 8 x 585.5 px x 75 mm: steps per inverse metre
constexpr int kBlock_px = 16;
constexpr double kMinFilled = 0.5;         // of a block
constexpr double kMinImageShare = 0.05;    // of the image: what counts as large
constexpr double kMaxOff_sigmas = 3.0;     // 1 in 370 beyond; farther: another thing
constexpr double kMedianOfSigma = 0.6745;  // median of a normal error's size
constexpr int kFits = 4;                   // the plane and what is off it, in turn

/// What a surface shows in a block: sums, then means.
struct BlockMean {
  Eigen::Vector3d ray = Eigen::Vector3d::Zero();
  double q = 0.0, depth_m = 0.0;
  int pixels = 0;
};
using SurfaceBlocks = std::map<int, std::vector<BlockMean>>;  ///< by label

SurfaceBlocks MeansOfBlocks(const cv::Mat1f& depth_m, const cv::Mat1w& labels,
                            const cv::Mat2d& rays) {
  const int cols = (depth_m.cols + kBlock_px - 1) / kBlock_px;
  std::map<std::pair<int, int>, BlockMean> sums;
  for (int v = 0; v < depth_m.rows; ++v) {
    for (int u = 0; u < depth_m.cols; ++u) {
      const auto z = static_cast<double>(depth_m(v, u));
      if (labels(v, u) == 0 || !(z > 0)) continue;
      BlockMean& sum = sums[{labels(v, u), v / kBlock_px * cols + u / kBlock_px}];
      sum.ray += Eigen::Vector3d(rays(v, u)[0], rays(v, u)[1], 1);
      sum.q += 1 / z, sum.depth_m += z, ++sum.pixels;
    }
  }
  SurfaceBlocks surfaces;
  for (auto& [where, block] : sums) {
    if (block.pixels < kMinFilled * kBlock_px * kBlock_px) continue;
    block.ray /= block.pixels, block.q /= block.pixels, block.depth_m /= block.pixels;
    surfaces[where.first].push_back(block);
  }
  return surfaces;
}

/// The best plane and each block's residual from it, in steps; then what is far off is told.
void FitPlane(const std::vector<BlockMean>& blocks, std::vector<BlockResidual>& residuals) {
  Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
  Eigen::Vector3d b = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    if (!residuals[i].on_plane) continue;
    A += blocks[i].ray * blocks[i].ray.transpose();
    b += blocks[i].q * blocks[i].ray;
  }
  const Eigen::Vector3d plane = A.ldlt().solve(b);
  std::vector<double> sizes;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    residuals[i].steps = kStepsTimesMetres * (blocks[i].q - plane.dot(blocks[i].ray));
    sizes.push_back(std::abs(residuals[i].steps));
  }
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  const double max_steps = kMaxOff_sigmas * *middle / kMedianOfSigma;
  for (BlockResidual& residual : residuals) {
    residual.on_plane = std::abs(residual.steps) <= max_steps;
  }
}

}  // namespace

std::vector<BlockResidual> BlockResiduals(const cv::Mat1f& depth_m, const cv::Mat1w& labels,
                                          const cv::Mat2d& rays) {
  std::vector<BlockResidual> all;
  for (const auto& [label, blocks] : MeansOfBlocks(depth_m, labels, rays)) {
    if (static_cast<double>(blocks.size()) * kBlock_px * kBlock_px <
        kMinImageShare * static_cast<double>(depth_m.total())) {
      continue;
    }
    std::vector<BlockResidual> residuals;
    for (const BlockMean& block : blocks) residuals.push_back({true, block.depth_m});
    for (int fit = 0; fit < kFits; ++fit) FitPlane(blocks, residuals);
    all.insert(all.end(), residuals.begin(), residuals.end());
  }
  return all;
}

}  // namespace app
