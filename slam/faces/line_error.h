#pragma once

#include <Eigen/Core>
#include <vector>

namespace slam {

/// How well a straight line in the image is known: by how much it may be moved across itself
/// at one of its points, and turned about it. The two are independent there.
struct LineError {
  Eigen::Vector2d at_px = Eigen::Vector2d::Zero();   ///< on the line, ideal image
  Eigen::Vector2d along = Eigen::Vector2d::UnitX();  ///< unit direction
  double offset_px2 = 0.0;                           ///< variance across the line
  double angle_rad2 = 0.0;                           ///< variance of the direction

  /// Variance across the line at the point of it nearest to u_px, pixels^2: grows with the
  /// square of the lever arm.
  double Variance(const Eigen::Vector2d& u_px) const {
    const double lever_px = along.dot(u_px - at_px);
    return offset_px2 + lever_px * lever_px * angle_rad2;
  }
};

/// Error of a least-squares line through the boundary pixels of a segment.
///
/// Two parts. Scatter: the residuals' variance over the number of points that are independent,
/// with the residuals' own correlation along the line (a sensor's window and the vote between
/// planes move neighbours together). Rounding: a contour runs through whole pixels, so a side
/// that stays in one row may lie anywhere in it, however many pixels agree; scatter dithers
/// this away, and so does a side that crosses many rows.
///
/// @param points_px  on the line in order along it, at least 2
/// @param p_px, v    the line fitted to them: their mean, unit direction
LineError MeasureLineError(const std::vector<Eigen::Vector2d>& points_px,
                           const Eigen::Vector2d& p_px, const Eigen::Vector2d& v);

}  // namespace slam
