#include "slam/segment/seam_evidence.h"

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace slam {
namespace {

constexpr double kSmoothed_px = 3.0;  // on either side of a line
constexpr double kContact_px = 8.0;   // pixels as near tell how far the line runs
constexpr double kLeastNear_px = 12.0;
constexpr double kLeastSeamContacts = 4.0;

using SideSums = std::array<PlaneSums, 2>;
using TwoRays = Eigen::Matrix<double, 2, 3>;

/// Calls look(i, u, v, distance from the line) for the pixels of a segment.
template <typename Look>
void VisitPixels(const DepthGrid& grid, const LabelImage& labels, const SeamView& view,
                 const Seam& seam, const Look& look) {
  const cv::Rect& b = view.bounds;
  for (int v = b.y; v < b.y + b.height; v += view.step_px) {
    for (int u = b.x; u < b.x + b.width; u += view.step_px) {
      const auto i = static_cast<std::size_t>(grid.Index(u, v));
      if (labels[i] == view.label) look(i, u, v, seam.Beyond(u, v));
    }
  }
}

/// How far a segment reaches from a line on either side, and the stretch of the line in it.
struct Extent {
  std::array<double, 2> reach_px{};
  double contacts = 0.0, mean_px = 0.0, deviation_px = 0.0;
};

Extent MeasureExtent(const DepthGrid& grid, const LabelImage& labels, const SeamView& view,
                     const Seam& seam) {
  Extent extent;
  double sum = 0.0, squares = 0.0;
  VisitPixels(grid, labels, view, seam, [&](std::size_t, int u, int v, double beyond) {
    double& reach = extent.reach_px[beyond > 0.0 ? 1 : 0];
    reach = std::max(reach, std::abs(beyond));
    if (std::abs(beyond) > kContact_px) return;
    const double along = seam.Along(u, v);
    extent.contacts += 1.0, sum += along, squares += along * along;
  });
  if (extent.contacts == 0.0) return extent;
  extent.mean_px = sum / extent.contacts;
  extent.deviation_px =
      std::sqrt(std::max(squares / extent.contacts - extent.mean_px * extent.mean_px, 1.0));
  return extent;
}

/// Rays of two points of a line, a standard deviation from the middle of its stretch: the mean
/// square along it of what is linear is the mean of theirs.
TwoRays RaysOf(const DepthGrid& grid, const Seam& seam, const Extent& extent) {
  TwoRays rays;
  for (const int k : {0, 1}) {
    const double along = extent.mean_px + (k == 0 ? -1.0 : 1.0) * extent.deviation_px;
    const double u = seam.at_px * seam.cosine - along * seam.sine;
    const double v = seam.at_px * seam.sine + along * seam.cosine;
    const int column = std::clamp(static_cast<int>(std::lround(u)), 0, grid.width - 1);
    const int row = std::clamp(static_cast<int>(std::lround(v)), 0, grid.height - 1);
    const auto i = static_cast<std::size_t>(grid.Index(column, row));
    rays.row(k) << static_cast<double>(grid.x[i]), static_cast<double>(grid.y[i]), 1.0;
  }
  return rays;
}

Eigen::Matrix3d Inverse(const PlaneSums& s) {
  Eigen::Matrix3d information;
  information << s.wxx, s.wxy, s.wx, s.wxy, s.wyy, s.wy, s.wx, s.wy, s.w;
  return information.inverse();
}

/// The gap between the planes of two sides at two rays.
struct Gap {
  Eigen::Vector2d value;
  Eigen::Matrix2d covariance;  ///< in variances of a pixel
  double error = 0.0;          ///< of both fits
};

std::optional<Gap> GapBetween(const SideSums& sides, const TwoRays& rays) {
  const std::optional<PlaneFit> low = Fit(sides[0]), high = Fit(sides[1]);
  if (!low || !high) return std::nullopt;
  const InverseDepthPlane &p = high->plane, &r = low->plane;
  const Eigen::Vector3d by(p.a - r.a, p.b - r.b, p.c - r.c);
  return Gap{rays * by, rays * (Inverse(sides[0]) + Inverse(sides[1])) * rays.transpose(),
             low->error + high->error};
}

}  // namespace

std::optional<SeamEvidence> WeighSeam(const DepthGrid& grid, const LabelImage& labels,
                                      const SeamView& view, const Seam& seam,
                                      const DepthNoise& noise) {
  const Extent extent = MeasureExtent(grid, labels, view, seam);
  if (extent.contacts < kLeastSeamContacts) return std::nullopt;
  SideSums whole, near;
  VisitPixels(grid, labels, view, seam, [&](std::size_t i, int, int, double beyond) {
    if (std::abs(beyond) < kSmoothed_px) return;
    const std::size_t side = beyond > 0.0 ? 1 : 0;
    const auto x = static_cast<double>(grid.x[i]), y = static_cast<double>(grid.y[i]);
    const auto q = static_cast<double>(grid.q[i]), g = static_cast<double>(grid.g[i]);
    whole[side].Add(x, y, q, g * g);
    if (std::abs(beyond) < std::max(0.5 * extent.reach_px[side], kLeastNear_px))
      near[side].Add(x, y, q, g * g);
  });
  const TwoRays rays = RaysOf(grid, seam, extent);
  const std::optional<Gap> all = GapBetween(whole, rays), here = GapBetween(near, rays);
  if (!all || !here) return std::nullopt;
  const double n = whole[0].n + whole[1].n, w = whole[0].w + whole[1].w;
  const double grazing2 = view.grazing * view.grazing;
  const double variance = std::max(grazing2, all->error / std::max(n - 6.0, 1.0)) *
                          std::max(1.0, noise.correlated_px / (view.step_px * view.step_px));
  const Eigen::Vector2d weighed = here->covariance.inverse() * all->value;
  SeamEvidence evidence;
  evidence.chi2 = all->value.dot(all->covariance.inverse() * all->value) / variance;
  const double square =
      0.5 * (all->value.squaredNorm() - variance * all->covariance.trace()) * w / n;
  evidence.gap_sigmas = std::sqrt(std::max(square, 0.0) / grazing2);
  evidence.share = here->value.dot(weighed) / all->value.dot(weighed);
  return evidence;
}

}  // namespace slam
