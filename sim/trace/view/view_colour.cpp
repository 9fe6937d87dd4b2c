// The colour of a view's pixels.
#include <algorithm>
#include <cmath>

#include "sim/trace/mirror_light.h"
#include "sim/trace/pixel_rows.h"
#include "sim/trace/view/view.h"

namespace sim {
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

cv::Vec3f View::Mirrored(const SeenFacet& facet, double x, double y, double z,
                         std::uint32_t surface) const {
  if (!(world_->reflections > 0 && facet.gloss > 0)) return {0, 0, 0};
  const Eigen::Vector3d ray_w = T_wc_.R * Eigen::Vector3d(x, y, 1.0);
  const Pose& T_sw = around_->T_sw;
  MirrorSpot spot;
  spot.x_w = T_sw * (T_wc_.t + z * ray_w);
  spot.look_w = T_sw.R * ray_w.normalized();
  spot.n_w = T_sw.R * NormalAt(facet, x, y);
  spot.sunlit = (surface & 1u) != 0;
  spot.lights_seen = surface >> kLightBit;
  return static_cast<float>(world_->reflections) * facet.gloss *
         MirrorLight(world_->scene, world_->to_sun_w, spot);
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
  const bool mirrors = world_->reflections > 0 && facet.gloss > 0;
  for (int u = first; u < stretch.last; ++u) {
    const std::array<float, 4>& a = albedo[Index(u - first)];
    const float light =
        LightOn(facet, row_.x[Index(u)], row_.y[Index(u)], (surfaces[u] & 1u) != 0);
    const cv::Vec3f lights = lights_.Empty() ? cv::Vec3f(0, 0, 0) : lights_row_[Index(u)];
    colour[u] = cv::Vec3f(a[0] * (light + lights[0]), a[1] * (light + lights[1]),
                          a[2] * (light + lights[2]));
    if (mirrors) {
      colour[u] +=
          Mirrored(facet, row_.x[Index(u)], row_.y[Index(u)], out_->depth_m(v, u), surfaces[u]);
    }
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

}  // namespace sim
