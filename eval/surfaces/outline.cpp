#include "eval/surfaces/outline.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <utility>
#include <vector>

namespace eval {
namespace {

constexpr int kZoom = 4;  // an outline runs along cells' borders, to a quarter of a cell
constexpr double kCornerSlack = 0.75;  // of a cell, that corners which are left out may lie off
constexpr double kMinHole_cells = 8;   // smaller ones are gaps of sampling, no things

/// Plane through the cells' heights by least squares, in the chart: h = a u + b v + c.
Eigen::Vector3d FitHeights(const Sheet& sheet, const CellMask& mask, double& rms_m) {
  Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
  Eigen::Vector3d y = Eigen::Vector3d::Zero();
  double squares = 0.0;
  int cells = 0;
  for (int v = 0; v < mask.rows; ++v) {
    for (int u = 0; u < mask.cols; ++u) {
      if (mask(v, u) == 0 || sheet.hits(v, u) == 0) continue;
      const Eigen::Vector3d x(u * Sheet::kCell_m, v * Sheet::kCell_m, 1.0);
      const double h = sheet.height_m(v, u);
      A += x * x.transpose();
      y += h * x;
      squares += h * h;
      ++cells;
    }
  }
  Eigen::Vector3d abc = A.ldlt().solve(y);
  rms_m = std::sqrt(std::max(0.0, squares - abc.dot(y)) / cells);
  return abc;
}

Polygon2 InMetres(const std::vector<cv::Point>& contour) {
  Polygon2 polygon;
  for (const cv::Point& corner : contour) {
    // Cell c covers the zoomed pixels kZoom c to kZoom c + kZoom - 1; its middle is c.
    polygon.emplace_back(((corner.x + 0.5) / kZoom - 0.5) * Sheet::kCell_m,
                         ((corner.y + 0.5) / kZoom - 0.5) * Sheet::kCell_m);
  }
  return polygon;
}

void AddOutlines(const CellMask& mask, Surface& surface) {
  cv::Mat1b large;
  cv::resize(mask, large, {}, kZoom, kZoom, cv::INTER_NEAREST);
  std::vector<std::vector<cv::Point>> contours;
  std::vector<cv::Vec4i> hierarchy;
  cv::findContours(large, contours, hierarchy, cv::RETR_CCOMP, cv::CHAIN_APPROX_NONE);
  for (std::size_t i = 0; i < contours.size(); ++i) {
    const bool is_hole = hierarchy[i][3] >= 0;
    std::vector<cv::Point> corners;
    cv::approxPolyDP(contours[i], corners, kCornerSlack * kZoom, true);
    if (corners.size() < 3) continue;
    if (cv::contourArea(corners) < kMinHole_cells * kZoom * kZoom) continue;
    (is_hole ? surface.holes : surface.outlines).push_back(InMetres(corners));
  }
}

}  // namespace

Surface OutlinedSurface(const Sheet& sheet, const CellMask& mask) {
  Surface surface;
  const Eigen::Vector3d abc = FitHeights(sheet, mask, surface.flatness_m);
  const PlaneChart& chart = sheet.chart_g;
  const Eigen::Vector3d n_g =
      (sheet.pi_g.n - abc[0] * chart.axis_u - abc[1] * chart.axis_v).normalized();
  const Eigen::Vector3d origin_g = chart.origin + abc[2] * sheet.pi_g.n;
  const Eigen::Vector3d u_g = (chart.axis_u - n_g.dot(chart.axis_u) * n_g).normalized();
  surface.pi_g = {n_g, -n_g.dot(origin_g)};
  surface.chart_g = {origin_g, u_g, n_g.cross(u_g)};

  CellMask closed;
  cv::copyMakeBorder(mask, closed, 1, 1, 1, 1, cv::BORDER_CONSTANT, 0);
  cv::morphologyEx(closed, closed, cv::MORPH_CLOSE, cv::Mat::ones(3, 3, CV_8U));
  AddOutlines(closed(cv::Rect({1, 1}, mask.size())), surface);
  return surface;
}

SurfaceArea::SurfaceArea(const Surface& surface) : chart_g_(surface.chart_g) {
  constexpr double kInf = std::numeric_limits<double>::infinity();
  Eigen::Vector2d min(kInf, kInf), max = -min;
  for (const Polygon2& outline : surface.outlines) {
    for (const Eigen::Vector2d& corner : outline) {
      min = min.cwiseMin(corner);
      max = max.cwiseMax(corner);
    }
  }
  corner_m_ = min;
  const Eigen::Vector2d size = (max - min) / kRaster_m;
  raster_ =
      cv::Mat1b(int(std::ceil(size.y())) + 1, int(std::ceil(size.x())) + 1, std::uint8_t(0));
  constexpr int kShift = 4;  // OpenCV fills at 1/16 pixel
  const auto fill = [&](const Polygon2& polygon, int value) {
    std::vector<cv::Point> corners;
    for (const Eigen::Vector2d& corner : polygon) {
      const Eigen::Vector2d at = (corner - min) / kRaster_m * (1 << kShift);
      corners.emplace_back(cvRound(at.x()), cvRound(at.y()));
    }
    cv::fillPoly(raster_, std::vector<std::vector<cv::Point>>{corners}, cv::Scalar(value),
                 cv::LINE_8, kShift);
  };
  std::vector<std::pair<const Polygon2*, int>> loops;
  for (const Polygon2& outline : surface.outlines) loops.emplace_back(&outline, 255);
  for (const Polygon2& hole : surface.holes) loops.emplace_back(&hole, 0);
  // The largest first: an outline may lie in a hole, and has holes of its own.
  std::stable_sort(loops.begin(), loops.end(), [](const auto& a, const auto& b) {
    return Area(*a.first) > Area(*b.first);
  });
  for (const auto& [polygon, value] : loops) fill(*polygon, value);
}

}  // namespace eval
