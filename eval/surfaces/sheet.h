#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "eval/planes/polygon.h"
#include "eval/surfaces/depth_views.h"
#include "eval/surfaces/grow_planes.h"
#include "eval/surfaces/local_normals.h"

namespace eval {

/// What all views saw at the cells of one plane: a map of heights over it, and where they
/// looked through it.
struct Sheet {
  /// A pixel of a first Kinect at 5 m; a phone has 7 x 15.
  static constexpr double kCell_m = 0.01;

  Plane pi_g;
  PlaneChart chart_g;           ///< origin at the middle of cell (0, 0)
  cv::Mat1b near;               ///< cells that the fused cloud holds or nearly so
  cv::Mat1i hits;               ///< points that lie on the plane, within their tolerance
  cv::Mat1i passes;             ///< rays that went through and ended behind
  cv::Mat1d height_m, depth_m;  ///< sums over the hits, until MeanOverHits

  /// The cell of a point of the plane's chart; may lie outside.
  cv::Point CellOf(const Eigen::Vector3d& x_g) const {
    const Eigen::Vector2d uv = chart_g(x_g) / kCell_m;
    return {int(std::lround(uv.x())), int(std::lround(uv.y()))};
  }
  bool Holds(const cv::Point& cell) const {
    return cell.x >= 0 && cell.y >= 0 && cell.x < hits.cols && cell.y < hits.rows;
  }
};

/// An empty sheet over the patch.
Sheet SheetOver(const PlanePatch& patch);

/// Adds a view to all sheets. A pixel with depth goes to the plane that it lies on best, and
/// tells of every plane before it that there is nothing.
void AddToSheets(const DepthView& view, const cv::Mat2d& rays, const LocalNormals& local,
                 int stride, double noise_per_m, std::vector<Sheet>& sheets);

/// Turns the sums of heights and depths into means.
void MeanOverHits(Sheet& sheet);

}  // namespace eval
