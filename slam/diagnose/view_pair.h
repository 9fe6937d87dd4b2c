#pragma once

#include <Eigen/Core>
#include <vector>

#include "slam/geometry/pose.h"

namespace slam {

/// (fx, fy, cx, cy), pixels.
using Intrinsics = Eigen::Vector4d;

/// A point seen from two places, with depth from both; positions in the ideal image.
struct TwiceSeen {
  Eigen::Vector2d first_u_px, second_u_px;
  double first_z_m = 0.0, second_z_m = 0.0;  ///< planar depth, > 0
  double scale = 1.0;  ///< sigma of both positions together, relative to the other points
};

/// What two views say of the intrinsics alone, linearised: half the cost of intrinsics K + d is
///   d . gradient + d . information d / 2 + const,
/// with everything else (the pose between the views, see ViewPair) chosen for the best.
struct IntrinsicsEvidence {
  Eigen::Matrix4d information = Eigen::Matrix4d::Zero();
  Eigen::Vector4d gradient = Eigen::Vector4d::Zero();
  bool usable = false;  ///< enough points agree on one motion; otherwise all is zero
};

/// How the camera moved while it took the two views.
struct ViewMotion {
  /// d T_cw / dt = xi^ T_cw, a second; zero when not known.
  Vector6d first_per_s = Vector6d::Zero(), second_per_s = Vector6d::Zero();
  double height_px = 480.0;  ///< rows that a rolling shutter reads one after the other
};

/// Two views of the same points. They agree on one rigid motion only for the right intrinsics,
/// if the camera has turned: from translation alone any intrinsics fit, with a scene that is
/// stretched or sheared. The residual of a point, with (x, y, z) = T_21 K^-1(first),
///   ( fx x/z + cx - u,  fy y/z + cy - v,  1/z - 1/z_measured ),
/// is weighed by its own spread (median, Huber). To the pose are added errors that are
/// smooth over the image, each expected as large as the noise or as its own cause is: skew of u and v
/// with the row, as of a rolling shutter, inverse depth that is off by a factor affine in the image,
/// and, where the camera's speed is known, the time that rows are read in and by which depth is late.
class ViewPair {
 public:
  static constexpr std::size_t kMinPoints = 30;  ///< 90 residuals for 17 unknowns

  /// @param T_21  first guess of the motion: takes the first camera's coordinates to the
  ///   second's
  ViewPair(std::vector<TwiceSeen> points, const Pose& T_21, const ViewMotion& motion);

  /// Fits the motion for these intrinsics, from the last fit, then eliminates it.
  IntrinsicsEvidence Evidence(const Intrinsics& at);

 private:
  static constexpr int kEffects = 7;             ///< see EffectsOf
  static constexpr int kOthers = 6 + kEffects;   ///< unknowns that are not intrinsics
  static constexpr int kUnknowns = kOthers + 4;  ///< pose, effects, intrinsics
  using Effects = Eigen::Matrix<double, kEffects, 1>;
  using ByEffects = Eigen::Matrix<double, 3, kEffects>;
  using Rows = Eigen::Matrix<double, 3, kUnknowns>;
  struct Geometry;
  struct System;
  struct Spread;

  Geometry At(const TwiceSeen& point, const Intrinsics& at) const;
  ByEffects EffectsOf(const TwiceSeen& point, const Geometry& g) const;
  Eigen::Vector3d Residual(const TwiceSeen& point, const Intrinsics& at, Rows* rows) const;
  Spread SpreadOf(const std::vector<Eigen::Vector3d>& residuals) const;
  System Linearise(const Intrinsics& at) const;

  std::vector<TwiceSeen> points_;
  Pose T_21_;
  ViewMotion motion_;
  Effects effects_ = Effects::Zero();
};

}  // namespace slam
