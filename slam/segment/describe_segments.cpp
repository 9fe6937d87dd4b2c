#include "slam/segment/describe_segments.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "slam/base/index.h"
#include "slam/segment/edges/plane_edges.h"
#include "slam/segment/roughness.h"
#include "slam/segment/surface_curvature.h"

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

/// Thinned points and the visible area of each plane. A pixel of dx dy on the ray plane covers
/// |(a, b, c)| / q^3 dx dy of the surface.
void SamplePoints(const DepthGrid& grid, const cv::Mat1b& labels, int point_grid_px,
                  const std::vector<Segment>& segments, std::vector<FramePlane>& planes) {
  for (int v = 0; v < labels.rows; v += point_grid_px) {
    const std::uint8_t* row = labels[v];
    for (int u = 0; u < labels.cols; u += point_grid_px) {
      if (row[u] == 0) continue;
      const auto k = static_cast<std::size_t>(row[u] - 1);
      const auto i = static_cast<std::size_t>(grid.Index(u, v));
      const double x = static_cast<double>(grid.x[i]), y = static_cast<double>(grid.y[i]);
      const double z = 1.0 / static_cast<double>(grid.q[i]);
      planes[k].points_c.emplace_back(x * z, y * z, z);
      const InverseDepthPlane& p = segments[k].plane.plane;
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

}  // namespace

std::vector<FramePlane> DescribeSegments(const DepthGrid& grid, const cv::Mat1b& labels,
                                         const std::vector<Segment>& segments,
                                         const DepthNoise& noise,
                                         const PlaneExtractionConfig& config) {
  // Parameters, precision and roughness of each segment.
  std::vector<FramePlane> planes;
  for (const Segment& segment : segments) {
    FramePlane plane = MakeFramePlane(segment, static_cast<int>(planes.size()));
    plane.roughness = MeasureRoughness(
        grid, labels, segment.bounds, static_cast<std::uint8_t>(plane.index + 1),
        segment.plane.plane, noise, RoughnessStep(plane.pixel_count));
    planes.push_back(std::move(plane));
  }

  // Where each of them ends depends on the areas of the others (min_rising_area).
  SamplePoints(grid, labels, config.point_grid_px, segments, planes);
  std::vector<double> areas_m2;
  for (const FramePlane& plane : planes) areas_m2.push_back(plane.area_m2);
  for (FramePlane& plane : planes) {
    const Segment& segment = segments[Index(plane.index)];
    plane.curvature = MeasureCurvature(grid, labels, segment.bounds, plane, noise);
    plane.edge_points = FindEdgePoints(grid, labels, segment.bounds, plane.index + 1,
                                       segment.plane, areas_m2, config.edges);
    for (const EdgePoint& point : plane.edge_points) plane.box_px.Include(point.u_px);
  }
  return planes;
}

}  // namespace slam
