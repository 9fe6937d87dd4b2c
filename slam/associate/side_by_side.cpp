#include "slam/associate/side_by_side.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <opencv2/core.hpp>
#include <utility>

namespace slam {
namespace {

constexpr int kTile_px = 8;
constexpr int kReach = 5;  // tiles, at a width of kFullWidth_px
constexpr int kFullWidth_px = 640;
constexpr double kMinPixels = 12.0;     // in a tile: fewer are its neighbour's edge
constexpr std::size_t kMinTiles = 4;    // for each plane
constexpr std::size_t kUnknowns = 4;    // two slopes, a height and the step
constexpr std::size_t kMinFreedom = 6;  // to know the scatter of the tiles

/// Sums over the measured pixels that a plane has in a tile, from the tile's corner.
struct PixelSums {
  double pixels = 0.0, z = 0.0, zu = 0.0, zv = 0.0;
};

/// The label of all pixels, if they share one. @param pixels  at most a tile
std::optional<std::size_t> OnlyLabel(const cv::Mat1b& labels, const cv::Rect& pixels) {
  if (pixels.width != kTile_px) return std::nullopt;
  std::uint64_t first = 0, others = 0;
  std::memcpy(&first, labels[pixels.y] + pixels.x, sizeof first);
  const std::uint64_t one = first & 0xFF;
  constexpr std::uint64_t kEach = 0x0101010101010101;
  for (int v = pixels.y; v < pixels.y + pixels.height; ++v) {
    std::uint64_t row = 0;
    std::memcpy(&row, labels[v] + pixels.x, sizeof row);
    others |= row ^ (one * kEach);
  }
  if (others != 0) return std::nullopt;
  return static_cast<std::size_t>(one);
}

/// Of a tile that is one plane's, column by column: most tiles are. What is not measured is 0.
PixelSums SumWholeTile(const cv::Mat1f& depth_m, const cv::Rect& pixels) {
  std::array<double, kTile_px> n{}, z{}, zv{};
  for (int v = 0; v < pixels.height; ++v) {
    const float* row = depth_m[pixels.y + v] + pixels.x;
    for (std::size_t k = 0; k < z.size(); ++k) {
      const auto z_m = static_cast<double>(row[k]);
      n[k] += z_m > 0 ? 1.0 : 0.0;
      z[k] += z_m;
      zv[k] += v * z_m;
    }
  }
  PixelSums sum;
  for (std::size_t k = 0; k < z.size(); ++k) {
    sum.pixels += n[k];
    sum.z += z[k];
    sum.zu += static_cast<double>(k) * z[k];
    sum.zv += zv[k];
  }
  return sum;
}

/// Of any tile. @param seen  gets the planes that are there
void SumByLabel(const Frame& frame, const cv::Rect& pixels, std::vector<PixelSums>& sums,
                std::vector<std::size_t>& seen) {
  for (int v = 0; v < pixels.height; ++v) {
    for (int u = 0; u < pixels.width; ++u) {
      const cv::Point at(pixels.x + u, pixels.y + v);
      const std::size_t label = frame.plane_labels(at);
      const auto z_m = static_cast<double>(frame.depth_m(at));
      if (label == 0 || label > sums.size() || !(z_m > 0)) continue;
      PixelSums& sum = sums[label - 1];
      if (sum.pixels == 0) seen.push_back(label - 1);
      sum.pixels += 1;
      sum.z += z_m;
      sum.zu += u * z_m;
      sum.zv += v * z_m;
    }
  }
}

}  // namespace

SideBySide::SideBySide(const Frame& frame, const Camera& camera)
    : frame_(frame),
      columns_((camera.width + kTile_px - 1) / kTile_px),
      rows_((camera.height + kTile_px - 1) / kTile_px),
      reach_(std::max(2, kReach * camera.width / kFullWidth_px)),
      tiles_(frame.planes.size()) {
  const cv::Size size(camera.width, camera.height);
  if (frame.depth_m.size() != size || frame.plane_labels.size() != size) return;
  // Tile by tile: the mean point of each plane that has enough pixels there.
  std::vector<PixelSums> sums(frame.planes.size());
  std::vector<std::size_t> seen;
  for (int v0 = 0; v0 < size.height; v0 += kTile_px) {
    for (int u0 = 0; u0 < size.width; u0 += kTile_px) {
      seen.clear();
      const cv::Rect pixels = cv::Rect(u0, v0, kTile_px, kTile_px) & cv::Rect({}, size);
      if (const auto label = OnlyLabel(frame.plane_labels, pixels)) {
        if (*label == 0 || *label > sums.size()) continue;
        sums[*label - 1] = SumWholeTile(frame.depth_m, pixels);
        seen.push_back(*label - 1);
      } else {
        SumByLabel(frame, pixels, sums, seen);
      }
      for (const std::size_t f : seen) {
        const PixelSums sum = std::exchange(sums[f], {});
        if (sum.pixels < kMinPixels) continue;
        const Eigen::Vector2d at_px =
            camera.Undistort({u0 + sum.zu / sum.z, v0 + sum.zv / sum.z});
        tiles_[f].push_back({u0 / kTile_px, v0 / kTile_px, sum.pixels,
                             camera.Backproject(at_px, sum.z / sum.pixels)});
      }
    }
  }
}

/// The tiles of `of` that are within reach of `to`.
SideBySide::Tiles SideBySide::Near(const Tiles& of, const Tiles& to) const {
  cv::Mat1b reached(rows_, columns_, static_cast<unsigned char>(0));
  const cv::Rect all(0, 0, columns_, rows_);
  for (const Tile& tile : to) {
    const cv::Rect around(tile.column - reach_, tile.row - reach_, 2 * reach_ + 1,
                          2 * reach_ + 1);
    reached(around & all) = 1;
  }
  Tiles near;
  std::copy_if(of.begin(), of.end(), std::back_inserter(near),
               [&](const Tile& tile) { return reached(tile.row, tile.column) != 0; });
  return near;
}

std::optional<StepBetween> SideBySide::Between(std::size_t one, std::size_t other) const {
  const Tiles a = Near(tiles_[one], tiles_[other]), b = Near(tiles_[other], a);
  if (a.size() < kMinTiles || b.size() < kMinTiles) return std::nullopt;
  if (a.size() + b.size() < kUnknowns + kMinFreedom) return std::nullopt;
  const Eigen::Vector3d n =
      (frame_.planes[one].pi_c.n + frame_.planes[other].pi_c.n).normalized();
  const Eigen::Matrix<double, 3, 2> axes = TangentBasis(n);
  const Eigen::Vector3d middle = b.front().mean_c;
  // Height = slope . place + base + step, the step on `one` only; each tile by its pixels.
  Eigen::Matrix4d A = Eigen::Matrix4d::Zero();
  Eigen::Vector4d y = Eigen::Vector4d::Zero();
  double squares = 0.0;
  const auto add = [&](const Tiles& tiles, double on_one) {
    for (const Tile& tile : tiles) {
      const Eigen::Vector3d x = tile.mean_c - middle;
      const Eigen::Vector2d place = axes.transpose() * x;
      const Eigen::Vector4d row(place.x(), place.y(), 1, on_one);
      const double height = n.dot(x);
      A += tile.pixels * row * row.transpose();
      y += tile.pixels * height * row;
      squares += tile.pixels * height * height;
    }
  };
  add(a, 1), add(b, 0);
  // The step and, from the scatter of the tiles about the fit, its standard deviation.
  const Eigen::LDLT<Eigen::Matrix4d> solver(A);
  if (solver.info() != Eigen::Success || !solver.isPositive()) return std::nullopt;
  const Eigen::Vector4d fit = solver.solve(y);
  const double freedom = static_cast<double>(a.size() + b.size() - kUnknowns);
  const double variance = std::max(0.0, squares - fit.dot(y)) / freedom;
  const double spread = solver.solve(Eigen::Vector4d::UnitW()).w();
  if (!(spread > 0) || !std::isfinite(fit.w())) return std::nullopt;
  return StepBetween{fit.w(), std::sqrt(variance * spread)};
}

}  // namespace slam
