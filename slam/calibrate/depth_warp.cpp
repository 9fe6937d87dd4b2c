#include "slam/calibrate/depth_warp.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <vector>

namespace slam {
namespace {

constexpr double kCell_px = 20.0;  // a cell is flat to 15 % of the bend of docs/sensors.md

/// Where a pixel stands between the centres of cells.
struct BetweenCells {
  int first = 0;      ///< the cell before it; `next` is the one after
  int next = 0;       ///< the same as `first` at the rim
  double part = 0.0;  ///< [0, 1], from first to next
};

double RootMeanSquare(const Eigen::VectorXd& values) {
  return values.size() > 0
             ? std::sqrt(values.squaredNorm() / static_cast<double>(values.size()))
             : 0.0;
}

template <typename Centre>
std::vector<BetweenCells> Between(int pixels, int cells, const Centre& centre) {
  std::vector<BetweenCells> between;
  int first = 0;
  for (int u = 0; u < pixels; ++u) {
    while (first + 1 < cells && centre(first + 1) <= u) ++first;
    const int next = std::min(first + 1, cells - 1);
    const double gap = centre(next) - centre(first);
    const double part = gap > 0 ? std::clamp((u - centre(first)) / gap, 0.0, 1.0) : 0.0;
    between.push_back({first, next, part});
  }
  return between;
}

}  // namespace

WarpCells CellsOf(const Camera& camera) {
  const auto count = [](int pixels, double focal_px) {
    const double cells = pixels * kStatedFocal_px / (focal_px * kCell_px);
    return std::clamp(static_cast<int>(std::lround(cells)), 1, pixels);
  };
  return {camera.width, camera.height, count(camera.width, camera.fx),
          count(camera.height, camera.fy)};
}

double DepthWarp::Rms() const { return RootMeanSquare(pattern); }
double DepthWarp::SigmaRms() const { return RootMeanSquare(sigma); }

const std::vector<std::string>& BendLawNames() {
  static const std::vector<std::string> names = {"depth", "disparity"};
  return names;
}

Straightening StraighteningBy(const DepthWarp& warp) {
  const WarpCells& cells = warp.cells;
  const auto across =
      Between(cells.width, cells.cols, [&](int col) { return cells.CentreU(col); });
  const auto down =
      Between(cells.height, cells.rows, [&](int row) { return cells.CentreV(row); });
  cv::Mat1f pattern(cells.height, cells.width);
  std::vector<double> row(static_cast<std::size_t>(cells.cols));
  for (int v = 0; v < cells.height; ++v) {
    const BetweenCells& y = down[static_cast<std::size_t>(v)];
    for (int col = 0; col < cells.cols; ++col) {
      const double above = warp.pattern[y.first * cells.cols + col];
      const double below = warp.pattern[y.next * cells.cols + col];
      row[static_cast<std::size_t>(col)] = above + y.part * (below - above);
    }
    for (int u = 0; u < cells.width; ++u) {
      const BetweenCells& x = across[static_cast<std::size_t>(u)];
      const double left = row[static_cast<std::size_t>(x.first)];
      const double right = row[static_cast<std::size_t>(x.next)];
      pattern(v, u) = static_cast<float>(left + x.part * (right - left));
    }
  }
  return {pattern, warp.law};
}

cv::Mat1f Straightened(const cv::Mat1f& depth_m, const Straightening& straightening) {
  if (straightening.pattern.empty()) return depth_m;
  const bool grows = straightening.law == BendLaw::kDisparity;
  constexpr float kPerMetre = 1.0F / static_cast<float>(kBendDistance_m);
  cv::Mat1f straight(depth_m.size());
  for (int v = 0; v < depth_m.rows; ++v) {
    const float *z = depth_m[v], *p = straightening.pattern[v];
    float* out = straight[v];
    for (int u = 0; u < depth_m.cols; ++u) {
      out[u] = z[u] / (1.0F + p[u] * (grows ? kPerMetre * z[u] : 1.0F));
    }
  }
  return straight;
}

}  // namespace slam
