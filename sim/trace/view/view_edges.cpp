// The colour of pixels on edges, of surfaces and of shadows: the mean of four looks.
#include <algorithm>

#include "sim/trace/view/view.h"

namespace sim {
namespace {

constexpr int kLooks = 4;
/// A rotated grid, the same in each pixel.
constexpr std::array<std::array<double, 2>, kLooks> kSubPixels{
    {{-0.125, -0.375}, {0.375, -0.125}, {0.125, 0.375}, {-0.375, 0.125}}};

}  // namespace

/// Pixels of a row where a neighbour shows another surface or another side of a shadow's edge.
void View::MarkEdges(int v, std::vector<int>& columns) const {
  const int width = world_->camera.width;
  const std::uint32_t* here = Surfaces(v);
  const std::uint32_t* above = Surfaces(std::max(v - 1, rows_.start));
  const std::uint32_t* below = Surfaces(std::min(v + 1, rows_.end - 1));
  for (int u = 0; u < width; ++u) {
    const int left = std::max(u - 1, 0), right = std::min(u + 1, width - 1);
    // One comparison tells of surface, sun and lights: each has its bits.
    const std::uint32_t differs = (here[u] ^ here[left]) | (here[u] ^ here[right]) |
                                  (here[u] ^ above[u]) | (here[u] ^ below[u]);
    if (differs != 0) columns.push_back(u);
  }
}

/// Smooths a row when the next is known: its prints are at hand still.
void View::SmoothEdges(int v) {
  on_edge_.clear();
  MarkEdges(v, on_edge_);
  looks_.resize(kLooks * on_edge_.size());
  for (std::size_t first = 0; first < looks_.size(); first += Index(kLanes))
    CastLooks(v, first);
  SunOnLooks(v);
  for (std::size_t i = 0; i < on_edge_.size(); ++i) {
    const std::span<const Look> looks(looks_.data() + kLooks * i, kLooks);
    out_->radiance(v, on_edge_[i]) = MeanOf(looks);
    if (around_->coverage == nullptr) continue;
    (*around_->coverage)(v, on_edge_[i]) =
        static_cast<uchar>(std::count_if(looks.begin(), looks.end(), [](const Look& look) {
          return look.triangle != PacketHits::kNothing;
        }));
  }
}

/// A packet of looks, at two pixels.
void View::CastLooks(int v, std::size_t first) {
  const int count = static_cast<int>(std::min(looks_.size() - first, Index(kLanes)));
  RayPacket packet;
  Spots spots;
  for (int i = 0; i < kLanes; ++i) {
    packet.Disable(i);
    if (i >= count) continue;
    const auto& [du, dv] = kSubPixels[Index(i % kLooks)];
    Look& look = looks_[first + Index(i)];
    look.ray = world_->image_rays.Beside(on_edge_[(first + Index(i)) / kLooks], v, du, dv);
    packet.Set(i, T_wc_.t, T_wc_.R * look.ray, kNearRay_m);
  }
  const PacketHits found = world_->rays.Nearest(packet);
  for (int i = 0; i < count; ++i) {
    Look& look = looks_[first + Index(i)];
    look.triangle = found.triangle[Index(i)];
    look.lights = cv::Vec3f(0, 0, 0);
    look.lights_seen = Surfaces(v)[on_edge_[(first + Index(i)) / kLooks]] & ~1u;
    if (look.triangle == PacketHits::kNothing) continue;
    const SeenFacet& facet = facets_.At(look.triangle);
    look.z = 1.0 / facet.inverse_depth.dot(look.ray);
    if (!lights_.Empty()) SetSpot(i, facet, look.ray.x(), look.ray.y(), look.z, spots);
  }
  if (lights_.Empty()) return;
  const LightAtSpots lights = LightsAt(spots);
  for (int i = 0; i < count; ++i) looks_[first + Index(i)].lights = lights.light[Index(i)];
}

/// Whether a surface is in the sun at a pixel, as that one and its neighbours say. Empty when
/// fewer than two of them show it, or they differ: then its shadow's edge is near.
std::optional<bool> View::SunAround(int u, int v, std::uint32_t surface) const {
  const int left = std::max(u - 1, 0), right = std::min(u + 1, world_->camera.width - 1);
  const int above = std::max(v - 1, rows_.start), below = std::min(v + 1, rows_.end - 1);
  int shown = 0, lit = 0;
  for (const std::uint32_t seen : {Surfaces(v)[u], Surfaces(v)[left], Surfaces(v)[right],
                                   Surfaces(above)[u], Surfaces(below)[u]}) {
    if ((seen & kSurfaceBits) != surface) continue;
    ++shown;
    lit += static_cast<int>(seen & 1u);
  }
  if (shown < 2 || (lit != 0 && lit != shown)) return std::nullopt;
  return lit != 0;
}

void View::SunOnLooks(int v) {
  RayPacket packet;
  std::array<Look*, kLanes> asked{};
  int count = 0;
  const auto cast = [&] {
    for (int i = count; i < kLanes; ++i) packet.Disable(i);
    const auto blocked = Blocked(packet);
    for (int i = 0; i < count; ++i) asked[Index(i)]->sunlit = !blocked[Index(i)];
    count = 0;
  };
  std::optional<bool> known;
  int known_column = -1;
  std::uint32_t known_surface = 0;
  for (std::size_t k = 0; k < looks_.size(); ++k) {
    Look& look = looks_[k];
    look.sunlit = false;
    if (look.triangle == PacketHits::kNothing) continue;
    const SeenFacet& facet = facets_.At(look.triangle);
    if (!facet.faces_sun) continue;
    // Most looks are far from a shadow's edge, and need no ray of their own. Those at one pixel
    // mostly meet the same surface.
    const int column = on_edge_[k / kLooks];
    if (column != known_column || facet.surface != known_surface) {
      known = SunAround(column, v, facet.surface);
      known_column = column, known_surface = facet.surface;
    }
    if (known) {
      look.sunlit = *known;
      continue;
    }
    packet.Set(count, T_wc_ * (look.z * look.ray) + kLeaveSurface_m * facet.n_w, to_sun_w_,
               0.0F);
    asked[Index(count++)] = &look;
    if (count == kLanes) cast();
  }
  if (count > 0) cast();
}

/// What is the same triangle has one footprint.
cv::Vec3f View::MeanOf(std::span<const Look> looks) {
  cv::Vec3f sum(0, 0, 0);
  std::array<bool, kLooks> done{};
  for (std::size_t i = 0; i < looks.size(); ++i) {
    if (done[i]) continue;
    if (looks[i].triangle == PacketHits::kNothing) {
      sum += kSky;
      continue;
    }
    const SeenFacet& facet = facets_.At(looks[i].triangle);
    std::array<float, kLanes> print_u{}, print_v{};
    std::array<const Look*, kLooks> same{};
    int count = 0;
    // Looks at one triangle are sampled together, with the footprint of the first.
    for (std::size_t k = i; k < looks.size(); ++k) {
      if (looks[k].triangle != looks[i].triangle) continue;
      const auto at =
          PrintAt(facet, looks[k].ray.x(), looks[k].ray.y(), static_cast<float>(looks[k].z));
      print_u[Index(count)] = at[0];
      print_v[Index(count)] = at[1];
      same[Index(count++)] = &looks[k];
      done[k] = true;
    }
    std::array<std::array<float, 4>, kLanes> albedo;
    facets_.Print(facet).Sample(
        print_u.data(), print_v.data(), count,
        Footprint(facet, {print_u[0], print_v[0]}, static_cast<float>(looks[i].z)),
        albedo.data());
    for (int k = 0; k < count; ++k) {
      const Look& look = *same[Index(k)];
      const float light = LightOn(facet, look.ray.x(), look.ray.y(), look.sunlit);
      const auto& a = albedo[Index(k)];
      sum += cv::Vec3f(a[0] * (light + look.lights[0]), a[1] * (light + look.lights[1]),
                       a[2] * (light + look.lights[2]));
      sum += Mirrored(facet, look.ray.x(), look.ray.y(), look.z,
                      look.lights_seen | (look.sunlit ? 1u : 0u));
    }
  }
  return (1.0F / kLooks) * sum;
}

}  // namespace sim
