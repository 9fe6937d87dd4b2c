#include "slam/faces/bend_meter.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "slam/geometry/plane_sums.h"

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

/// Residuals of one plane in one cell, as parts of the inverse depth.
struct Cell {
  double count = 0.0, sum = 0.0, noise_variance = 0.0;
};

}  // namespace

BendSigmas SigmasOfBend(double ratio, double distance_m, double solid_angle_rad2) {
  constexpr double kVarianceOfLine = 12.0;  // a uniform line of width w has variance w^2 / 12
  constexpr double kLength2 = kBendLength_rad * kBendLength_rad;
  // A Gaussian correlation of length L makes 2 pi L^2 one independent piece.
  const double pieces = 1.0 + solid_angle_rad2 / (2.0 * std::numbers::pi * kLength2);
  const double slope2 = kLength2 + solid_angle_rad2 * pieces / kVarianceOfLine;
  return {ratio * distance_m / std::sqrt(pieces), ratio / std::sqrt(slope2)};
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

void BendMeter::Measure(double left_ratio, Frame& frame) {
  const cv::Size size = rays_.size();
  const int cell_px = std::max(4 * kStride_px, kCell_px * size.width / kFullWidth_px);
  const int columns = size.width / cell_px;
  // Where there are no planes, labels were not made either.
  const int rows = frame.planes.empty() ? 0 : size.height / cell_px;
  // The planes as the rays see them.
  std::vector<InverseDepthPlane> planes;
  std::vector<double> grazing, squares(frame.planes.size(), 0.0);
  std::vector<int> cells(frame.planes.size(), 0);
  for (const FramePlane& plane : frame.planes) {
    planes.push_back(SeenAlongRays(plane.pi_c));
    const Eigen::Vector3d ray = plane.centroid_c / plane.centroid_c.z();
    grazing.push_back(
        noise_.GrazingFactor(plane.centroid_c.z(), planes.back().Cosine(ray.x(), ray.y())));
  }

  // Cell by cell: the mean deviation of the plane that fills it, less what noise makes.
  const int side = (cell_px + kStride_px - 1) / kStride_px;
  const double full = kMinFilled * side * side;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const std::uint8_t label =
          frame.plane_labels(row * cell_px + cell_px / 2, column * cell_px + cell_px / 2);
      if (label == 0 || label > planes.size()) continue;
      const std::size_t f = label - 1u;
      Cell cell;
      for (int v = row * cell_px; v < (row + 1) * cell_px; v += kStride_px) {
        for (int u = column * cell_px; u < (column + 1) * cell_px; u += kStride_px) {
          const auto z = static_cast<double>(frame.depth_m(v, u));
          if (frame.plane_labels(v, u) != label || !(z > 0)) continue;
          const cv::Vec2d& ray = rays_(v, u);
          const double sigma = noise_.Sigma(z) / z * grazing[f];
          cell.count += 1;
          cell.sum += z * planes[f].InverseDepth(ray[0], ray[1]) - 1.0;
          cell.noise_variance += sigma * sigma;
        }
      }
      if (!(cell.count >= full)) continue;
      const double mean = cell.sum / cell.count;
      const double pixels = cell.count * kStride_px * kStride_px;
      const double shared = std::max(1.0, pixels / noise_.correlated_px);
      squares[f] += mean * mean - cell.noise_variance / cell.count / shared;
      ++cells[f];
    }
  }

  double sum = 0.0;
  int count = 0;
  for (std::size_t f = 0; f < planes.size(); ++f) {
    if (cells[f] < kMinCells) continue;
    sum += squares[f], count += cells[f];
  }
  if (count > 0) {
    squares_ = kKept * squares_ + sum;
    cells_ = kKept * cells_ + count;
  }
  const double known_ratio = std::max(left_ratio, ratio());
  frame.bend_ratio = std::max(unseen_, known_ratio);
  for (FramePlane& plane : frame.planes) {
    const BendSigmas sigmas =
        SigmasOfBend(known_ratio, plane.centroid_c.z(), plane.pixel_count * pixel_rad2_);
    plane.bend_offset_sigma_m = sigmas.offset_m;
    plane.bend_angle_sigma_rad = sigmas.angle_rad;
  }
}

}  // namespace slam
