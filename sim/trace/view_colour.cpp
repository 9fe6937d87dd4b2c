// The colour of a view's pixels.
#include <algorithm>
#include <cmath>

#include "sim/trace/pixel_rows.h"
#include "sim/trace/view.h"

namespace sim {
namespace {

constexpr int kLanes = RayPacket::kLanes;
/// Four rays an edge pixel: a rotated grid, the same in each pixel.
constexpr std::array<std::array<double, 2>, 4> kSubPixels{
    {{-0.125, -0.375}, {0.375, -0.125}, {0.125, 0.375}, {-0.375, 0.125}}};

}  // namespace

/// Unit normal to shade by at the spot that the ray (x, y, 1) meets.
Eigen::Vector3d View::NormalAt(const SeenFacet& facet, double x, double y) const {
  if (facet.flat) return facet.n_w;
  // Barycentric weights in double, which the ray tracer's are not the same on every processor.
  const Eigen::Vector3d d = T_wc_.R * Eigen::Vector3d(x, y, 1.0);
  const auto& corners = world_->mesh.triangles[Index(facet.triangle)].corners_w;
  const Eigen::Vector3d a = corners[0] - T_wc_.t, b = corners[1] - T_wc_.t,
                        c = corners[2] - T_wc_.t;
  const double ab = d.dot(a.cross(b)), bc = d.dot(b.cross(c)), ca = d.dot(c.cross(a));
  const double sum = ab + bc + ca;
  return sum != 0 ? world_->surfaces.ShadingNormal(facet.triangle, ca / sum, ab / sum)
                  : facet.n_w;
}

/// Light of the sun, and from all round, on the spot that the ray (x, y, 1) meets.
float View::LightOn(const SeenFacet& facet, double x, double y, bool sunlit) const {
  if (facet.flat) return sunlit ? facet.lit : facet.unlit;
  return LightOnNormal(world_->scene.sun, world_->to_sun_w,
                       around_->T_sw.R * NormalAt(facet, x, y), sunlit);
}

std::array<float, 2> View::PrintAt(const SeenFacet& facet, double x, double y, float z) {
  const auto& uv = facet.uv_over_depth;
  const float fx = static_cast<float>(x), fy = static_cast<float>(y);
  return {z * (uv(0, 0) * fx + uv(0, 1) * fy + uv(0, 2)),
          z * (uv(1, 0) * fx + uv(1, 1) * fy + uv(1, 2))};
}

TextureFootprint View::Footprint(const SeenFacet& facet, const std::array<float, 2>& at,
                                 float z) {
  const auto& uv = facet.uv_over_depth;
  const float right = z / static_cast<float>(world_->camera.fx);
  const float down = z / static_cast<float>(world_->camera.fy);
  const auto along_x = static_cast<float>(facet.inverse_depth.x());
  const auto along_y = static_cast<float>(facet.inverse_depth.y());
  return facets_.Print(facet).Footprint(
      {(uv(0, 0) - at[0] * along_x) * right, (uv(1, 0) - at[1] * along_x) * right,
       (uv(0, 1) - at[0] * along_y) * down, (uv(1, 1) - at[1] * along_y) * down});
}

cv::Vec3f View::Shade(const SeenFacet& facet, double x, double y, float z, bool sunlit,
                      const cv::Vec3f& lights) {
  const std::array<float, 2> at = PrintAt(facet, x, y, z);
  const std::array<float, 4> albedo =
      facets_.Print(facet).Sample(at[0], at[1], Footprint(facet, at, z));
  const float light = LightOn(facet, x, y, sunlit);
  return {albedo[0] * (light + lights[0]), albedo[1] * (light + lights[1]),
          albedo[2] * (light + lights[2])};
}

/// Works out where on the prints the row looks, and has them fetched while rays are cast.
void View::PlacePrints(int v) {
  static_assert(kLanes == Texture::kLanes);
  const int* triangles = Triangles(v);
  const double* depth = out_->depth_m[v];
  const int width = world_->camera.width;
  stretches_.clear();
  for (int first = 0, last = 0; first < width; first = last) {
    const int triangle = triangles[first], most = std::min(first + kLanes, width);
    while (last < most && triangles[last] == triangle) ++last;
    stretches_.push_back({first, last, triangle, nullptr, {}});
    if (triangle == PacketHits::kNothing) continue;
    const SeenFacet& facet = facets_.At(triangle);
    PlaceOnPrint(facet.uv_over_depth, row_.x.data(), row_.y.data(), depth, first, last,
                 row_.print_u.data(), row_.print_v.data());
    Stretch& stretch = stretches_.back();
    const std::size_t middle = Index((first + last) / 2);
    stretch.print = &facets_.Print(facet);
    stretch.footprint = Footprint(facet, {row_.print_u[middle], row_.print_v[middle]},
                                  static_cast<float>(depth[middle]));
    stretch.print->Prefetch(row_.print_u.data() + first, row_.print_v.data() + first,
                            last - first, stretch.footprint);
  }
}

void View::ShadeRun(int v, const Stretch& stretch) {
  const SeenFacet& facet = facets_.At(stretch.triangle);
  const std::uint32_t* surfaces = Surfaces(v);
  cv::Vec3f* colour = out_->radiance[v];
  std::array<std::array<float, 4>, kLanes> albedo;
  const int first = stretch.first;
  stretch.print->Sample(row_.print_u.data() + first, row_.print_v.data() + first,
                        stretch.last - first, stretch.footprint, albedo.data());
  for (int u = first; u < stretch.last; ++u) {
    const std::array<float, 4>& a = albedo[Index(u - first)];
    const float light =
        LightOn(facet, row_.x[Index(u)], row_.y[Index(u)], (surfaces[u] & 1u) != 0);
    const cv::Vec3f lights = lights_.Empty() ? cv::Vec3f(0, 0, 0) : lights_row_[Index(u)];
    colour[u] = cv::Vec3f(a[0] * (light + lights[0]), a[1] * (light + lights[1]),
                          a[2] * (light + lights[2]));
  }
}

void View::ShadeRow(int v) {
  for (const Stretch& stretch : stretches_) {
    const bool sky = stretch.triangle == PacketHits::kNothing;
    if (around_->coverage != nullptr) {
      std::fill((*around_->coverage)[v] + stretch.first, (*around_->coverage)[v] + stretch.last,
                static_cast<uchar>(sky ? 0 : 4));
    }
    if (sky) {
      std::fill(out_->radiance[v] + stretch.first, out_->radiance[v] + stretch.last, kSky);
    } else {
      ShadeRun(v, stretch);
    }
  }
}

/// Pixels of a row where a neighbour shows another surface or another side of a shadow's edge.
void View::MarkEdges(int v, std::vector<int>& pixels) const {
  const int width = world_->camera.width;
  const std::uint32_t* here = Surfaces(v);
  const std::uint32_t* above = Surfaces(std::max(v - 1, rows_.start));
  const std::uint32_t* below = Surfaces(std::min(v + 1, rows_.end - 1));
  for (int u = 0; u < width; ++u) {
    const int left = std::max(u - 1, 0), right = std::min(u + 1, width - 1);
    const std::uint32_t differs = (here[u] ^ here[left]) | (here[u] ^ here[right]) |
                                  (here[u] ^ above[u]) | (here[u] ^ below[u]);
    if (differs != 0) pixels.push_back(v * width + u);
  }
}

/// Of one row, when the next is known: its prints are at hand still.
void View::SmoothEdges(int v) {
  on_edge_.clear();
  MarkEdges(v, on_edge_);
  for (std::size_t i = 0; i < on_edge_.size(); i += 2) {
    SmoothPair(on_edge_[i], on_edge_[std::min(i + 1, on_edge_.size() - 1)]);
  }
}

/// Two pixels, four rays each: one packet.
void View::SmoothPair(int a, int b) {
  const int width = world_->camera.width;
  std::array<Eigen::Vector3d, kLanes> rays;
  RayPacket packet, to_sun;
  Spots spots;
  for (int i = 0; i < kLanes; ++i) {
    const int pixel = i < 4 ? a : b;
    const auto& [du, dv] = kSubPixels[Index(i % 4)];
    rays[Index(i)] = world_->image_rays.Beside(pixel % width, pixel / width, du, dv);
    packet.Set(i, T_wc_.t, T_wc_.R * rays[Index(i)], kNear_m);
  }
  const PacketHits found = world_->rays.Nearest(packet);
  std::array<double, kLanes> z{};
  bool any = false;
  for (int i = 0; i < kLanes; ++i) {
    to_sun.Disable(i);
    if (found.triangle[Index(i)] == PacketHits::kNothing) continue;
    const SeenFacet& facet = facets_.At(found.triangle[Index(i)]);
    z[Index(i)] = 1.0 / facet.inverse_depth.dot(rays[Index(i)]);
    if (!lights_.Empty()) {
      SetSpot(i, facet, rays[Index(i)].x(), rays[Index(i)].y(), z[Index(i)], spots);
    }
    if (!facet.faces_sun) continue;
    any = true;
    to_sun.Set(i, T_wc_ * (z[Index(i)] * rays[Index(i)]) + kLeaveSurface_m * facet.n_w,
               to_sun_w_, 0.0F);
  }
  std::array<bool, kLanes> blocked{};
  if (any) blocked = Blocked(to_sun);
  LightAtSpots lights;
  if (!lights_.Empty()) lights = LightsAt(spots);
  std::array<cv::Vec3f, 2> sum{cv::Vec3f(0, 0, 0), cv::Vec3f(0, 0, 0)};
  for (int i = 0; i < kLanes; ++i) {
    const std::size_t k = Index(i);
    if (found.triangle[k] == PacketHits::kNothing) {
      sum[k / 4] += kSky;
      continue;
    }
    const SeenFacet& facet = facets_.At(found.triangle[k]);
    sum[k / 4] += Shade(facet, rays[k].x(), rays[k].y(), static_cast<float>(z[k]),
                        facet.faces_sun && !blocked[k], lights.light[k]);
  }
  for (const auto& [pixel, k] : {std::pair(a, 0), std::pair(b, 1)}) {
    out_->radiance(pixel / width, pixel % width) = 0.25F * sum[Index(k)];
    if (around_->coverage == nullptr) continue;
    const auto first = found.triangle.begin() + 4 * k;
    (*around_->coverage)(pixel / width, pixel % width) =
        static_cast<uchar>(4 - std::count(first, first + 4, PacketHits::kNothing));
  }
}

}  // namespace sim
