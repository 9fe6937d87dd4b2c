#pragma once

#include "eval/surfaces/cut_sheet.h"
#include "eval/surfaces/surface.h"

namespace eval {

/// The surface that cells of a sheet are: its plane fitted to their heights, how far they are
/// from it, and its outlines with one corner where they bend. Gaps of a cell are closed.
Surface OutlinedSurface(const Sheet& sheet, const CellMask& mask);

/// Outlines of a surface as cells, for asking whether a point lies in it.
class SurfaceArea {
 public:
  explicit SurfaceArea(const Surface& surface);
  /// Whether the foot of the point lies in an outline and in no hole of it: of the outlines and
  /// holes that go round it the smallest is an outline.
  bool Holds(const Eigen::Vector3d& x_g) const {
    const Eigen::Vector2d uv = (chart_g_(x_g) - corner_m_) / kRaster_m;
    const double u = uv.x() + 0.5, v = uv.y() + 0.5;
    return u >= 0 && v >= 0 && u < raster_.cols && v < raster_.rows &&
           raster_(int(v), int(u)) != 0;
  }

 private:
  static constexpr double kRaster_m = 0.005;  ///< half a cell of a sheet
  PlaneChart chart_g_;
  Eigen::Vector2d corner_m_;
  cv::Mat1b raster_;
};

}  // namespace eval
