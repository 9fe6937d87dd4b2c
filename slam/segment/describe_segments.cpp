#include <algorithm>
#include <cmath>
#include <utility>

#include "slam/base/index.h"
#include "slam/segment/edges/plane_edges.h"
#include "slam/segment/plane_workspace.h"
#include "slam/segment/roughness.h"

namespace slam {
namespace {

/// About a thousand pixels say how rough a segment is, to a few per cent (sqrt(2 / 1000)).
int RoughnessStep(int pixels) {
  constexpr double kEnough_px = 1000.0;
  constexpr int kMaxRoughnessStep_px = 8;  // a larger one would miss segments that are narrow
  return std::clamp(static_cast<int>(std::sqrt(pixels / kEnough_px)), 1, kMaxRoughnessStep_px);
}

FramePlane MakeFramePlane(const Segment& segment, int index) {
  FramePlane out;
  out.index = index;
  out.pi_c = segment.plane.plane.Hessian();
  const Eigen::Vector3d ray(segment.sums.wx / segment.sums.w, segment.sums.wy / segment.sums.w,
                            1.0);
  out.centroid_c = ray / segment.plane.plane.InverseDepth(ray.x(), ray.y());
  out.pixel_count = static_cast<int>(segment.sums.n);
  out.offset_sigma_m = segment.sigmas.offset_m;
  out.angle_sigma_rad = segment.sigmas.angle_rad;
  out.inverse_depth_covariance = segment.sigmas.covariance;
  return out;
}

/// What a pixel covers on the plane z = 1, lens and all.
double RayArea(const DepthGrid& grid, int u, int v) {
  const int u0 = std::max(u - 1, 0), u1 = std::min(u + 1, grid.width - 1);
  const int v0 = std::max(v - 1, 0), v1 = std::min(v + 1, grid.height - 1);
  const auto at = [&](int x, int y) {
    const auto i = static_cast<std::size_t>(grid.Index(x, y));
    return Eigen::Vector2d(static_cast<double>(grid.x[i]), static_cast<double>(grid.y[i]));
  };
  const Eigen::Vector2d along = (at(u1, v) - at(u0, v)) / std::max(u1 - u0, 1);
  const Eigen::Vector2d down = (at(u, v1) - at(u, v0)) / std::max(v1 - v0, 1);
  return std::abs(along.x() * down.y() - along.y() * down.x());
}

}  // namespace

/// Thinned points and the visible area of each plane. A pixel of dx dy on the ray plane covers
/// |(a, b, c)| / q^3 dx dy of the surface.
void PlaneExtractor::Workspace::SamplePoints(const cv::Mat1b& drawn,
                                             std::vector<FramePlane>& planes) {
  for (int v = 0; v < drawn.rows; v += config.point_grid_px) {
    const std::uint8_t* row = drawn[v];
    for (int u = 0; u < drawn.cols; u += config.point_grid_px) {
      if (row[u] == 0) continue;
      const auto k = static_cast<std::size_t>(row[u] - 1);
      const auto i = static_cast<std::size_t>(grid.Index(u, v));
      const double x = static_cast<double>(grid.x[i]), y = static_cast<double>(grid.y[i]);
      const double z = 1.0 / static_cast<double>(grid.q[i]);
      planes[k].points_c.emplace_back(x * z, y * z, z);
      const InverseDepthPlane& p = kept[k].plane.plane;
      const double q = p.InverseDepth(x, y),
                   norm = std::sqrt(p.a * p.a + p.b * p.b + p.c * p.c);
      planes[k].area_m2 += norm / (q * q * q) * RayArea(grid, u, v);
    }
  }
  for (FramePlane& plane : planes) {
    const auto count = static_cast<double>(plane.points_c.size());
    if (count > 0) plane.area_m2 = plane.area_m2 / count * plane.pixel_count;
  }
}

/// Fills the frame's planes from the segments that are kept and its label image.
void PlaneExtractor::Workspace::Describe(Frame& frame) {
  // Parameters, precision and roughness of each segment.
  contours.Trace(frame.plane_labels);
  frame.planes.clear();
  for (std::size_t k = 0; k < kept.size(); ++k) {
    FramePlane plane = MakeFramePlane(kept[k], static_cast<int>(k));
    plane.roughness = MeasureRoughness(
        grid, frame.plane_labels, cv::Rect(kept[k].low, kept[k].high + cv::Point(1, 1)),
        static_cast<std::uint8_t>(plane.index + 1), kept[k].plane.plane, sensor.noise,
        RoughnessStep(plane.pixel_count));
    frame.planes.push_back(std::move(plane));
  }

  // Where each of them ends depends on the areas of the others (min_rising_area).
  SamplePoints(frame.plane_labels, frame.planes);
  std::vector<double> areas_m2;
  for (const FramePlane& plane : frame.planes) areas_m2.push_back(plane.area_m2);
  for (FramePlane& plane : frame.planes) {
    FindEdgePoints(grid, contours, plane.index + 1, kept[Index(plane.index)].plane, areas_m2,
                   config.edges, plane.edge_points);
    for (const EdgePoint& point : plane.edge_points) plane.box_px.Include(point.u_px);
  }
}

}  // namespace slam
