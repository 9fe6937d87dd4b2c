#include "slam/segment/boundary_shares.h"

#include <Eigen/Core>
#include <Eigen/LU>
#include <cmath>
#include <cstddef>
#include <optional>

namespace slam {
namespace {

constexpr int kFarthest_px = 120;  // a label's width is sought so far, to save time
constexpr int kStripsInWidth = 3;  // a strip is a third of a label: a bend then shows a third
constexpr int kMinStrip_px = 6;    // balances narrow labels against strips that noise tilts
constexpr int kHole_px = 3;        // unmeasured or stray pixels that do not end a label
constexpr int kNearest_px = 2;     // matchers smooth over the pixels nearest to a step

/// Sums strips on either side of boundaries.
class StripSums {
 public:
  StripSums(const DepthGrid& grid, const LabelImage& labels, LabelPairs<BoundaryStrips>& strips)
      : grid_(grid), labels_(labels), strips_(strips) {}

  /// Looks from pixel (u, v) and its neighbour (u + du, v + dv) into their labels.
  void Look(int u, int v, int du, int dv) {
    const int a = labels_[At(u, v)], b = labels_[At(u + du, v + dv)];
    const int strip_a = Width(u, v, -du, -dv) / kStripsInWidth;
    if (strip_a < kMinStrip_px) return;
    const int strip_b = Width(u + du, v + dv, du, dv) / kStripsInWidth;
    if (strip_b < kMinStrip_px) return;
    BoundaryStrips& strips = strips_.Of(a, b);
    Add(u, v, -du, -dv, strip_a, b, a < b ? strips.low : strips.high);
    Add(u + du, v + dv, du, dv, strip_b, a, a < b ? strips.high : strips.low);
  }

 private:
  std::size_t At(int u, int v) const { return static_cast<std::size_t>(grid_.Index(u, v)); }

  /// Pixels from (u, v) on that have its label, but for small holes.
  int Width(int u, int v, int du, int dv) const {
    const int label = labels_[At(u, v)];
    int width = 1, hole = 0;
    for (int k = 1; k < kFarthest_px && hole <= kHole_px; ++k) {
      const int x = u + k * du, y = v + k * dv;
      if (x < 0 || y < 0 || x >= grid_.width || y >= grid_.height) break;
      hole = labels_[At(x, y)] == label ? 0 : hole + 1;
      if (hole == 0) width = k + 1;
    }
    return width;
  }

  /// Adds the pixels of a strip. Where two planes cross, a pixel's label depends on its noise,
  /// so those of the other label count as well.
  void Add(int u, int v, int du, int dv, int strip, int other, PlaneSums& sums) const {
    const int label = labels_[At(u, v)];
    for (int k = kNearest_px; k < strip; ++k) {
      const std::size_t i = At(u + k * du, v + k * dv);
      if (labels_[i] != label && labels_[i] != other) continue;
      AddPixel(grid_, i, sums);
    }
  }

  const DepthGrid& grid_;
  const LabelImage& labels_;
  LabelPairs<BoundaryStrips>& strips_;
};

Eigen::Matrix3d Covariance(const PlaneSums& s, double grazing, const DepthNoise& noise) {
  Eigen::Matrix3d information;
  information << s.wxx, s.wxy, s.wx, s.wxy, s.wyy, s.wy, s.wx, s.wy, s.w;
  return information.inverse() * (grazing * grazing * noise.correlated_px);
}

Eigen::Vector3d Difference(const InverseDepthPlane& p, const InverseDepthPlane& r) {
  return {p.a - r.a, p.b - r.b, p.c - r.c};
}

}  // namespace

void MeasureShares(const DepthGrid& grid, const LabelImage& labels, const LabelRuns& runs,
                   const std::vector<LabelPlane>& planes, const DepthNoise& noise,
                   LabelPairs<BoundaryStrips>& strips_of, BoundaryShares& shares) {
  // The pixels of the strips along every common boundary.
  const int label_count = static_cast<int>(planes.size());
  strips_of.Clear(label_count), shares.Clear(label_count);
  StripSums sums(grid, labels, strips_of);
  VisitContacts(runs, [&](int u, int v, int du, int dv) { sums.Look(u, v, du, dv); });

  // How much of the difference between whole labels the strips show, weighted by how well
  // noise lets them.
  for (const auto& [pair, strips] : strips_of.Sorted()) {
    const std::optional<PlaneFit> low = Fit(strips.low), high = Fit(strips.high);
    if (!low || !high) continue;
    const LabelPlane &A = planes[static_cast<std::size_t>(pair.first)],
                     &B = planes[static_cast<std::size_t>(pair.second)];
    const Eigen::Vector3d whole = Difference(A.plane, B.plane);
    const Eigen::Vector3d here = Difference(low->plane, high->plane);
    const Eigen::Matrix3d cov =
        Covariance(strips.low, A.grazing, noise) + Covariance(strips.high, B.grazing, noise);
    const Eigen::Vector3d weighed = cov.inverse() * whole;
    const double information = whole.dot(weighed);
    if (!(information > 0.0)) continue;
    shares.Of(pair.first, pair.second) = {here.dot(weighed) / information,
                                          1.0 / std::sqrt(information)};
  }
}

}  // namespace slam
