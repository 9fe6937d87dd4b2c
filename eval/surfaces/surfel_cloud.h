#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "eval/surfaces/depth_views.h"
#include "eval/surfaces/local_normals.h"

namespace eval {

/// Key of a cell: 20 bits a coordinate, 16 km either way.
std::uint64_t CellKey(const Eigen::Vector3i& cell);

/// The mean of the points that fell into one cell of space and face the same way.
struct Surfel {
  Eigen::Vector3d p_g = Eigen::Vector3d::Zero();
  Eigen::Vector3d n_g = Eigen::Vector3d::Zero();  ///< unit, towards the cameras
  double depth_m = 0.0;                           ///< at which it was seen, mean
  int count = 0;                                  ///< points
  Eigen::Vector3i cell = Eigen::Vector3i::Zero();
};

/// Depth of many views laid together: a cell of space holds one mean for each of the six axes
/// that normals may be nearest to, so that the two sides of a thin board stay apart.
class SurfelCloud {
 public:
  static constexpr double kCell_m = 0.03;  ///< balances: a pixel at 3.5 m is 7 mm wide
  static constexpr int kMinPoints = 8;     ///< fewer are no mean

  /// Adds the smooth points of a view; the fits' stride is the cloud's.
  void Add(const DepthView& view, const cv::Mat2d& rays, const LocalNormals& local,
           double noise_per_m);
  /// Means of cells with enough points, in an order that depends on the points alone.
  std::vector<Surfel> Surfels() const;

 private:
  struct Sum {
    Eigen::Vector3d p = Eigen::Vector3d::Zero(), n = Eigen::Vector3d::Zero();
    double weight = 0.0, depth = 0.0;
    int count = 0;
  };
  std::unordered_map<std::uint64_t, Sum> sums_;
};

/// Finds surfels by the cell that they lie in.
class SurfelIndex {
 public:
  explicit SurfelIndex(const std::vector<Surfel>& surfels);
  /// Calls visit(i) for the surfels at most `reach` cells away in each coordinate.
  template <typename Visit>
  void ForNear(const Eigen::Vector3i& cell, int reach, const Visit& visit) const {
    for (int x = -reach; x <= reach; ++x) {
      for (int y = -reach; y <= reach; ++y) {
        for (int z = -reach; z <= reach; ++z) {
          const auto found = at_.find(CellKey(cell + Eigen::Vector3i(x, y, z)));
          if (found == at_.end()) continue;
          for (const std::size_t i : found->second) visit(i);
        }
      }
    }
  }

 private:
  std::unordered_map<std::uint64_t, std::vector<std::size_t>> at_;
};

/// The surfels, each moved along its normal to the mean of those that face the same way and
/// stand before or behind it, within the noise of their distance: noise spreads a far wall over
/// many cells, which look like thinner walls one behind the other. Those with fewer points than
/// one before or behind them are left out.
std::vector<Surfel> DrawnTogether(const std::vector<Surfel>& surfels, double noise_per_m);

}  // namespace eval
