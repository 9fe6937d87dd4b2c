// The light of lamps and areas on a view's pixels.
#include <algorithm>

#include "sim/trace/view/view.h"

namespace sim {
void View::SetSpot(int lane, const SeenFacet& facet, double x, double y, double z,
                   Spots& spots) const {
  const std::size_t i = Index(lane);
  spots.used[i] = true;
  spots.x_w[i] = T_wc_ * (z * Eigen::Vector3d(x, y, 1.0));
  spots.n_w[i] = facet.n_w;
  spots.shading_n_w[i] = NormalAt(facet, x, y);
}

LightAtSpots View::LightsAt(const Spots& spots) const {
  return lights_.At(spots, [this](const RayPacket& packet) { return Blocked(packet); });
}

void View::CastToLights(int v) {
  static_assert(2 * (65536 + 65535) + 1 < 1 << kLightBit);
  static_assert(kLightBit + kMaxLights <= 32);
  const int* triangles = Triangles(v);
  const double* depth = out_->depth_m[v];
  std::uint32_t* surfaces = Surfaces(v);
  const int width = world_->camera.width;
  for (int u0 = 0; u0 < width; u0 += kLanes) {
    Spots spots;
    const int lanes = std::min(kLanes, width - u0);
    for (int i = 0; i < lanes; ++i) {
      const int u = u0 + i;
      if (triangles[u] == PacketHits::kNothing) continue;
      SetSpot(i, facets_.At(triangles[u]), row_.x[Index(u)], row_.y[Index(u)], depth[u], spots);
    }
    const LightAtSpots found = lights_.At(spots, [this](const RayPacket& packet) {
      if (log_ != nullptr) log_->blocked.push_back(packet);
      return Blocked(packet);
    });
    for (int i = 0; i < lanes; ++i) {
      lights_row_[Index(u0 + i)] = found.light[Index(i)];
      surfaces[u0 + i] |= found.seen[Index(i)] << kLightBit;
    }
  }
}

}  // namespace sim
