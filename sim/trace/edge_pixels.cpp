#include "sim/trace/edge_pixels.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace sim {
namespace {

constexpr double kNear_m = 1e-3;  ///< as the renderer's

/// The edge in the image, along the axis on which it is longer.
struct ImageEdge {
  bool steep = false;  ///< `along` is v
  double along[2], across[2], inverse_depth[2];
};

bool Project(Eigen::Vector3d a, Eigen::Vector3d b, const Camera& camera, ImageEdge& edge) {
  if (!(a.z() > kNear_m) && !(b.z() > kNear_m)) return false;
  if (a.z() < kNear_m) a += (kNear_m - a.z()) / (b.z() - a.z()) * (b - a);
  if (b.z() < kNear_m) b += (kNear_m - b.z()) / (a.z() - b.z()) * (a - b);
  Eigen::Vector2d p = camera.Project(a), q = camera.Project(b);
  double zp = 1 / a.z(), zq = 1 / b.z();
  edge.steep = std::abs(q.y() - p.y()) > std::abs(q.x() - p.x());
  const int axis = edge.steep ? 1 : 0;
  if (p[axis] > q[axis]) {
    std::swap(p, q);
    std::swap(zp, zq);
  }
  edge.along[0] = p[axis], edge.along[1] = q[axis];
  edge.across[0] = p[1 - axis], edge.across[1] = q[1 - axis];
  edge.inverse_depth[0] = zp, edge.inverse_depth[1] = zq;
  return true;
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

}  // namespace

SceneEdges::SceneEdges(std::span<const Triangle> triangles) {
  using Key = std::array<double, 6>;
  std::map<Key, const Triangle*> open;  // edges met once so far
  for (const Triangle& triangle : triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Eigen::Vector3d& a = triangle.corners_w[i];
      const Eigen::Vector3d& b = triangle.corners_w[(i + 1) % 3];
      const bool ordered =
          std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
      const Eigen::Vector3d &low = ordered ? a : b, &high = ordered ? b : a;
      const Key key{low.x(), low.y(), low.z(), high.x(), high.y(), high.z()};
      const auto [at, is_new] = open.try_emplace(key, &triangle);
      if (is_new) continue;
      const Triangle& twin = *at->second;
      open.erase(at);
      const bool inside_a_face = twin.plane > 0 && twin.plane == triangle.plane;
      if (!inside_a_face) edges_w_.push_back({low, high});
    }
  }
  for (const auto& [key, triangle] : open) {
    edges_w_.push_back(
        {Eigen::Vector3d(key[0], key[1], key[2]), Eigen::Vector3d(key[3], key[4], key[5])});
  }
}

std::vector<EdgePixel> SceneEdges::Near(const Pose& T_wc, const Camera& camera,
                                        double margin_px) const {
  const Pose T_cw = Inverse(T_wc);
  std::vector<EdgePixel> pixels;
  for (const auto& [a_w, b_w] : edges_w_) {
    ImageEdge edge;
    if (Project(T_cw * a_w, T_cw * b_w, camera, edge)) Walk(edge, camera, margin_px, pixels);
  }
  std::sort(pixels.begin(), pixels.end(), [](const EdgePixel& a, const EdgePixel& b) {
    return a.pixel != b.pixel ? a.pixel < b.pixel : a.inverse_depth < b.inverse_depth;
  });
  return pixels;
}

}  // namespace sim
