#include "sim/trace/frame_renderer.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "sim/trace/edge_pixels.h"
#include "sim/trace/exact_cast.h"
#include "sim/trace/ray_scene.h"
#include "sim/trace/surface.h"

namespace sim {
namespace {

constexpr float kNear_m = 1e-3F;  ///< nothing is seen closer than this
/// The ray tracer takes origins, directions and corners in single precision: 1e-3 px at most
/// for things metres away.
constexpr double kEdgeMargin_px = 0.03;
/// An edge this much behind what a pixel shows cannot be what it shows.
constexpr double kEdgeDepthShare = 0.98;
constexpr double kLeaveSurface_m = 1e-4;  ///< second rays start this far off the surface
const Eigen::Array3f kSky(0.55F, 0.6F, 0.66F);
/// Four rays an edge pixel: a rotated grid, the same in each pixel.
constexpr std::array<std::array<double, 2>, 4> kSubPixels{
    {{-0.125, -0.375}, {0.375, -0.125}, {0.125, 0.375}, {-0.375, 0.125}}};

/// One ray's answer.
struct Hit {
  int triangle = PacketHits::kNothing;
  float b1 = 0, b2 = 0;
  bool sunlit = false;
};

std::vector<Triangle> TrianglesOf(const SceneMesh& mesh, int object) {
  std::vector<Triangle> own;
  std::copy_if(mesh.triangles.begin(), mesh.triangles.end(), std::back_inserter(own),
               [&](const Triangle& triangle) { return triangle.object == object; });
  return own;
}

void CheckIds(const Scene& scene, const SceneMesh& mesh) {
  const auto fits = [](int id) { return id >= 0 && id <= 65535; };
  for (const Object& object : scene.objects) {
    if (!fits(object.id) || object.id == 0) {
      throw std::invalid_argument("object id " + std::to_string(object.id) +
                                  ": expected 1 to 65535, as id images have 16 bits");
    }
  }
  for (const Triangle& triangle : mesh.triangles) {
    if (!fits(triangle.plane)) throw std::invalid_argument("more than 65535 planes");
  }
}

}  // namespace

struct FrameRenderer::World {
  World(const Scene& scene_in, const Camera& camera_in, InstructionSet set)
      : scene(scene_in),
        camera(camera_in),
        mesh(BuildMesh(scene)),
        rays(mesh.triangles, set),
        edges(mesh.triangles),
        caster(mesh.triangles),
        surfaces(scene, mesh, camera),
        to_sun_w(-scene.sun.direction_w.normalized()) {
    CheckIds(scene, mesh);
    for (const Object& object : scene.objects) {
      alone.emplace_back(TrianglesOf(mesh, object.id), set);
    }
  }
  Scene scene;
  Camera camera;
  SceneMesh mesh;
  RayScene rays;
  SceneEdges edges;
  ExactCaster caster;
  SurfaceTable surfaces;
  Eigen::Vector3d to_sun_w;
  std::vector<RayScene> alone;  ///< by object
};

namespace {

/// The work of one Render call.
template <typename World>
class View {
 public:
  View(const World& world, const Pose& T_wc, const RenderOptions& options)
      : world_(world),
        camera_(world.camera),
        T_wc_(T_wc),
        options_(options),
        rows_(options.rows == cv::Range::all() ? cv::Range(0, camera_.height) : options.rows),
        facets_(world.surfaces.InView(T_wc)),
        hits_(static_cast<std::size_t>(camera_.width) *
              static_cast<std::size_t>(camera_.height)) {}

  Rendering Run() {
    const cv::Size size(camera_.width, camera_.height);
    out_.depth_m = cv::Mat1d(size, 0.0);
    out_.plane_id = cv::Mat1w(size, ushort{0});
    out_.object_id = cv::Mat1w(size, ushort{0});
    out_.incidence_cos = cv::Mat1f(size, 0.0F);
    if (options_.projector_offset_m != 0) out_.projector_lit = cv::Mat1b(size, uchar{0});
    if (options_.colour) out_.radiance = cv::Mat3f(size);
    if (options_.exact_edges) edges_ = world_.edges.Near(T_wc_, camera_, kEdgeMargin_px);
    for (int v = rows_.start; v < rows_.end; ++v) TraceRow(v);
    if (options_.colour) {
      for (int v = rows_.start; v < rows_.end; ++v) ShadeRow(v);
      SmoothEdges();
    }
    return std::move(out_);
  }

 private:
  static constexpr int kLanes = RayPacket::kLanes;

  void TraceRow(int v) {
    for (int u0 = 0; u0 < camera_.width; u0 += kLanes) {
      RayPacket packet;
      for (int i = 0; i < kLanes; ++i) {
        if (u0 + i < camera_.width) {
          packet.Set(i, T_wc_.t, T_wc_.R * camera_.Ray(u0 + i, v), kNear_m);
        } else {
          packet.Disable(i);
        }
      }
      const PacketHits found = world_.rays.Nearest(packet);
      std::array<Hit, kLanes> hits;
      std::array<Eigen::Vector3d, kLanes> points_w;
      for (int i = 0; i < kLanes && u0 + i < camera_.width; ++i) {
        hits[Index(i)] = Take(found, i);
        if (options_.exact_edges) Decide(u0 + i, v, hits[Index(i)]);
        points_w[Index(i)] = Record(u0 + i, v, hits[Index(i)]);
      }
      if (options_.colour) CastToSun(points_w, hits);
      if (!out_.projector_lit.empty()) CastToProjector(u0, v, points_w, hits);
      for (int i = 0; i < kLanes && u0 + i < camera_.width; ++i) {
        At(u0 + i, v) = hits[Index(i)];
      }
    }
  }

  /// Casts again in double where an edge is near that may be seen. Pixels come in order.
  void Decide(int u, int v, Hit& hit) {
    const auto pixel = static_cast<std::uint32_t>(v * camera_.width + u);
    double nearest_edge = 0;
    for (; next_edge_ < edges_.size() && edges_[next_edge_].pixel == pixel; ++next_edge_) {
      nearest_edge = edges_[next_edge_].inverse_depth;  // the nearest comes last
    }
    const Eigen::Vector3d ray = camera_.Ray(u, v);
    const bool nothing = hit.triangle == PacketHits::kNothing;
    const bool near_edge =
        nearest_edge > 0 &&
        (nothing ||
         nearest_edge >= kEdgeDepthShare * facets_[Index(hit.triangle)].inverse_depth.dot(ray));
    const bool flat = nothing || world_.mesh.triangles[Index(hit.triangle)].plane > 0;
    if (near_edge) {
      const ExactHit exact =
          world_.caster.Nearest(T_wc_.t, T_wc_.R * ray, static_cast<double>(kNear_m));
      hit.triangle = exact.triangle;
      hit.b1 = static_cast<float>(exact.b1);
      hit.b2 = static_cast<float>(exact.b2);
    } else if (!flat) {
      SetWeights(ray, hit);
    }
  }

  /// Barycentric weights in double, which the ray tracer's are not the same on every processor.
  void SetWeights(const Eigen::Vector3d& ray, Hit& hit) const {
    const Eigen::Vector3d d = T_wc_.R * ray;
    const auto& corners = world_.mesh.triangles[Index(hit.triangle)].corners_w;
    const Eigen::Vector3d a = corners[0] - T_wc_.t, b = corners[1] - T_wc_.t,
                          c = corners[2] - T_wc_.t;
    const double ab = d.dot(a.cross(b)), bc = d.dot(b.cross(c)), ca = d.dot(c.cross(a));
    const double sum = ab + bc + ca;
    if (!(sum != 0)) return;
    hit.b1 = static_cast<float>(ca / sum);
    hit.b2 = static_cast<float>(ab / sum);
  }

  /// Writes depth, ids and incidence of a pixel; returns where it lies.
  Eigen::Vector3d Record(int u, int v, const Hit& hit) {
    if (hit.triangle == PacketHits::kNothing) return Eigen::Vector3d::Zero();
    const Eigen::Vector3d ray = camera_.Ray(u, v);
    const FacetInView& facet = facets_[Index(hit.triangle)];
    const double z = 1.0 / facet.inverse_depth.dot(ray);
    const Triangle& triangle = world_.mesh.triangles[Index(hit.triangle)];
    out_.depth_m(v, u) = z;
    out_.plane_id(v, u) = static_cast<ushort>(triangle.plane);
    out_.object_id(v, u) = static_cast<ushort>(triangle.object);
    out_.incidence_cos(v, u) = static_cast<float>(std::abs(facet.n_c.dot(ray)) / ray.norm());
    return T_wc_ * (z * ray);
  }

  void CastToSun(const std::array<Eigen::Vector3d, kLanes>& points_w,
                 std::array<Hit, kLanes>& hits) const {
    RayPacket packet;
    bool any = false;
    for (int i = 0; i < kLanes; ++i) {
      packet.Disable(i);
      Hit& hit = hits[Index(i)];
      if (hit.triangle == PacketHits::kNothing) continue;
      const Eigen::Vector3d& n_w = world_.surfaces.Normal(hit.triangle);
      hit.sunlit = n_w.dot(world_.to_sun_w) > 0;
      if (!hit.sunlit) continue;
      any = true;
      packet.Set(i, points_w[Index(i)] + kLeaveSurface_m * n_w, world_.to_sun_w, 0.0F);
    }
    if (!any) return;
    const auto blocked = world_.rays.Blocked(packet);
    for (int i = 0; i < kLanes; ++i) {
      if (blocked[Index(i)]) hits[Index(i)].sunlit = false;
    }
  }

  void CastToProjector(int u0, int v, const std::array<Eigen::Vector3d, kLanes>& points_w,
                       const std::array<Hit, kLanes>& hits) {
    const Eigen::Vector3d projector_w =
        T_wc_ * Eigen::Vector3d(options_.projector_offset_m, 0, 0);
    RayPacket packet;
    std::array<bool, kLanes> facing{};
    for (int i = 0; i < kLanes; ++i) {
      packet.Disable(i);
      if (hits[Index(i)].triangle == PacketHits::kNothing) continue;
      const Eigen::Vector3d& n_w = world_.surfaces.Normal(hits[Index(i)].triangle);
      const Eigen::Vector3d start = points_w[Index(i)] + kLeaveSurface_m * n_w;
      facing[Index(i)] = n_w.dot(projector_w - start) > 0;
      if (facing[Index(i)]) packet.Set(i, start, projector_w - start, 0.0F, 1.0F);
    }
    const auto blocked = world_.rays.Blocked(packet);
    for (int i = 0; i < kLanes && u0 + i < camera_.width; ++i) {
      if (facing[Index(i)] && !blocked[Index(i)]) out_.projector_lit(v, u0 + i) = 255;
    }
  }

  Eigen::Array3f Shade(const Hit& hit, double u, double v) const {
    if (hit.triangle == PacketHits::kNothing) return kSky;
    const FacetInView& facet = facets_[Index(hit.triangle)];
    const Eigen::Vector3d ray = camera_.Ray(u, v);
    const float z = static_cast<float>(1.0 / facet.inverse_depth.dot(ray));
    const Eigen::Vector2f uv = z * (facet.uv_over_depth * ray.cast<float>());
    const auto step = [&](int axis, double focal) -> Eigen::Vector2f {
      const float along = static_cast<float>(facet.inverse_depth[axis]);
      return (facet.uv_over_depth.col(axis) - uv * along) * (z / static_cast<float>(focal));
    };
    const Texture& print = world_.surfaces.Print(hit.triangle);
    const Eigen::Array3f albedo = print.Sample(uv, step(0, camera_.fx), step(1, camera_.fy));
    const Eigen::Vector3d n_w = world_.surfaces.ShadingNormal(hit.triangle, hit.b1, hit.b2);
    const Sun& sun = world_.scene.sun;
    // Light from all round, a little less from below: unlit faces still differ.
    double light = sun.ambient * (0.8 + 0.12 * n_w.z() + 0.08 * n_w.x());
    if (hit.sunlit) light += sun.intensity * std::max(0.0, n_w.dot(world_.to_sun_w));
    return albedo * static_cast<float>(light);
  }

  void ShadeRow(int v) {
    for (int u = 0; u < camera_.width; ++u) Store(u, v, Shade(At(u, v), u, v));
  }

  /// True where a neighbour shows another surface or another side of a shadow's edge.
  bool OnEdge(int u, int v) const {
    const Hit& here = At(u, v);
    const auto differs = [&](int du, int dv) {
      const int x = u + du, y = v + dv;
      if (x < 0 || y < rows_.start || x >= camera_.width || y >= rows_.end) return false;
      return out_.plane_id(y, x) != out_.plane_id(v, u) ||
             out_.object_id(y, x) != out_.object_id(v, u) || At(x, y).sunlit != here.sunlit;
    };
    return differs(1, 0) || differs(-1, 0) || differs(0, 1) || differs(0, -1);
  }

  void SmoothEdges() {
    std::vector<cv::Point> edge;
    for (int v = rows_.start; v < rows_.end; ++v) {
      for (int u = 0; u < camera_.width; ++u) {
        if (OnEdge(u, v)) edge.emplace_back(u, v);
      }
    }
    for (std::size_t i = 0; i < edge.size(); i += 2) {
      SmoothPair(edge[i], edge[std::min(i + 1, edge.size() - 1)]);
    }
  }

  /// Two pixels, four rays each: one packet.
  void SmoothPair(cv::Point a, cv::Point b) {
    std::array<Eigen::Vector2d, kLanes> where;
    RayPacket packet;
    for (int i = 0; i < kLanes; ++i) {
      const cv::Point pixel = i < 4 ? a : b;
      const auto& offset = kSubPixels[Index(i % 4)];
      where[Index(i)] = {pixel.x + offset[0], pixel.y + offset[1]};
      packet.Set(i, T_wc_.t, T_wc_.R * camera_.Ray(where[Index(i)].x(), where[Index(i)].y()),
                 kNear_m);
    }
    const PacketHits found = world_.rays.Nearest(packet);
    std::array<Hit, kLanes> hits;
    std::array<Eigen::Vector3d, kLanes> points_w;
    for (int i = 0; i < kLanes; ++i) {
      hits[Index(i)] = Take(found, i);
      if (hits[Index(i)].triangle == PacketHits::kNothing) continue;
      const Eigen::Vector3d ray = camera_.Ray(where[Index(i)].x(), where[Index(i)].y());
      if (options_.exact_edges) SetWeights(ray, hits[Index(i)]);
      const FacetInView& facet = facets_[Index(hits[Index(i)].triangle)];
      points_w[Index(i)] = T_wc_ * (ray / facet.inverse_depth.dot(ray));
    }
    CastToSun(points_w, hits);
    std::array<Eigen::Array3f, 2> sum{Eigen::Array3f::Zero(), Eigen::Array3f::Zero()};
    for (int i = 0; i < kLanes; ++i) {
      sum[Index(i / 4)] += Shade(hits[Index(i)], where[Index(i)].x(), where[Index(i)].y());
    }
    Store(a.x, a.y, 0.25F * sum[0]);
    Store(b.x, b.y, 0.25F * sum[1]);
  }

  static std::size_t Index(int i) { return static_cast<std::size_t>(i); }
  static Hit Take(const PacketHits& found, int lane) {
    const std::size_t i = Index(lane);
    return {found.triangle[i], found.b1[i], found.b2[i], false};
  }
  void Store(int u, int v, const Eigen::Array3f& colour) {
    out_.radiance(v, u) = cv::Vec3f(colour[0], colour[1], colour[2]);
  }
  Hit& At(int u, int v) { return hits_[Index(v) * Index(camera_.width) + Index(u)]; }
  const Hit& At(int u, int v) const {
    return hits_[Index(v) * Index(camera_.width) + Index(u)];
  }

  const World& world_;
  const Camera& camera_;
  const Pose& T_wc_;
  const RenderOptions& options_;
  cv::Range rows_;  ///< to render
  std::vector<FacetInView> facets_;
  std::vector<Hit> hits_;
  std::vector<EdgePixel> edges_;  ///< in the order of pixels
  std::size_t next_edge_ = 0;
  Rendering out_;
};

}  // namespace

FrameRenderer::FrameRenderer(const Scene& scene, const Camera& camera, InstructionSet set)
    : world_(std::make_unique<const World>(scene, camera, set)) {}
FrameRenderer::~FrameRenderer() = default;
FrameRenderer::FrameRenderer(FrameRenderer&&) noexcept = default;

Rendering FrameRenderer::Render(const Pose& T_wc, const RenderOptions& options) const {
  return View<World>(*world_, T_wc, options).Run();
}

int FrameRenderer::UnoccludedPixels(std::size_t object_index, const Pose& T_wc,
                                    const cv::Rect& where, const cv::Mat1w& object_id) const {
  const Camera& camera = world_->camera;
  const cv::Rect area = where & cv::Rect(0, 0, camera.width, camera.height);
  const auto own = static_cast<ushort>(world_->scene.objects.at(object_index).id);
  int count = 0;
  for (int v = area.y; v < area.y + area.height; ++v) {
    RayPacket packet;
    int lane = 0;
    const auto cast = [&] {
      for (int i = lane; i < RayPacket::kLanes; ++i) packet.Disable(i);
      const auto blocked = world_->alone[object_index].Blocked(packet);
      count += static_cast<int>(std::count(blocked.begin(), blocked.end(), true));
      lane = 0;
    };
    for (int u = area.x; u < area.x + area.width; ++u) {
      if (object_id(v, u) == own) {
        ++count;
        continue;
      }
      packet.Set(lane++, T_wc.t, T_wc.R * camera.Ray(u, v), kNear_m);
      if (lane == RayPacket::kLanes) cast();
    }
    if (lane > 0) cast();
  }
  return count;
}

bool FrameRenderer::Sees(const Pose& T_wc, const Eigen::Vector3d& x_w) const {
  const Eigen::Vector3d ray_w = x_w - T_wc.t;
  const ExactHit hit = world_->caster.Nearest(T_wc.t, ray_w, 0.0);
  return hit.triangle < 0 || (1 - hit.distance) * ray_w.norm() <= kLeaveSurface_m;
}

const Camera& FrameRenderer::camera() const { return world_->camera; }
const Scene& FrameRenderer::scene() const { return world_->scene; }

}  // namespace sim
