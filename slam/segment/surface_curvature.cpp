#include "slam/segment/surface_curvature.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "slam/geometry/plane_sums.h"

namespace slam {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

constexpr double kLookedAt_px = 150.0;  // at least; errors of neighbours are one anyway
constexpr int kMinPixels = 30;          // for six parameters
constexpr int kDirections = 8;          // 22.5 degrees apart: a cylinder's is met to 4 %

/// A surface over its plane is told by six numbers: 1, s, t, s^2, st, t^2 of the place in the plane.
struct QuadricSums {
  Matrix6 squares = Matrix6::Zero();
  Vector6 heights = Vector6::Zero();
  int count = 0;

  void Add(const Eigen::Vector2d& at, double height, double weight) {
    Vector6 terms;
    terms << 1.0, at.x(), at.y(), at.x() * at.x(), at.x() * at.y(), at.y() * at.y();
    squares.noalias() += weight * terms * terms.transpose();
    heights += weight * height * terms;
    ++count;
  }
};

}  // namespace

SurfaceCurvature MeasureCurvature(const DepthGrid& grid, const cv::Mat1b& labels,
                                  const cv::Rect& bounds, const FramePlane& plane,
                                  const DepthNoise& noise) {
  // Heights over the plane, as a function of the place in it.
  const int step = std::max(1, static_cast<int>(std::sqrt(plane.pixel_count / kLookedAt_px)));
  const double area_m2 = plane.area_m2, scale_m = std::sqrt(area_m2);
  const Eigen::Matrix<double, 3, 2> axes = TangentBasis(plane.pi_c.n);
  const double grazing = GrazingFactor(plane.centroid_c, SeenAlongRays(plane.pi_c), noise);
  QuadricSums sums;
  for (int v = bounds.y; v < bounds.y + bounds.height; v += step) {
    for (int u = bounds.x; u < bounds.x + bounds.width; u += step) {
      if (labels(v, u) != plane.index + 1) continue;
      const auto i = static_cast<std::size_t>(grid.Index(u, v));
      const double z = 1.0 / static_cast<double>(grid.q[i]);
      const Eigen::Vector3d ray(static_cast<double>(grid.x[i]), static_cast<double>(grid.y[i]),
                                1.0);
      const Eigen::Vector2d at = axes.transpose() * (ray * z - plane.centroid_c) / scale_m;
      const double sigma_m =
          std::abs(plane.pi_c.n.dot(ray)) * z * z / static_cast<double>(grid.g[i]) * grazing;
      sums.Add(at, SignedDistance(plane.pi_c, ray * z), 1.0 / (sigma_m * sigma_m));
    }
  }
  if (sums.count < kMinPixels) return {};
  const Eigen::LDLT<Matrix6> solver(sums.squares);
  if (solver.info() != Eigen::Success || !solver.isPositive()) return {};
  const Vector6 surface = solver.solve(sums.heights);
  const Matrix6 covariance = solver.solve(Matrix6::Identity());
  const double shared = std::max(1.0, sums.count * noise.correlated_px / plane.pixel_count);

  // The direction in which it is surest.
  SurfaceCurvature best;
  for (int k = 0; k < kDirections; ++k) {
    const double angle = std::numbers::pi * k / kDirections;
    const double c = std::cos(angle), s = std::sin(angle);
    const Eigen::Vector3d second(2 * c * c, 2 * c * s, 2 * s * s);
    const double variance = second.dot(covariance.bottomRightCorner<3, 3>() * second) * shared;
    if (!(variance > 0)) return {};
    const SurfaceCurvature now{std::abs(second.dot(surface.tail<3>())) / area_m2,
                               std::sqrt(variance) / area_m2};
    if (k == 0 || now.Surely_per_m() > best.Surely_per_m()) best = now;
  }
  return best;
}

}  // namespace slam
