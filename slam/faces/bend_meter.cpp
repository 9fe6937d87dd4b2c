#include "slam/faces/bend_meter.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace slam {
namespace {

constexpr int kCell_px = 24;  // at a width of 640: one bend's length
constexpr int kFullWidth_px = 640;
constexpr int kStride_px = 2;       // neighbours say the same of a bend
constexpr double kMinFilled = 0.8;  // of a cell: one at an edge holds the edge's own errors
// A plane takes up the bends of a few cells; of a dozen it leaves three quarters.
constexpr int kMinCells = 12;
constexpr double kPriorCells = 48.0;  // what a sensor usually does: a tenth of one frame
constexpr double kKept = 0.99;  // a frame: some seconds; straightening may begin at any time

}  // namespace

BendSigmas SigmasOfBend(double ratio, const Plane& pi_c, const Eigen::Vector3d& centroid_c,
                        double solid_angle_rad2) {
  constexpr double kVarianceOfLine = 12.0;  // a uniform line of width w has variance w^2 / 12
  constexpr double kLength2 = kBendLength_rad * kBendLength_rad;
  // A Gaussian correlation of length L makes 2 pi L^2 one independent piece.
  const double pieces = 1.0 + solid_angle_rad2 / (2.0 * std::numbers::pi * kLength2);
  const double slope2 = kLength2 + solid_angle_rad2 * pieces / kVarianceOfLine;
  // A radian of view is z of the plane's own length across the slant, more along it. The second
  // derivative of such a field has variance 3 / L^4; what a wide patch averages is not taken off.
  const double bend_m = ratio * std::abs(pi_c.d), z = centroid_c.z();
  return {bend_m / std::sqrt(pieces), bend_m / z / std::sqrt(slope2),
          std::sqrt(3.0) * bend_m / (kLength2 * z * z)};
}

BendMeter::BendMeter(const cv::Mat2d& rays, const SensorModel& sensor)
    : rays_(rays),
      noise_(sensor.noise),
      unseen_(sensor.unseen_ratio),
      cells_(kPriorCells),
      squares_(kPriorCells * sensor.bend_ratio * sensor.bend_ratio) {
  const int u = rays.cols / 2, v = rays.rows / 2;
  if (rays.cols < 2 || rays.rows < 2) return;
  pixel_rad2_ =
      std::abs((rays(v, u)[0] - rays(v, u - 1)[0]) * (rays(v, u)[1] - rays(v - 1, u)[1]));
}

/// The squared mean deviation of a plane over a cell, as a part of the inverse depth, less what noise
/// makes of it; none where the plane does not fill the cell.
std::optional<double> BendMeter::SquareIn(const cv::Rect& cell, std::uint8_t label,
                                          const SeenPlane& seen, const Frame& frame) const {
  double count = 0.0, sum = 0.0, noise_variance = 0.0;
  for (int v = cell.y; v < cell.y + cell.height; v += kStride_px) {
    for (int u = cell.x; u < cell.x + cell.width; u += kStride_px) {
      const auto z = static_cast<double>(frame.depth_m(v, u));
      if (frame.plane_labels(v, u) != label || !(z > 0)) continue;
      const cv::Vec2d& ray = rays_(v, u);
      const double sigma = noise_.Sigma(z) / z * seen.grazing;
      count += 1;
      sum += z * seen.plane.InverseDepth(ray[0], ray[1]) - 1.0;
      noise_variance += sigma * sigma;
    }
  }
  const int side = (cell.width + kStride_px - 1) / kStride_px;
  if (!(count >= kMinFilled * side * side)) return std::nullopt;
  const double mean = sum / count;
  const double pixels = count * kStride_px * kStride_px;
  const double shared = std::max(1.0, pixels / noise_.correlated_px);
  return mean * mean - noise_variance / count / shared;
}

/// What the frame shows of each of its planes.
std::vector<BendMeter::Unevenness> BendMeter::UnevennessIn(const Frame& frame) const {
  std::vector<Unevenness> uneven(frame.planes.size());
  if (frame.planes.empty()) return uneven;  // then labels were not made either
  std::vector<SeenPlane> seen;
  for (const FramePlane& plane : frame.planes) {
    const InverseDepthPlane along_rays = SeenAlongRays(plane.pi_c);
    seen.push_back({along_rays, GrazingFactor(plane.centroid_c, along_rays, noise_)});
  }
  const int cell_px = std::max(4 * kStride_px, kCell_px * rays_.cols / kFullWidth_px);
  for (int v = 0; v + cell_px <= rays_.rows; v += cell_px) {
    for (int u = 0; u + cell_px <= rays_.cols; u += cell_px) {
      const std::uint8_t label = frame.plane_labels(v + cell_px / 2, u + cell_px / 2);
      if (label == 0 || label > seen.size()) continue;
      const std::size_t f = label - 1u;
      const auto square = SquareIn({u, v, cell_px, cell_px}, label, seen[f], frame);
      if (square) uneven[f].squares += *square, ++uneven[f].cells;
    }
  }
  return uneven;
}

void BendMeter::Measure(double left_ratio, Frame& frame) {
  double squares = 0.0;
  int cells = 0;
  for (const Unevenness& plane : UnevennessIn(frame)) {
    if (plane.cells < kMinCells) continue;
    squares += plane.squares, cells += plane.cells;
  }
  if (cells > 0) {
    squares_ = kKept * squares_ + squares;
    cells_ = kKept * cells_ + cells;
  }
  const double known_ratio = std::max(left_ratio, ratio());
  frame.bend_ratio = std::max(unseen_, known_ratio);
  for (FramePlane& plane : frame.planes) {
    const BendSigmas sigmas = SigmasOfBend(known_ratio, plane.pi_c, plane.centroid_c,
                                           plane.pixel_count * pixel_rad2_);
    plane.bend_offset_sigma_m = std::hypot(sigmas.offset_m, unseen_ * std::abs(plane.pi_c.d));
    plane.bend_angle_sigma_rad = sigmas.angle_rad;
    plane.bend_curvature_per_m = sigmas.curvature_per_m;
  }
}

}  // namespace slam
