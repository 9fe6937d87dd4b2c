#include "eval/surfaces/surfel_cloud.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "eval/surfaces/depth_error.h"

namespace eval {
namespace {

constexpr int kAxes = 6;
// Noise makes normals rough.
const double kMinFacingCosine = std::cos(35.0 * std::numbers::pi / 180);
constexpr int kBits = 20;  // of a coordinate of a cell, in a key that also holds the axis

int NearestAxis(const Eigen::Vector3d& n) {
  Eigen::Index axis = 0;
  n.cwiseAbs().maxCoeff(&axis);
  return 2 * int(axis) + (n[axis] < 0 ? 1 : 0);
}

}  // namespace

std::uint64_t CellKey(const Eigen::Vector3i& cell) {
  std::uint64_t key = 0;
  for (const int coordinate : cell) {
    key = key << kBits | (std::uint64_t(coordinate + (1 << (kBits - 1))) & ((1 << kBits) - 1));
  }
  return key;
}

void SurfelCloud::Add(const DepthView& view, const cv::Mat2d& rays, const LocalNormals& local,
                      double noise_per_m) {
  for (int v = 0; v < view.depth_m.rows; ++v) {
    for (int u = 0; u < view.depth_m.cols; ++u) {
      if (!IsSmooth(local, v, u, noise_per_m)) continue;
      const double z = view.depth_m(v, u);
      const Eigen::Vector3d p_c(z * rays(v, u)[0], z * rays(v, u)[1], z);
      const cv::Vec3f& n = local.normals_c(v, u);
      const Eigen::Vector3d p_g = view.T_gc * p_c;
      const Eigen::Vector3d n_g = view.T_gc.R * Eigen::Vector3d(n[0], n[1], n[2]);

      // Near views know a place better than far ones: the bend grows with distance.
      const double weight = 1 / (z * z);
      const Eigen::Vector3i cell = (p_g / kCell_m).array().floor().cast<int>();
      Sum& sum = sums_[CellKey(cell) * kAxes + std::uint64_t(NearestAxis(n_g))];
      sum.p += weight * p_g;
      sum.n += weight * n_g;
      sum.depth += weight * z;
      sum.weight += weight;
      ++sum.count;
    }
  }
}

std::vector<Surfel> SurfelCloud::Surfels() const {
  std::vector<std::pair<std::uint64_t, const Sum*>> order;
  for (const auto& [key, sum] : sums_) {
    if (sum.count >= kMinPoints) order.emplace_back(key, &sum);
  }
  std::sort(order.begin(), order.end(),
            [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<Surfel> surfels;
  for (const auto& [key, sum] : order) {
    Surfel surfel;
    surfel.p_g = sum->p / sum->weight;
    surfel.n_g = sum->n.normalized();
    surfel.depth_m = sum->depth / sum->weight;
    surfel.count = sum->count;
    surfel.cell = (surfel.p_g / kCell_m).array().floor().cast<int>();
    surfels.push_back(surfel);
  }
  return surfels;
}

SurfelIndex::SurfelIndex(const std::vector<Surfel>& surfels) {
  for (std::size_t i = 0; i < surfels.size(); ++i) {
    at_[CellKey(surfels[i].cell)].push_back(i);
  }
}

std::vector<Surfel> DrawnTogether(const std::vector<Surfel>& surfels, double noise_per_m) {
  constexpr int kMaxReach_cells = 6;  // the work; 3 sigmas of a first Kinect at 5 m
  // Balances: halves of a sheet on a border of cells are alike.
  constexpr double kMaxRatio = 1.5;
  const SurfelIndex index(surfels);
  std::vector<Surfel> together;
  for (const Surfel& own : surfels) {
    const double max_m =
        DepthError::kSigmas * DepthError{noise_per_m}.OfPixel_m(own.depth_m, 1.0);
    const int reach = std::min(kMaxReach_cells, int(std::ceil(max_m / SurfelCloud::kCell_m)));
    double points = 0.0, behind_sum_m = 0.0;
    bool is_tail = false;
    index.ForNear(own.cell, reach, [&](std::size_t j) {
      const Surfel& other = surfels[j];
      if (!(other.n_g.dot(own.n_g) > kMinFacingCosine)) return;
      const Eigen::Vector3d apart = other.p_g - own.p_g;
      const double behind_m = apart.dot(own.n_g);
      const double beside_m = (apart - behind_m * own.n_g).norm();
      if (!(std::abs(behind_m) < max_m)) return;
      is_tail =
          is_tail || (beside_m < SurfelCloud::kCell_m && other.count > kMaxRatio * own.count);
      if (!(beside_m < std::max(SurfelCloud::kCell_m, max_m / 2))) return;
      points += other.count;
      behind_sum_m += other.count * behind_m;
    });
    if (is_tail) continue;
    Surfel moved = own;
    moved.p_g += behind_sum_m / points * own.n_g;
    moved.cell = (moved.p_g / SurfelCloud::kCell_m).array().floor().cast<int>();
    together.push_back(moved);
  }
  return together;
}

}  // namespace eval
