#include "slam/associate/side_by_side.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <opencv2/core.hpp>

namespace slam {
namespace {

constexpr int kTile_px = 8;
constexpr int kReach = 5;  // tiles, at a width of kFullWidth_px
constexpr int kFullWidth_px = 640;
constexpr double kMinPixels = 12.0;     // in a tile: fewer are its neighbour's edge
constexpr std::size_t kMinTiles = 4;    // for each plane
constexpr std::size_t kUnknowns = 4;    // two slopes, a height and the step
constexpr std::size_t kMinFreedom = 6;  // to know the scatter of the tiles

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
  std::vector<Tile> row_of_tiles(frame.planes.size());
  std::vector<std::size_t> seen;
  for (int v0 = 0; v0 < size.height; v0 += kTile_px) {
    for (int u0 = 0; u0 < size.width; u0 += kTile_px) {
      seen.clear();
      for (int v = v0; v < std::min(v0 + kTile_px, size.height); ++v) {
        for (int u = u0; u < std::min(u0 + kTile_px, size.width); ++u) {
          const std::size_t label = frame.plane_labels(v, u);
          const auto z = static_cast<double>(frame.depth_m(v, u));
          if (label == 0 || label > tiles_.size() || !(z > 0)) continue;
          Tile& tile = row_of_tiles[label - 1];
          if (tile.pixels == 0) seen.push_back(label - 1);
          tile.pixels += 1;
          tile.mean_c += z * Eigen::Vector3d(u, v, 1);
        }
      }
      for (const std::size_t f : seen) {
        Tile tile = row_of_tiles[f];
        row_of_tiles[f] = {};
        if (tile.pixels < kMinPixels) continue;
        const double z = tile.mean_c.z();
        const Eigen::Vector2d at_px = camera.Undistort(tile.mean_c.head<2>() / z);
        tile.mean_c = camera.Backproject(at_px, z / tile.pixels);
        tile.column = u0 / kTile_px, tile.row = v0 / kTile_px;
        tiles_[f].push_back(tile);
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
