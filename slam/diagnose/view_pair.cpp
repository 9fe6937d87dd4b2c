#include "slam/diagnose/view_pair.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <utility>

#include "slam/base/median.h"
#include "slam/geometry/camera.h"

namespace slam {
namespace {

constexpr int kFitSteps = 3;  // Gauss-Newton; each fit begins at the last one

// Spreads below which noise is not believed to be: half of what a subpixel fit resolves, and
// half a millimetre at a metre.
constexpr double kMinSpread_px = 0.2, kMinSpread_per_m = 5e-4;
// Points spread wider than that are not one motion's, even by a camera that is very wrong.
constexpr double kMaxSpread_px = 10.0;
// Residuals above the first count linearly (Huber), those above the second not at all.
constexpr double kHuber_sigmas = 2.0, kLeaveOut_sigmas = 8.0;

// Sigmas: colour cameras read an image out in up to 33 ms, and depth is taken within 20 ms of
// it.
constexpr double kReadOut_s = 0.015, kDepthLate_s = 0.010;

}  // namespace

/// Normal equations over pose, effects and intrinsics.
struct ViewPair::System {
  Eigen::Matrix<double, kUnknowns, kUnknowns> H =
      Eigen::Matrix<double, kUnknowns, kUnknowns>::Zero();
  Eigen::Matrix<double, kUnknowns, 1> g = Eigen::Matrix<double, kUnknowns, 1>::Zero();
  std::size_t points = 0;  ///< number of points that were not left out
  double spread_px = 0.0;
};

/// Sigmas of a residual of scale 1, and of the effects.
struct ViewPair::Spread {
  double position_px = 0.0, inverse_depth = 0.0;
  Effects effects;
};

/// A point in both views.
struct ViewPair::Geometry {
  Eigen::Vector3d ray_1, p_1;            ///< K^-1(first), and it at its depth
  Eigen::Vector3d p_2;                   ///< T_21 p_1
  double x_2 = 0.0, y_2 = 0.0;           ///< K^-1(second)
  double inv_z = 0.0, x = 0.0, y = 0.0;  ///< p_2: 1/z, x/z, y/z
  Eigen::Matrix3d by_p_2;                ///< derivative of the residual by p_2
};

ViewPair::ViewPair(std::vector<TwiceSeen> points, const Pose& T_21, const ViewMotion& motion)
    : points_(std::move(points)), T_21_(T_21), motion_(motion) {}

ViewPair::Geometry ViewPair::At(const TwiceSeen& point, const Intrinsics& at) const {
  const double fx = at[0], fy = at[1];
  Geometry g;
  g.ray_1 = {(point.first_u_px.x() - at[2]) / fx, (point.first_u_px.y() - at[3]) / fy, 1.0};
  g.p_1 = point.first_z_m * g.ray_1;
  g.p_2 = T_21_ * g.p_1;
  g.x_2 = (point.second_u_px.x() - at[2]) / fx;
  g.y_2 = (point.second_u_px.y() - at[3]) / fy;
  g.inv_z = 1.0 / std::max(g.p_2.z(), kMinProjectedDepth_m);
  g.x = g.p_2.x() * g.inv_z;
  g.y = g.p_2.y() * g.inv_z;
  g.by_p_2 << fx * g.inv_z, 0, -fx * g.x * g.inv_z,  //
      0, fy * g.inv_z, -fy * g.y * g.inv_z,          //
      0, 0, -g.inv_z * g.inv_z;
  return g;
}

/// Derivatives of the residual by the effects. Columns: inverse depth times 1, x, y; skew of u,
/// of v; seconds from the first row to the last; seconds that depth is late.
ViewPair::ByEffects ViewPair::EffectsOf(const TwiceSeen& point, const Geometry& g) const {
  const auto speed = [](const Vector6d& xi, const Eigen::Vector3d& p) -> Eigen::Vector3d {
    return xi.head<3>() + xi.tail<3>().cross(p);
  };
  const Eigen::Vector3d speed_1 = speed(motion_.first_per_s, g.p_1);
  const Eigen::Vector3d speed_2 = speed(motion_.second_per_s, g.p_2);
  const double row_1 = point.first_u_px.y() / motion_.height_px - 0.5;
  const double row_2 = point.second_u_px.y() / motion_.height_px - 0.5;
  const double inv_z_2 = 1.0 / point.second_z_m;
  ByEffects by;
  by.leftCols<5>() << 0, 0, 0, g.y_2, 0,  //
      0, 0, 0, 0, g.y_2,                  //
      inv_z_2, inv_z_2 * g.x_2, inv_z_2 * g.y_2, 0, 0;
  by.col(5) = g.by_p_2 * (row_2 * speed_2 - row_1 * (T_21_.R * speed_1));
  by.col(6) = g.by_p_2 * (T_21_.R * (-speed_1.z() * g.ray_1));
  by(2, 6) -= speed_2.z() * inv_z_2 * inv_z_2;
  return by;
}

Eigen::Vector3d ViewPair::Residual(const TwiceSeen& point, const Intrinsics& at,
                                   Rows* rows) const {
  const Geometry g = At(point, at);
  const ByEffects by_effects = EffectsOf(point, g);
  const double weight = 1.0 / point.scale;
  if (rows != nullptr) {
    // Derivatives by the pose (translation, rotation), the effects, and fx, fy, cx, cy.
    const Eigen::Matrix3d by_p_1 = g.by_p_2 * T_21_.R * point.first_z_m;
    rows->leftCols<3>() = g.by_p_2;
    rows->middleCols<3>(3) = -g.by_p_2 * Hat(g.p_2);
    rows->middleCols<kEffects>(6) = by_effects;
    auto by_intrinsics = rows->rightCols<4>();
    by_intrinsics.col(0) =
        -g.ray_1.x() / at[0] * by_p_1.col(0) + g.x * Eigen::Vector3d::UnitX();
    by_intrinsics.col(1) =
        -g.ray_1.y() / at[1] * by_p_1.col(1) + g.y * Eigen::Vector3d::UnitY();
    by_intrinsics.col(2) = -1.0 / at[0] * by_p_1.col(0) + Eigen::Vector3d::UnitX();
    by_intrinsics.col(3) = -1.0 / at[1] * by_p_1.col(1) + Eigen::Vector3d::UnitY();
    *rows *= weight;
  }
  const Eigen::Vector3d residual(at[0] * (g.x - g.x_2), at[1] * (g.y - g.y_2),
                                 g.inv_z - 1.0 / point.second_z_m);
  return weight * (residual + by_effects * effects_);
}

ViewPair::Spread ViewPair::SpreadOf(const std::vector<Eigen::Vector3d>& residuals) const {
  std::vector<double> positions, inverse_depths, measured;
  positions.reserve(2 * residuals.size());
  for (const Eigen::Vector3d& r : residuals) {
    positions.push_back(std::abs(r.x()));
    positions.push_back(std::abs(r.y()));
    inverse_depths.push_back(std::abs(r.z()));
  }
  for (const TwiceSeen& point : points_) measured.push_back(1.0 / point.second_z_m);
  Spread spread;
  spread.position_px =
      std::max(kSigmaOverMad * UpperMedian(std::move(positions)), kMinSpread_px);
  spread.inverse_depth =
      std::max(kSigmaOverMad * UpperMedian(std::move(inverse_depths)), kMinSpread_per_m);
  const double relative = spread.inverse_depth / UpperMedian(std::move(measured));
  spread.effects << relative, relative, relative, spread.position_px, spread.position_px,
      kReadOut_s, kDepthLate_s;
  return spread;
}

ViewPair::System ViewPair::Linearise(const Intrinsics& at) const {
  // The residuals give the scale of their own noise.
  std::vector<Eigen::Vector3d> residuals;
  residuals.reserve(points_.size());
  for (const TwiceSeen& point : points_) residuals.push_back(Residual(point, at, nullptr));
  const Spread spread = SpreadOf(residuals);
  System system;
  system.spread_px = spread.position_px;
  const Eigen::Vector3d whiten(1.0 / spread.position_px, 1.0 / spread.position_px,
                               1.0 / spread.inverse_depth);
  // Robust normal equations.
  Rows rows;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const Eigen::Vector3d r = whiten.cwiseProduct(residuals[i]);
    const double e = r.norm();
    if (!(e < kLeaveOut_sigmas)) continue;
    const double weight = e > kHuber_sigmas ? kHuber_sigmas / e : 1.0;
    Residual(points_[i], at, &rows);
    rows = whiten.asDiagonal() * rows;
    system.H.noalias() += weight * rows.transpose() * rows;
    system.g.noalias() += weight * rows.transpose() * r;
    ++system.points;
  }
  // Each effect is expected to be near 0.
  for (int k = 0; k < kEffects; ++k) {
    const double information = 1.0 / (spread.effects[k] * spread.effects[k]);
    system.H(6 + k, 6 + k) += information;
    system.g[6 + k] += information * effects_[k];
  }
  return system;
}

IntrinsicsEvidence ViewPair::Evidence(const Intrinsics& at) {
  IntrinsicsEvidence evidence;
  if (points_.size() < kMinPoints) return evidence;
  // Fit pose and effects for these intrinsics.
  System system = Linearise(at);
  for (int step = 0; step < kFitSteps; ++step) {
    if (system.points < kMinPoints) return evidence;
    const Eigen::Matrix<double, kOthers, 1> move =
        system.H.topLeftCorner<kOthers, kOthers>().ldlt().solve(-system.g.head<kOthers>());
    if (!move.allFinite()) return evidence;
    T_21_ = Normalised(Exp(Vector6d(move.head<6>())) * T_21_);
    effects_ += move.tail<kEffects>();
    system = Linearise(at);
  }
  if (system.points < kMinPoints || !(system.spread_px < kMaxSpread_px)) return evidence;
  // Eliminate them (Schur complement): what is left speaks of the intrinsics alone.
  const Eigen::Matrix<double, kOthers, 4> across = system.H.topRightCorner<kOthers, 4>();
  const auto others = system.H.topLeftCorner<kOthers, kOthers>().ldlt();
  evidence.information =
      system.H.bottomRightCorner<4, 4>() - across.transpose() * others.solve(across);
  evidence.gradient =
      system.g.tail<4>() - across.transpose() * others.solve(system.g.head<kOthers>());
  evidence.usable = evidence.information.allFinite() && evidence.gradient.allFinite();
  return evidence.usable ? evidence : IntrinsicsEvidence{};
}

}  // namespace slam
