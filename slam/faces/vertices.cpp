#include "slam/faces/vertices.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "slam/faces/vertex_covariance.h"

namespace slam {
namespace {

/// Angle between two lines, [0, pi/2].
double LineAngle(const Line& a, const Line& b) {
  return std::atan2(a.V.cross(b.V).norm(), std::abs(a.V.dot(b.V)));
}

/// Where two sides meet; i and j are positions among the edge lines.
struct Meeting {
  Eigen::Vector3d p_c;
  int i, j;
};

/// Searches the sides of one face among its edge lines.
class FaceOutline {
 public:
  FaceOutline(const FramePlane& plane, const std::vector<EdgeLine>& lines, const Camera& camera,
              const std::optional<Box>& box_px, const VertexConfig& config)
      : plane_(plane), lines_(lines), camera_(camera), box_px_(box_px), config_(config) {}

  /// Four corners from two pairs of parallel lines; empty when no two pairs are a rectangle.
  std::vector<Meeting> Rectangle() const {
    std::vector<Meeting> best;
    int best_support = 0;
    const int n = static_cast<int>(lines_.size());
    // Of all two pairs of parallel sides, those that most edge points support.
    for (int a = 0; a < n; ++a) {
      for (int b = a + 1; b < n; ++b) {
        if (!Parallel(a, b)) continue;
        for (int c = a + 1; c < n; ++c) {
          for (int d = c + 1; d < n; ++d) {
            if (c == b || d == b || !Parallel(c, d) || !Square(a, c) || !Square(b, d)) continue;
            const int support = Support(a) + Support(b) + Support(c) + Support(d);
            if (support <= best_support) continue;
            const std::vector<Meeting> corners = Corners({a, c, b, d});
            if (corners.size() != 4 || !FitsRegion(corners)) continue;
            best = corners, best_support = support;
          }
        }
      }
    }
    return best;
  }

  /// Two corners from a side between two parallel ones, or one corner from two sides.
  std::vector<Meeting> Partial() const {
    std::vector<Meeting> best;
    int best_support = 0;
    const int n = static_cast<int>(lines_.size());
    const auto consider = [&](const std::vector<Meeting>& corners, int support) {
      const bool more = corners.size() > best.size();
      const bool stronger = corners.size() == best.size() && support > best_support;
      if (more || (stronger && !corners.empty())) best = corners, best_support = support;
    };
    for (int across = 0; across < n; ++across) {
      for (int a = 0; a < n; ++a) {
        if (a == across) continue;
        const auto first = SupportedCorner(across, a);
        if (!first) continue;
        consider({*first}, Support(across) + Support(a));
        for (int b = a + 1; b < n; ++b) {
          if (b == across || !Parallel(a, b)) continue;
          const auto second = SupportedCorner(across, b);
          if (!second || !((first->p_c - second->p_c).norm() > config_.min_side_m)) continue;
          consider({*first, *second}, Support(across) + Support(a) + Support(b));
        }
      }
    }
    return best;
  }

 private:
  const EdgeLine& At(int k) const { return lines_[static_cast<std::size_t>(k)]; }
  int Support(int k) const { return At(k).support; }
  bool Parallel(int a, int b) const {
    return LineAngle(At(a).line_c, At(b).line_c) < config_.max_parallel_angle_rad;
  }
  bool Square(int a, int b) const {
    return 0.5 * std::numbers::pi - LineAngle(At(a).line_c, At(b).line_c) <
           config_.max_square_error_rad;
  }

  std::optional<Meeting> Corner(int a, int b) const {
    const auto point =
        MeetingPoint(At(a).line_c, At(b).line_c, plane_.pi_c, camera_, box_px_, config_);
    return point ? std::optional<Meeting>({point.value(), a, b}) : std::nullopt;
  }

  /// Corner of two sides at a right angle that both nearly reach it.
  std::optional<Meeting> SupportedCorner(int a, int b) const {
    if (!Square(a, b)) return std::nullopt;
    auto point = Corner(a, b);
    if (!point) return std::nullopt;
    const Eigen::Vector2d u = camera_.Project(point->p_c);
    for (const int k : {a, b}) {
      const double length = (At(k).to_px - At(k).from_px).norm();
      const double beyond = std::min((u - At(k).from_px).norm(), (u - At(k).to_px).norm());
      if (!(beyond < config_.max_extension * length + config_.max_support_distance_px)) {
        return std::nullopt;
      }
    }
    return point;
  }

  std::vector<Meeting> Corners(const std::array<int, 4>& around) const {
    std::vector<Meeting> corners;
    for (std::size_t k = 0; k < 4; ++k) {
      const auto corner = Corner(around[k], around[(k + 1) % 4]);
      if (!corner) return {};
      corners.push_back(*corner);
    }
    return corners;
  }

  /// Sides long enough, and an area that the visible region fills.
  bool FitsRegion(const std::vector<Meeting>& corners) const {
    Eigen::Vector3d twice_area = Eigen::Vector3d::Zero();
    for (std::size_t k = 0; k < 4; ++k) {
      const Eigen::Vector3d& p = corners[k].p_c;
      const Eigen::Vector3d& q = corners[(k + 1) % 4].p_c;
      if (!((p - q).norm() > config_.min_side_m)) return false;
      twice_area += (p - corners[0].p_c).cross(q - corners[0].p_c);
    }
    const double fill = plane_.area_m2 / (0.5 * twice_area.norm());
    return fill > config_.min_fill && fill < config_.max_fill;
  }

  const FramePlane& plane_;
  const std::vector<EdgeLine>& lines_;
  const Camera& camera_;
  const std::optional<Box>& box_px_;
  const VertexConfig& config_;
};

bool InBox(const Eigen::Vector3d& x_c, const Camera& camera, const Box& box_px,
           double margin_px) {
  return x_c.z() > 0 && box_px.Contains(camera.ProjectDistorted(x_c), margin_px);
}

/// A box that the image's border cuts off says nothing of what lies beyond.
Box OpenAtBorder(Box box_px, const Box& image, double margin_px) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 2; ++k) {
    if (box_px.min[k] <= image.min[k] + margin_px) box_px.min[k] = -kInfinity;
    if (box_px.max[k] >= image.max[k] - margin_px) box_px.max[k] = kInfinity;
  }
  return box_px;
}

/// Counter-clockwise seen from the front, beginning with the corner first in reading order.
void PutInOrder(const Plane& pi_c, const Camera& camera, std::vector<Meeting>& corners) {
  if (corners.size() == 4) {
    const Eigen::Vector3d turn =
        (corners[1].p_c - corners[0].p_c).cross(corners[2].p_c - corners[0].p_c);
    if (turn.dot(pi_c.n) < 0) std::reverse(corners.begin(), corners.end());
  }
  const auto first =
      std::min_element(corners.begin(), corners.end(), [&](const Meeting& a, const Meeting& b) {
        const Eigen::Vector2d u = camera.Project(a.p_c), w = camera.Project(b.p_c);
        return u.y() != w.y() ? u.y() < w.y() : u.x() < w.x();
      });
  std::rotate(corners.begin(), first, corners.end());
}

bool HasSupport(const FramePlane& plane, const Camera& camera, const Eigen::Vector3d& corner,
                double max_distance_px) {
  const Eigen::Vector2d u = camera.ProjectDistorted(corner);
  return std::any_of(
      plane.edge_points.begin(), plane.edge_points.end(), [&](const EdgePoint& e) {
        return e.kind == EdgeKind::kSurface && (e.u_px - u).norm() < max_distance_px;
      });
}

}  // namespace

std::optional<Eigen::Vector3d> MeetingPoint(const Line& L_i, const Line& L_j, const Plane& pi_c,
                                            const Camera& camera,
                                            const std::optional<Box>& box_px,
                                            const VertexConfig& config) {
  const auto feet = CommonPerpendicular(L_i, L_j, config.min_crossing_angle_rad);
  if (!feet) return std::nullopt;

  // The three conditions of the paper.
  const auto& [P_pi, P_pj] = *feet;
  if (!((P_pi - P_pj).norm() < config.max_feet_distance_m)) return std::nullopt;
  for (const Eigen::Vector3d& foot : {P_pi, P_pj}) {
    if (!(foot.z() > kMinVisibleDepth_m)) return std::nullopt;  // lines go on behind the camera
    if (!(std::abs(SignedDistance(pi_c, foot)) < config.max_plane_distance_m)) {
      return std::nullopt;
    }
    if (box_px && !InBox(foot, camera, *box_px, config.box_margin_px)) {
      return std::nullopt;
    }
  }
  return ProjectOnto(pi_c, 0.5 * (P_pi + P_pj));
}

std::vector<Vertex> FindVertices(const FramePlane& plane, const std::vector<EdgeLine>& lines,
                                 const Camera& camera, const std::optional<Box>& box_px,
                                 const VertexConfig& config) {
  // A whole rectangle is sought first, then what of one can be seen.
  const std::optional<Box> open_px =
      box_px
          ? std::optional<Box>(OpenAtBorder(*box_px, camera.ImageBox(), config.box_margin_px))
          : std::nullopt;
  const FaceOutline outline(plane, lines, camera, open_px, config);
  std::vector<Meeting> corners = outline.Rectangle();
  if (corners.empty()) corners = outline.Partial();
  if (corners.empty()) return {};

  PutInOrder(plane.pi_c, camera, corners);
  std::vector<Vertex> out;
  out.reserve(corners.size());
  for (const auto& [p_c, i, j] : corners) {
    out.push_back({p_c, !HasSupport(plane, camera, p_c, config.max_support_distance_px),
                   VertexCovariance(plane, lines[static_cast<std::size_t>(i)].error,
                                    lines[static_cast<std::size_t>(j)].error, p_c, camera)});
  }
  return out;
}

}  // namespace slam
