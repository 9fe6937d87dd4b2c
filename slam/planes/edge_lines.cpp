#include "slam/planes/edge_lines.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "slam/extract/plane_sums.h"

namespace slam {
namespace {

using Points = std::vector<Eigen::Vector2d>;

double Distance(const ImageLine& line, const Eigen::Vector2d& u) {
  const Eigen::Vector2d d = u - line.p;
  return std::abs(line.v.x() * d.y() - line.v.y() * d.x());
}

/// Total least squares.
ImageLine FitLine(const Points& points) {
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (const Eigen::Vector2d& u : points) mean += u;
  mean /= static_cast<double>(points.size());
  Eigen::Matrix2d scatter = Eigen::Matrix2d::Zero();
  for (const Eigen::Vector2d& u : points) scatter += (u - mean) * (u - mean).transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(scatter);
  ImageLine line;
  line.p = mean;
  line.v = axes.eigenvectors().col(1);
  return line;
}

Points Near(const Points& points, const ImageLine& line, double max_distance) {
  Points near;
  for (const Eigen::Vector2d& u : points) {
    if (Distance(line, u) < max_distance) near.push_back(u);
  }
  return near;
}

/// The most points in a row along the line without a gap.
Points LongestPiece(const Points& on_line, const ImageLine& line, double max_gap) {
  Points sorted = on_line;
  const auto along = [&](const Eigen::Vector2d& u) { return line.v.dot(u - line.p); };
  std::stable_sort(sorted.begin(), sorted.end(),
                   [&](const auto& a, const auto& b) { return along(a) < along(b); });
  std::size_t best_from = 0, best_to = 0, from = 0;
  for (std::size_t k = 1; k <= sorted.size(); ++k) {
    if (k < sorted.size() && along(sorted[k]) - along(sorted[k - 1]) < max_gap) continue;
    if (k - from > best_to - best_from) best_from = from, best_to = k;
    from = k;
  }
  return Points(sorted.begin() + static_cast<std::ptrdiff_t>(best_from),
                sorted.begin() + static_cast<std::ptrdiff_t>(best_to));
}

/// The line through two points that has most points near it.
ImageLine BestHypothesis(const Points& points, const EdgeLineConfig& config, Random& random) {
  const int n = static_cast<int>(points.size());
  ImageLine best;
  for (int k = 0; k < config.iterations; ++k) {
    ImageLine line;
    line.p = points[static_cast<std::size_t>(random.Below(n))];
    const Eigen::Vector2d d = points[static_cast<std::size_t>(random.Below(n))] - line.p;
    // Two points closer than half the least length do not fix a direction.
    if (!(d.norm() > 0.5 * config.min_length_px)) continue;
    line.v = d.normalized();
    for (const Eigen::Vector2d& u : points) {
      line.support += Distance(line, u) < config.max_distance_px ? 1 : 0;
    }
    if (line.support > best.support) best = line;
  }
  return best;
}

/// Variance that the points of a line have in common: median step of depth across them.
double SharedVariance(const FramePlane& plane, const Camera& camera, const ImageLine& line,
                      const EdgeLineConfig& config) {
  std::vector<float> steps;
  for (const EdgePoint& e : plane.edge_points) {
    if (e.kind != EdgeKind::kSurface || !(e.step_sigmas > 0)) continue;
    const Eigen::Vector2d u = camera.Project(e.p_c);
    const double along = line.v.dot(u - line.from);
    if (along < 0 || along > (line.to - line.from).norm()) continue;
    if (Distance(line, u) < config.max_distance_px) steps.push_back(e.step_sigmas);
  }
  double doubt_px = 0.0;
  if (!steps.empty()) {
    const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
    std::nth_element(steps.begin(), middle, steps.end());
    const double steps_doubtful = config.doubtful_step_sigmas / static_cast<double>(*middle);
    // Its points do not lie farther off than that.
    doubt_px = std::min(steps_doubtful * steps_doubtful, 2.0 * config.max_distance_px);
  }
  return config.shared_sigma_px * config.shared_sigma_px + doubt_px * doubt_px;
}

/// Intersection of the plane with the ray of an ideal pixel.
Eigen::Vector3d OnPlane(const InverseDepthPlane& plane, const Camera& camera,
                        const Eigen::Vector2d& u_px) {
  const Eigen::Vector3d ray = camera.Backproject(u_px, 1.0);
  return ray / plane.InverseDepth(ray.x(), ray.y());
}

}  // namespace

std::vector<ImageLine> FindImageLines(Points points_px, int min_support,
                                      const EdgeLineConfig& config, Random random) {
  std::sort(points_px.begin(), points_px.end(), [](const auto& a, const auto& b) {
    return a.y() != b.y() ? a.y() < b.y() : a.x() < b.x();
  });
  std::vector<ImageLine> lines;
  while (static_cast<int>(lines.size()) < config.max_lines &&
         static_cast<int>(points_px.size()) >= std::max(min_support, 2)) {
    ImageLine line = BestHypothesis(points_px, config, random);
    if (line.support < min_support) break;
    Points on_line = Near(points_px, line, config.max_distance_px);
    for (int round = 0; round < 2 && on_line.size() >= 2; ++round) {
      line = FitLine(LongestPiece(on_line, line, config.max_gap_px));
      on_line = Near(points_px, line, config.max_distance_px);
    }
    const Points piece = LongestPiece(on_line, line, config.max_gap_px);
    if (piece.size() < 2) break;
    line = FitLine(piece);
    const auto along = [&](const Eigen::Vector2d& u) { return line.v.dot(u - line.p); };
    line.from = line.p + along(piece.front()) * line.v;
    line.to = line.p + along(piece.back()) * line.v;
    line.support = static_cast<int>(piece.size());
    line.error = MeasureLineError(piece, line.p, line.v);
    if (line.support >= min_support && (line.to - line.from).norm() >= config.min_length_px) {
      lines.push_back(line);
    }
    // Its points, or a piece too short to be a line, are not looked at again.
    Points rest;
    for (const Eigen::Vector2d& u : points_px) {
      const bool taken = std::any_of(piece.begin(), piece.end(),
                                     [&](const Eigen::Vector2d& t) { return t == u; });
      if (!taken) rest.push_back(u);
    }
    points_px = std::move(rest);
  }
  std::stable_sort(lines.begin(), lines.end(), [](const ImageLine& a, const ImageLine& b) {
    return a.support > b.support;
  });
  return lines;
}

std::vector<EdgeLine> FindEdgeLines(const FramePlane& plane, const Camera& camera,
                                    const EdgeLineConfig& config, const Random& random) {
  Points points;
  for (const EdgePoint& e : plane.edge_points) {
    if (e.kind == EdgeKind::kSurface) points.push_back(camera.Project(e.p_c));
  }
  const int min_support =
      std::max(4, static_cast<int>(std::ceil(config.min_contour_share *
                                             static_cast<double>(plane.edge_points.size()))));
  const InverseDepthPlane along_rays = SeenAlongRays(plane.pi_c);
  const Eigen::Vector2d center = camera.Project(plane.centroid_c);
  std::vector<EdgeLine> out;
  for (const ImageLine& line : FindImageLines(std::move(points), min_support, config, random)) {
    Eigen::Vector2d outward(-line.v.y(), line.v.x());
    if (outward.dot(center - line.p) > 0) outward = -outward;
    const Eigen::Vector2d from = line.from + config.inset_px * outward;
    const Eigen::Vector2d to = line.to + config.inset_px * outward;
    const Eigen::Vector3d P = OnPlane(along_rays, camera, from);
    const Eigen::Vector3d V = OnPlane(along_rays, camera, to) - P;
    if (!(V.norm() > 0)) continue;
    out.push_back({{P, V.normalized()}, from, to, line.support, line.error});
    LineError& error = out.back().error;
    error.at_px += config.inset_px * outward;
    // At either end by itself, so half of it turns the line.
    const double shared_px2 = SharedVariance(plane, camera, line, config);
    error.offset_px2 += 0.5 * shared_px2;
    error.angle_rad2 += 2.0 * shared_px2 / (to - from).squaredNorm();
  }
  return out;
}

}  // namespace slam
