#include "eval/surfaces/grow_planes.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "eval/surfaces/depth_error.h"

namespace eval {
namespace {

// The normal of a single surfel is off by noise and by the slope of the bend, some degrees.
const double kMinSurfelCosine = std::cos(25.0 * std::numbers::pi / 180);
// Two patches of one bent surface: the slope of the bend over a patch of half a metre.
const double kMinPatchCosine = std::cos(6.0 * std::numbers::pi / 180);
constexpr std::size_t kMinSeedSurfels = 12;  // of the 25 of a flat place in its 5 x 5 x 5 cells
constexpr double kRefitGrowth = 1.2;  // a plane is fitted again when its region grew by a fifth
constexpr int kRounds = 3;            // of growing from the plane of the round before
// Of the surfels of two patches, on their common plane.
constexpr double kMinSharedOnPlane = 0.9;

/// Weighted sums of points for a plane by least squares.
class PlaneSum {
 public:
  void Add(const Surfel& surfel) {
    const double sigma_m = DepthError::OfMean_m(surfel.depth_m);
    const double weight = 1 / (sigma_m * sigma_m);
    weight_ += weight;
    sum_ += weight * surfel.p_g;
    squares_ += weight * surfel.p_g * surfel.p_g.transpose();
    facing_ += weight * surfel.n_g;
  }
  Plane Fit() const {
    const Eigen::Vector3d mean = sum_ / weight_;
    const Eigen::Matrix3d covariance = squares_ / weight_ - mean * mean.transpose();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance);
    Eigen::Vector3d n = solver.eigenvectors().col(0).normalized();
    if (n.dot(facing_) < 0) n = -n;
    return {n, -n.dot(mean)};
  }

 private:
  double weight_ = 0.0;
  Eigen::Vector3d sum_ = Eigen::Vector3d::Zero(), facing_ = Eigen::Vector3d::Zero();
  Eigen::Matrix3d squares_ = Eigen::Matrix3d::Zero();
};

bool IsOn(const Plane& pi_g, const Surfel& surfel) {
  const double max_m = DepthError::kSigmas * DepthError::OfMean_m(surfel.depth_m);
  return std::abs(SignedDistance(pi_g, surfel.p_g)) < max_m;
}

class PlaneGrower {
 public:
  explicit PlaneGrower(const std::vector<Surfel>& surfels)
      : surfels_(surfels), index_(surfels), owner_(surfels.size(), kFree) {
    for (std::size_t i = 0; i < surfels.size(); ++i)
      neighbours_.push_back(NeighboursOf(int(i)));
  }

  std::vector<PlanePatch> Grow(double min_area_m2) {
    const auto min_surfels =
        std::size_t(min_area_m2 / (SurfelCloud::kCell_m * SurfelCloud::kCell_m));
    std::vector<PlanePatch> patches;
    for (const int seed : SeedsFlattestFirst()) {
      if (owner_[std::size_t(seed)] != kFree) continue;
      const auto region = GrowFrom(seed);
      if (region.second.size() < min_surfels) continue;
      PlanePatch patch{region.first, {}};
      for (const int i : region.second) {
        owner_[std::size_t(i)] = int(patches.size());
        patch.surfels.push_back(surfels_[std::size_t(i)]);
      }
      patches.push_back(std::move(patch));
    }
    return patches;
  }

 private:
  static constexpr int kFree = -1;
  static constexpr int kReach = 2;  // cells: over a gap of one

  std::vector<int> NeighboursOf(int i) const {
    std::vector<int> neighbours;
    const Surfel& surfel = surfels_[std::size_t(i)];
    index_.ForNear(surfel.cell, kReach, [&](std::size_t j) {
      if (surfels_[j].n_g.dot(surfel.n_g) > kMinSurfelCosine) neighbours.push_back(int(j));
    });
    return neighbours;
  }

  /// Surfels by how well their neighbours lie on their own plane, of those with enough of them.
  std::vector<int> SeedsFlattestFirst() const {
    std::vector<std::pair<double, int>> scored;
    for (std::size_t i = 0; i < surfels_.size(); ++i) {
      double sum = 0.0;
      const Plane own{surfels_[i].n_g, -surfels_[i].n_g.dot(surfels_[i].p_g)};
      for (const int j : neighbours_[i]) {
        const Surfel& other = surfels_[std::size_t(j)];
        sum += std::abs(SignedDistance(own, other.p_g)) / DepthError::OfMean_m(other.depth_m);
      }
      const auto near = neighbours_[i].size();
      if (near >= kMinSeedSurfels) scored.emplace_back(sum / double(near), int(i));
    }
    std::sort(scored.begin(), scored.end());
    std::vector<int> seeds;
    seeds.reserve(scored.size());
    for (const auto& [score, i] : scored) seeds.push_back(i);
    return seeds;
  }

  std::pair<Plane, std::vector<int>> GrowFrom(int seed) const {
    PlaneSum sum;
    for (const int j : neighbours_[std::size_t(seed)]) sum.Add(surfels_[std::size_t(j)]);
    Plane pi_g = sum.Fit();
    std::vector<int> region;
    for (int round = 0; round < kRounds; ++round) {
      // Only the first round lets the plane turn as it grows; later ones grow on a good plane.
      region = Flood(seed, pi_g, round == 0);
      if (region.size() < kMinSeedSurfels) break;
      PlaneSum all;
      for (const int i : region) all.Add(surfels_[std::size_t(i)]);
      pi_g = all.Fit();
    }
    return {pi_g, region};
  }

  std::vector<int> Flood(int seed, Plane pi_g, bool refit) const {
    std::vector<int> region{seed};
    std::vector<bool> seen(surfels_.size(), false);
    seen[std::size_t(seed)] = true;
    PlaneSum sum;
    sum.Add(surfels_[std::size_t(seed)]);
    double refit_at = 2.0 * double(kMinSeedSurfels);
    for (std::size_t next = 0; next < region.size(); ++next) {
      for (const int j : neighbours_[std::size_t(region[next])]) {
        const auto at = std::size_t(j);
        if (seen[at] || owner_[at] != kFree || !IsOn(pi_g, surfels_[at])) continue;
        if (!(surfels_[at].n_g.dot(pi_g.n) > kMinSurfelCosine)) continue;
        seen[at] = true;
        region.push_back(j);
        sum.Add(surfels_[at]);
      }
      if (!refit || double(region.size()) < refit_at) continue;
      pi_g = sum.Fit();
      refit_at = kRefitGrowth * double(region.size());
    }
    return region;
  }

  const std::vector<Surfel>& surfels_;
  SurfelIndex index_;
  std::vector<int> owner_;
  std::vector<std::vector<int>> neighbours_;  ///< that face the same way
};

double ShareOn(const Plane& pi_g, const std::vector<Surfel>& surfels) {
  const auto on = std::count_if(surfels.begin(), surfels.end(),
                                [&](const Surfel& surfel) { return IsOn(pi_g, surfel); });
  return double(on) / double(surfels.size());
}

/// The plane of both patches together, when both lie on it.
bool AreOnePlane(const PlanePatch& a, const PlanePatch& b, Plane& common) {
  if (!(a.pi_g.n.dot(b.pi_g.n) > kMinPatchCosine)) return false;
  PlaneSum sum;
  for (const Surfel& surfel : a.surfels) sum.Add(surfel);
  for (const Surfel& surfel : b.surfels) sum.Add(surfel);
  common = sum.Fit();
  return ShareOn(common, a.surfels) >= kMinSharedOnPlane &&
         ShareOn(common, b.surfels) >= kMinSharedOnPlane;
}

/// Joins each patch to the largest one that it is one plane with, until none is.
std::vector<PlanePatch> Joined(std::vector<PlanePatch> patches) {
  for (bool joined = true; joined;) {
    joined = false;
    std::stable_sort(patches.begin(), patches.end(), [](const auto& a, const auto& b) {
      return a.surfels.size() > b.surfels.size();
    });
    for (std::size_t a = 0; a < patches.size(); ++a) {
      for (std::size_t b = a + 1; b < patches.size();) {
        Plane common;
        if (!AreOnePlane(patches[a], patches[b], common)) {
          ++b;
          continue;
        }
        auto& from = patches[b].surfels;
        patches[a].surfels.insert(patches[a].surfels.end(), from.begin(), from.end());
        patches[a].pi_g = common;
        patches.erase(patches.begin() + std::ptrdiff_t(b));
        joined = true;
      }
    }
  }
  return patches;
}

}  // namespace

std::vector<PlanePatch> GrowPlanes(const std::vector<Surfel>& surfels, double min_area_m2) {
  return Joined(PlaneGrower(surfels).Grow(min_area_m2));
}

}  // namespace eval
