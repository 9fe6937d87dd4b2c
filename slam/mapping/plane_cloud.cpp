#include "slam/mapping/plane_cloud.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <tuple>
#include <utility>

namespace slam {
namespace {

constexpr std::int64_t kMaxCells = 1 << 20;  // bounds the grid's memory: 1 MiB

using Cell = std::pair<std::int64_t, std::int64_t>;

/// The voxel of each point.
std::vector<Cell> CellsOf(const std::vector<Eigen::Vector3d>& cloud_w,
                          const Eigen::Matrix<double, 3, 2>& axes,
                          const Eigen::Vector3d& grid_origin_w, double voxel_m) {
  std::vector<Cell> cells;
  cells.reserve(cloud_w.size());
  for (const Eigen::Vector3d& p_w : cloud_w) {
    const Eigen::Vector2d q = axes.transpose() * (p_w - grid_origin_w);
    cells.emplace_back(static_cast<std::int64_t>(std::floor(q.x() / voxel_m)),
                       static_cast<std::int64_t>(std::floor(q.y() / voxel_m)));
  }
  return cells;
}

/// Keeps the first point of each voxel, in the order of arrival. @returns the voxel's side
double Thin(std::vector<Eigen::Vector3d>& cloud_w, const Eigen::Matrix<double, 3, 2>& axes,
            const Eigen::Vector3d& grid_origin_w, double voxel_m) {
  if (cloud_w.empty()) return voxel_m;
  const std::vector<Cell> cells = CellsOf(cloud_w, axes, grid_origin_w, voxel_m);
  // The grid's bounds; one too large for memory is made coarser.
  Cell low = cells.front(), high = cells.front();
  for (const auto& [x, y] : cells) {
    low = {std::min(low.first, x), std::min(low.second, y)};
    high = {std::max(high.first, x), std::max(high.second, y)};
  }
  const std::int64_t width = high.first - low.first + 1, height = high.second - low.second + 1;
  if (width > kMaxCells / height) return Thin(cloud_w, axes, grid_origin_w, 2 * voxel_m);
  // The first point of each cell stays.
  std::vector<char> taken(static_cast<std::size_t>(width * height), 0);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < cloud_w.size(); ++i) {
    const std::int64_t at =
        (cells[i].second - low.second) * width + (cells[i].first - low.first);
    char& cell = taken[static_cast<std::size_t>(at)];
    if (cell) continue;
    cell = 1;
    cloud_w[kept++] = cloud_w[i];
  }
  cloud_w.resize(kept);
  return voxel_m;
}

/// The voxels that hold a point, ascending.
std::vector<Cell> FilledCells(const std::vector<Eigen::Vector3d>& cloud_w,
                              const Eigen::Matrix<double, 3, 2>& axes,
                              const Eigen::Vector3d& grid_origin_w, double voxel_m) {
  std::vector<Cell> cells = CellsOf(cloud_w, axes, grid_origin_w, voxel_m);
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  return cells;
}

/// Twice the signed area of a triangle with sides a and b.
double Cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

}  // namespace

double MergeIntoCloud(std::vector<Eigen::Vector3d>& cloud_w,
                      const std::vector<Eigen::Vector3d>& points_w, const Plane& pi_w,
                      const Eigen::Vector3d& grid_origin_w, double voxel_m, int max_points) {
  const Eigen::Matrix<double, 3, 2> axes = TangentBasis(pi_w.n);
  cloud_w.insert(cloud_w.end(), points_w.begin(), points_w.end());
  voxel_m = Thin(cloud_w, axes, grid_origin_w, voxel_m);
  while (cloud_w.size() > static_cast<std::size_t>(std::max(1, max_points)))
    voxel_m = Thin(cloud_w, axes, grid_origin_w, 2 * voxel_m);
  return voxel_m;
}

Eigen::Vector3d CloudCentroid(const std::vector<Eigen::Vector3d>& cloud_w, const Plane& pi_w) {
  Eigen::Vector3d sum_w = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p_w : cloud_w) sum_w += p_w;
  return ProjectOnto(pi_w, sum_w / static_cast<double>(cloud_w.size()));
}

double CloudOverlap(const std::vector<Eigen::Vector3d>& one_w,
                    const std::vector<Eigen::Vector3d>& other_w, const Plane& pi_w,
                    double voxel_m, int reach) {
  if (one_w.empty() || other_w.empty()) return 0.0;
  const Eigen::Matrix<double, 3, 2> axes = TangentBasis(pi_w.n);
  std::vector<Cell> few = FilledCells(one_w, axes, one_w.front(), voxel_m);
  std::vector<Cell> many = FilledCells(other_w, axes, one_w.front(), voxel_m);
  if (few.size() > many.size()) std::swap(few, many);
  // A voxel is shared if the other cloud has one there or within reach.
  int shared = 0;
  for (const auto& [x, y] : few) {
    bool found = false;
    for (std::int64_t dx = -reach; dx <= reach && !found; ++dx) {
      for (std::int64_t dy = -reach; dy <= reach && !found; ++dy) {
        found = std::binary_search(many.begin(), many.end(), Cell(x + dx, y + dy));
      }
    }
    shared += found ? 1 : 0;
  }
  return static_cast<double>(shared) / static_cast<double>(few.size());
}

Outline ConvexOutline(const std::vector<Eigen::Vector3d>& points_w, const Plane& pi_w) {
  Outline out;
  if (points_w.size() < 3) return out;
  const Eigen::Matrix<double, 3, 2> axes = TangentBasis(pi_w.n);
  const Eigen::Vector3d& grid_origin_w = points_w.front();
  std::vector<Eigen::Vector2d> q;
  q.reserve(points_w.size());
  for (const Eigen::Vector3d& p_w : points_w)
    q.push_back(axes.transpose() * (p_w - grid_origin_w));
  std::sort(q.begin(), q.end(), [](const auto& a, const auto& b) {
    return std::make_pair(a.x(), a.y()) < std::make_pair(b.x(), b.y());
  });
  // Andrew's monotone chain: lower hull, then upper hull.
  std::vector<Eigen::Vector2d> hull(2 * q.size());
  std::size_t k = 0;
  const auto add = [&](const Eigen::Vector2d& p, std::size_t min_size) {
    while (k >= min_size && Cross(hull[k - 1] - hull[k - 2], p - hull[k - 1]) <= 0) --k;
    hull[k++] = p;
  };
  for (const Eigen::Vector2d& p : q) add(p, 2);
  const std::size_t upper = k + 1;
  for (std::size_t i = q.size() - 1; i-- > 0;) add(q[i], upper);
  hull.resize(k - 1);
  if (hull.size() < 3) return out;
  // Area by the shoelace formula.
  double twice = 0.0;
  for (std::size_t i = 0; i < hull.size(); ++i)
    twice += Cross(hull[i], hull[(i + 1) % hull.size()]);
  out.area_m2 = 0.5 * twice;
  for (const Eigen::Vector2d& p : hull) {
    out.hull_w.push_back(ProjectOnto(pi_w, grid_origin_w + axes * p));
  }
  return out;
}

}  // namespace slam
