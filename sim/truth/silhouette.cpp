#include "sim/truth/silhouette.h"

#include <algorithm>

namespace sim {
namespace {

void Include(const Eigen::Vector2d& p, std::optional<PixelBox>& box) {
  if (!box) box = PixelBox{p.x(), p.y(), p.x(), p.y()};
  box->x0 = std::min(box->x0, p.x());
  box->y0 = std::min(box->y0, p.y());
  box->x1 = std::max(box->x1, p.x());
  box->y1 = std::max(box->y1, p.y());
}

/// A lens bends edges outwards: look at points between the corners too.
constexpr int kPointsOnBentEdge = 32;

}  // namespace

std::optional<PixelBox> ProjectedBox(std::span<const Triangle> triangles, const Pose& T_wc,
                                     const Camera& camera) {
  const Pose T_cw = Inverse(T_wc);
  std::optional<PixelBox> box;
  for (const Triangle& triangle : triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Eigen::Vector3d a = T_cw * triangle.corners_w[i];
      const Eigen::Vector3d b = T_cw * triangle.corners_w[(i + 1) % 3];
      if (a.z() > kSilhouetteNear_m) Include(camera.Project(a), box);
      if ((a.z() > kSilhouetteNear_m) != (b.z() > kSilhouetteNear_m)) {
        const double t = (kSilhouetteNear_m - a.z()) / (b.z() - a.z());
        Include(camera.Project(a + t * (b - a)), box);
      }
      for (int k = 1; !camera.lens.IsNone() && k < kPointsOnBentEdge; ++k) {
        const Eigen::Vector3d p = a + static_cast<double>(k) / kPointsOnBentEdge * (b - a);
        if (p.z() > kSilhouetteNear_m) Include(camera.Project(p), box);
      }
    }
  }
  return box;
}

}  // namespace sim
