#include "sim/trace/edge_pixels.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace sim {
namespace {

/// The edge in the image, along the axis on which it is longer.
struct ImageEdge {
  bool steep = false;  ///< `along` is v
  double along[2], across[2], inverse_depth[2];
};

/// A straight piece of an edge: its ends' rays (x, y, 1) and inverse depths, which are affine
/// along it.
struct Piece {
  Eigen::Vector2d p, q;
  double wp = 0, wq = 0;
};

/// The part of the edge before the camera and in the window, if there is one.
bool Clip(Eigen::Vector3d a, Eigen::Vector3d b, const RayWindow& window, Piece& piece) {
  // What is behind the camera is cut off before it is projected.
  if (!(a.z() > kNear_m) && !(b.z() > kNear_m)) return false;
  if (a.z() < kNear_m) a += (kNear_m - a.z()) / (b.z() - a.z()) * (b - a);
  if (b.z() < kNear_m) b += (kNear_m - b.z()) / (a.z() - b.z()) * (a - b);
  const Eigen::Vector2d p = a.head<2>() / a.z(), q = b.head<2>() / b.z();
  // Then the window's four sides cut the projection (Liang and Barsky).
  double from = 0, to = 1;
  // Keeps the shares s of the way where at + s slope <= 0.
  const auto keep = [&](double at, double slope) {
    if (slope < 0) from = std::max(from, at / -slope);
    if (slope > 0) to = std::min(to, -at / slope);
    if (slope == 0 && at > 0) to = -1;
  };
  for (int axis = 0; axis < 2; ++axis) {
    const double way = q[axis] - p[axis];
    keep(window.low[axis] - p[axis], -way);
    keep(p[axis] - window.high[axis], way);
  }
  if (!(from <= to)) return false;
  // Inverse depth is affine along the projection, depth is not.
  const double wa = 1 / a.z(), wb = 1 / b.z();
  piece = {p + from * (q - p), p + to * (q - p), wa + from * (wb - wa), wa + to * (wb - wa)};
  return true;
}

/// A point of an edge in the image, and its inverse depth.
struct ImagePoint {
  Eigen::Vector2d pixel;
  double inverse_depth = 0;
};

ImageEdge EdgeBetween(const ImagePoint& begin, const ImagePoint& end) {
  ImageEdge edge;
  Eigen::Vector2d p = begin.pixel, q = end.pixel;
  double zp = begin.inverse_depth, zq = end.inverse_depth;
  edge.steep = std::abs(q.y() - p.y()) > std::abs(q.x() - p.x());
  // Each step along the longer axis meets one pixel, or few, across.
  const int axis = edge.steep ? 1 : 0;
  if (p[axis] > q[axis]) {
    std::swap(p, q);
    std::swap(zp, zq);
  }
  edge.along[0] = p[axis], edge.along[1] = q[axis];
  edge.across[0] = p[1 - axis], edge.across[1] = q[1 - axis];
  edge.inverse_depth[0] = zp, edge.inverse_depth[1] = zq;
  return edge;
}

void Walk(const ImageEdge& edge, const Camera& camera, double margin_px,
          std::vector<EdgePixel>& pixels) {
  const int length = edge.steep ? camera.height : camera.width;
  const int breadth = edge.steep ? camera.width : camera.height;
  // Shares of the image, so that far coordinates never overflow an int.
  const double first = std::max(std::ceil(edge.along[0] - margin_px), 0.0);
  const double last = std::min(std::floor(edge.along[1] + margin_px), length - 1.0);
  const double span = edge.along[1] - edge.along[0];
  // The perpendicular distance is at least 0.7 of the distance across.
  const double reach = 1.5 * margin_px;
  for (double at = first; at <= last; ++at) {
    const auto share = [&](double where) {
      return span > 0 ? std::clamp((where - edge.along[0]) / span, 0.0, 1.0) : 0.5;
    };
    // Only the pixel centre nearest across can be within the margin, which is below half a
    // pixel.
    const double across = edge.across[0] + share(at) * (edge.across[1] - edge.across[0]);
    const double near = std::round(across);
    if (!(std::abs(across - near) <= reach) || !(near >= 0 && near < breadth)) continue;
    const auto i = static_cast<std::uint32_t>(at), j = static_cast<std::uint32_t>(near);
    const auto width = static_cast<std::uint32_t>(camera.width);
    const auto inverse_depth = [&](double s) {
      return edge.inverse_depth[0] + s * (edge.inverse_depth[1] - edge.inverse_depth[0]);
    };
    pixels.push_back(
        {edge.steep ? i * width + j : j * width + i,
         std::max(inverse_depth(share(at - margin_px)), inverse_depth(share(at + margin_px)))});
  }
}

void MarkBlocks(const ImageEdge& edge, EdgeBlocks& blocks) {
  const double span = edge.along[1] - edge.along[0];
  const double steps = std::ceil(span / EdgeBlocks::kStep_px);
  for (double i = 0; i <= steps; ++i) {
    const double share = steps > 0 ? i / steps : 0;
    const double along = edge.along[0] + share * span;
    const double across = edge.across[0] + share * (edge.across[1] - edge.across[0]);
    if (edge.steep) {
      blocks.Mark(across, along);
    } else {
      blocks.Mark(along, across);
    }
  }
}

/// A lens bends edges: so short that what is between two points of one may be joined straight.
constexpr double kStraight_px = 4.0;

void WalkPieces(const Piece& whole, const Camera& camera, double margin_px,
                std::vector<EdgePixel>& pixels, EdgeBlocks* blocks) {
  const auto walk = [&](const ImageEdge& edge) {
    Walk(edge, camera, margin_px, pixels);
    if (blocks != nullptr) MarkBlocks(edge, *blocks);
  };
  const auto seen = [&](const Eigen::Vector2d& ray, double inverse_depth) -> ImagePoint {
    return {camera.Project({ray.x(), ray.y(), 1.0}), inverse_depth};
  };
  if (camera.lens.IsNone()) {
    return walk(EdgeBetween(seen(whole.p, whole.wp), seen(whole.q, whole.wq)));
  }
  const double focal = std::max(camera.fx, camera.fy);
  const double count = std::ceil((whole.q - whole.p).norm() * focal / kStraight_px) + 1;
  const auto at = [&](double i) {
    return seen(whole.p + i / count * (whole.q - whole.p),
                whole.wp + i / count * (whole.wq - whole.wp));
  };
  ImagePoint begin = at(0);
  for (double i = 0; i < count; ++i) {
    const ImagePoint end = at(i + 1);
    walk(EdgeBetween(begin, end));
    begin = end;
  }
}

/// Whether a ball may be seen at all.
bool MayBeSeen(const Eigen::Vector3d& center_c, double radius, const RayWindow& window) {
  if (center_c.z() + radius < kNear_m) return false;
  for (int axis = 0; axis < 2; ++axis) {
    const double low = window.low[axis], high = window.high[axis];
    if (low * center_c.z() - center_c[axis] > radius * std::sqrt(1 + low * low)) return false;
    if (center_c[axis] - high * center_c.z() > radius * std::sqrt(1 + high * high))
      return false;
  }
  return true;
}

constexpr std::size_t kBundle = 36;        ///< the lines of a few boxes
constexpr double kInsideAFaceShare = 0.2;  ///< share of the margin

}  // namespace

SceneEdges::SceneEdges(std::span<const Triangle> triangles) {
  using Key = std::array<double, 6>;
  std::map<Key, const Triangle*> open;  // edges met once so far
  for (const Triangle& triangle : triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Eigen::Vector3d& a = triangle.corners_w[i];
      const Eigen::Vector3d& b = triangle.corners_w[(i + 1) % 3];
      // Both triangles of an edge name it by the same key, its lower corner first.
      const bool ordered =
          std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
      const Eigen::Vector3d &low = ordered ? a : b, &high = ordered ? b : a;
      const Key key{low.x(), low.y(), low.z(), high.x(), high.y(), high.z()};
      const auto [at, is_new] = open.try_emplace(key, &triangle);
      if (is_new) continue;
      const Triangle& twin = *at->second;
      open.erase(at);
      edges_.push_back({{low, high}, twin.plane > 0 && twin.plane == triangle.plane});
    }
  }
  // What no second triangle closed is a rim, and always a border of what is seen.
  for (const auto& [key, triangle] : open) {
    edges_.push_back(
        {{Eigen::Vector3d(key[0], key[1], key[2]), Eigen::Vector3d(key[3], key[4], key[5])},
         false});
  }
  MakeBundles();
}

void SceneEdges::MakeBundles() {
  for (std::size_t first = 0; first < edges_.size(); first += kBundle) {
    Bundle bundle{first, std::min(first + kBundle, edges_.size()), {}, 0};
    Eigen::Vector3d low = edges_[first].ends_w[0], high = low;
    for (std::size_t i = bundle.first; i < bundle.last; ++i) {
      for (const Eigen::Vector3d& end : edges_[i].ends_w) {
        low = low.cwiseMin(end);
        high = high.cwiseMax(end);
      }
    }
    // The ball is a little larger than the box's, so that rounding loses no edge.
    bundle.center_w = 0.5 * (low + high);
    bundle.radius_m = 0.5 * (high - low).norm() * (1 + 1e-9) + 1e-9;
    bundles_.push_back(bundle);
  }
}

void SceneEdges::Near(const Pose& T_wc, const Camera& camera, const RayWindow& window,
                      double margin_px, std::vector<EdgePixel>& pixels,
                      EdgeBlocks* blocks) const {
  const Pose T_cw = Inverse(T_wc);
  for (const Bundle& bundle : bundles_) {
    if (!MayBeSeen(T_cw * bundle.center_w, bundle.radius_m, window)) continue;
    for (std::size_t i = bundle.first; i < bundle.last; ++i) {
      const Edge& edge = edges_[i];
      Piece piece;
      if (!Clip(T_cw * edge.ends_w[0], T_cw * edge.ends_w[1], window, piece)) continue;
      const double margin = edge.inside_a_face ? kInsideAFaceShare * margin_px : margin_px;
      WalkPieces(piece, camera, margin, pixels, blocks);
    }
  }
}

}  // namespace sim
