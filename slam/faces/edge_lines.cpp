#include "slam/faces/edge_lines.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "slam/base/median.h"
#include "slam/faces/line_support.h"
#include "slam/geometry/plane_sums.h"

namespace slam {
namespace {

using Points = std::vector<Eigen::Vector2d>;

constexpr int kMinSupport = 4;  // points of a line: any two make one, and three often do

LineStrip StripAlong(const ImageLine& line, double max_distance) {
  return {line.p.x(), line.p.y(), line.v.x(), line.v.y(), max_distance};
}

double Along(const ImageLine& line, const Eigen::Vector2d& u) { return line.v.dot(u - line.p); }

/// The line of total least squares: along the scatter's larger axis.
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

/// Seeks one line after the other in points that become fewer.
class LineSearch {
 public:
  LineSearch(Points points_px, const EdgeLineConfig& config)
      : points_(std::move(points_px)), config_(config) {
    columns_.Set(points_);
  }

  int left() const { return static_cast<int>(points_.size()); }
  /// Points of the line that was refined last, in order along it.
  const Points& piece() const { return piece_; }

  /// The line through two points that has most points near it.
  ImageLine BestHypothesis(Random& random) const {
    const int n = left();
    ImageLine best;
    for (int k = 0; k < config_.iterations; ++k) {
      ImageLine line;
      line.p = points_[static_cast<std::size_t>(random.Below(n))];
      const Eigen::Vector2d d = points_[static_cast<std::size_t>(random.Below(n))] - line.p;
      // Two points closer than half the shortest line do not fix a direction.
      if (!(d.norm() > 0.5 * config_.min_length_px)) continue;
      line.v = d.normalized();
      line.support =
          CountUnlessFewer(columns_, StripAlong(line, config_.max_distance_px), best.support);
      if (line.support > best.support) best = line;
    }
    return best;
  }

  /// Fits the longest piece without a gap. @returns whether there is one.
  bool Refine(ImageLine& line) {
    FindNear(columns_, StripAlong(line, config_.max_distance_px), near_);
    for (int round = 0; round < 2 && near_.size() >= 2; ++round) {
      TakeLongestPiece(line);
      line = FitLine(piece_);
      FindNear(columns_, StripAlong(line, config_.max_distance_px), near_);
    }
    TakeLongestPiece(line);
    if (piece_.size() < 2) return false;
    line = FitLine(piece_);
    return true;
  }

  void RemovePiece() {
    taken_.assign(points_.size(), 0);
    for (std::size_t k = first_; k < last_; ++k)
      taken_[static_cast<std::size_t>(sorted_[k].second)] = 1;
    std::size_t kept = 0;
    for (std::size_t k = 0; k < points_.size(); ++k) {
      if (taken_[k] == 0) points_[kept++] = points_[k];
    }
    points_.resize(kept);
    columns_.Set(points_);
  }

 private:
  /// The longest row of near points along the line without a gap.
  void TakeLongestPiece(const ImageLine& line) {
    sorted_.clear();
    for (const int k : near_)
      sorted_.emplace_back(Along(line, points_[static_cast<std::size_t>(k)]), k);
    std::sort(sorted_.begin(), sorted_.end());
    first_ = last_ = 0;
    std::size_t from = 0;
    for (std::size_t k = 1; k <= sorted_.size(); ++k) {
      if (k < sorted_.size() && sorted_[k].first - sorted_[k - 1].first < config_.max_gap_px)
        continue;
      if (k - from > last_ - first_) first_ = from, last_ = k;
      from = k;
    }
    piece_.clear();
    for (std::size_t k = first_; k < last_; ++k)
      piece_.push_back(points_[static_cast<std::size_t>(sorted_[k].second)]);
  }

  Points points_;
  PointColumns columns_;  ///< the same points
  const EdgeLineConfig& config_;
  std::vector<int> near_;                       ///< places of points near a line
  std::vector<std::pair<double, int>> sorted_;  ///< where along it, and their places
  std::size_t first_ = 0, last_ = 0;            ///< the piece, in sorted_
  Points piece_;
  std::vector<std::uint8_t> taken_;
};

/// Points where the surface itself ends.
struct OwnEnds {
  Points u_px;                     ///< ideal image
  std::vector<float> step_sigmas;  ///< one a point (EdgePoint)
};

OwnEnds ProjectOwnEnds(const FramePlane& plane, const Camera& camera) {
  OwnEnds ends;
  ends.u_px.reserve(plane.edge_points.size());
  ends.step_sigmas.reserve(plane.edge_points.size());
  for (const EdgePoint& e : plane.edge_points) {
    if (e.kind != EdgeKind::kSurface) continue;
    ends.u_px.push_back(camera.Project(e.p_c));
    ends.step_sigmas.push_back(e.step_sigmas);
  }
  return ends;
}

/// Variance that the points of a line have in common: median step of depth across them.
double SharedVariance(const OwnEnds& ends, const ImageLine& line,
                      const EdgeLineConfig& config) {
  std::vector<float> steps;
  const LineStrip strip = StripAlong(line, config.max_distance_px);
  const double length = (line.to - line.from).norm();
  for (std::size_t k = 0; k < ends.u_px.size(); ++k) {
    const Eigen::Vector2d& u = ends.u_px[k];
    if (!(ends.step_sigmas[k] > 0) || !strip.Contains(u.x(), u.y())) continue;
    const double along = line.v.dot(u - line.from);
    if (along >= 0 && along <= length) steps.push_back(ends.step_sigmas[k]);
  }

  // Where the depth hardly changes, the place of the whole side is doubtful.
  double doubt_px = 0.0;
  if (!steps.empty()) {
    const double steps_doubtful =
        config.doubtful_step_sigmas / static_cast<double>(UpperMedian(std::move(steps)));
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

  // One line after the other, each from what the ones before have left.
  LineSearch search(std::move(points_px), config);
  std::vector<ImageLine> lines;
  while (static_cast<int>(lines.size()) < config.max_lines &&
         search.left() >= std::max(min_support, 2)) {
    ImageLine line = search.BestHypothesis(random);
    if (line.support < min_support || !search.Refine(line)) break;
    const Points& piece = search.piece();
    // The last fit may look the other way than the one that put the piece in order.
    if (Along(line, piece.back()) < Along(line, piece.front())) line.v = -line.v;
    line.from = line.p + Along(line, piece.front()) * line.v;
    line.to = line.p + Along(line, piece.back()) * line.v;
    line.support = static_cast<int>(piece.size());
    if (line.support >= min_support && (line.to - line.from).norm() >= config.min_length_px) {
      line.error = MeasureLineError(piece, line.p, line.v);
      lines.push_back(line);
    }
    search.RemovePiece();  // too short to be a line, or one: it is not looked at again
  }
  std::stable_sort(lines.begin(), lines.end(), [](const ImageLine& a, const ImageLine& b) {
    return a.support > b.support;
  });
  return lines;
}

std::vector<EdgeLine> FindEdgeLines(const FramePlane& plane, const Camera& camera,
                                    const EdgeLineConfig& config, const Random& random) {
  const OwnEnds ends = ProjectOwnEnds(plane, camera);
  const int min_support = std::max(
      kMinSupport, static_cast<int>(std::ceil(config.min_contour_share *
                                              static_cast<double>(plane.edge_points.size()))));
  const InverseDepthPlane along_rays = SeenAlongRays(plane.pi_c);
  const Eigen::Vector2d center = camera.Project(plane.centroid_c);

  // Each line moves out to the edge itself, and from the image onto the plane.
  std::vector<EdgeLine> out;
  for (const ImageLine& line : FindImageLines(ends.u_px, min_support, config, random)) {
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
    const double shared_px2 = SharedVariance(ends, line, config);
    error.offset_px2 += 0.5 * shared_px2;
    error.angle_rad2 += 2.0 * shared_px2 / (to - from).squaredNorm();
  }
  return out;
}

}  // namespace slam
