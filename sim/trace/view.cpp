#include "sim/trace/view.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "sim/trace/pixel_rows.h"

namespace sim {
namespace {

/// The ray tracer takes origins, directions and corners in single precision: 1e-3 px at most
/// for things metres away.
constexpr double kEdgeMargin_px = 0.03;
/// An edge this much behind what a pixel shows cannot be what it shows.
constexpr double kEdgeDepthShare = 0.98;

void Load(std::array<float, kLanes>& lanes, const std::vector<float>& row, int first) {
  std::memcpy(lanes.data(), row.data() + first, sizeof lanes);
}

bool AnyRay(const RayPacket& packet) {
  int any = 0;
  for (const float far : packet.far) any |= far >= 0 ? 1 : 0;
  return any != 0;
}

}  // namespace

void View::RowArrays::Resize(std::size_t size) {
  for (auto* row : {&x, &y, &dx, &dy, &dz}) row->resize(size);
  for (auto* row : {&start_x, &start_y, &start_z, &to_eye_x, &to_eye_y, &to_eye_z}) {
    row->resize(size);
  }
  // Stretches start anywhere, and are read as whole packets.
  for (auto* row : {&print_u, &print_v}) row->resize(size + kLanes);
  sun_far.assign(size, -1.0F);
  eye_far.assign(size, -1.0F);
}

void View::Render(const RenderWorld& world, const Pose& T_wc, const RenderOptions& options,
                  const Surroundings& around, Rendering& out, RayLog* log) {
  world_ = &world;
  around_ = &around;
  to_sun_w_ = around.T_sw.R.transpose() * world.to_sun_w;
  T_wc_ = T_wc;
  options_ = options;
  out_ = &out;
  log_ = log;
  // First which triangle each pixel shows; its neighbours decide where edges are.
  Prepare();
  for (int v = rows_.start; v < rows_.end; ++v) TraceRow(v);
  if (options_.exact_edges) DecideEdges();
  // Then depth, ids and light, row by row; a row's edges are smoothed once the next row is
  // known.
  for (int v = rows_.start; v < rows_.end; ++v) {
    RecordRow(v);
    if (options_.colour) {
      PlacePrints(v);
      CastToSun(v);
      if (!lights_.Empty()) CastToLights(v);
      ShadeRow(v);
      if (v > rows_.start) SmoothEdges(v - 1);
    }
    if (options_.projector_offset_m != 0) CastToEye(v);
  }
  if (options_.colour && rows_.start < rows_.end) SmoothEdges(rows_.end - 1);
}

void View::Prepare() {
  const Camera& camera = world_->camera;
  rows_ = options_.rows == cv::Range::all() ? cv::Range(0, camera.height) : options_.rows;
  const cv::Size size(camera.width, camera.height);
  out_->depth_m.create(size);
  out_->plane_id.create(size);
  out_->object_id.create(size);
  for (cv::Mat1f* image :
       {&out_->incidence_cos, &out_->infrared, &out_->gloss, &out_->mirror_cos}) {
    image->create(size);
  }
  if (options_.projector_offset_m != 0) {
    out_->projector_lit.create(size);
  } else {
    out_->projector_lit.release();
  }
  if (options_.colour) {
    out_->radiance.create(size);
  } else {
    out_->radiance.release();
  }
  eye_w_ = T_wc_ * Eigen::Vector3d(options_.projector_offset_m, 0, 0);
  facets_.Start(*world_, T_wc_, eye_w_, around_->T_sw.R);
  if (around_->coverage != nullptr && options_.colour) around_->coverage->create(size);
  lights_.Start(world_->scene.lights, around_->T_sw);
  lights_row_.resize(lights_.Empty() ? 0 : Index(camera.width));
  stride_ = Index((camera.width + kLanes - 1) / kLanes * kLanes);
  row_.Resize(stride_);
  triangles_.resize(stride_ * Index(camera.height));
  surfaces_.resize(stride_ * Index(camera.height));
}

void View::LoadRow(int v) {
  world_->image_rays.Row(v, row_.x.data(), row_.y.data());
  TurnRays(T_wc_.R, row_.x.data(), row_.y.data(), static_cast<int>(stride_), row_.dx.data(),
           row_.dy.data(), row_.dz.data());
}

void View::TraceRow(int v) {
  LoadRow(v);
  const int width = world_->camera.width, length = static_cast<int>(stride_);
  // The arrays of second rays are free still.
  std::vector<float>&dx = row_.start_x, &dy = row_.start_y, &dz = row_.start_z;
  ToSingle(row_.dx.data(), length, dx.data());
  ToSingle(row_.dy.data(), length, dy.data());
  ToSingle(row_.dz.data(), length, dz.data());
  RayPacket packet;
  for (int i = 0; i < kLanes; ++i) packet.Set(i, T_wc_.t, Eigen::Vector3d::UnitZ(), kNearRay_m);
  for (int u0 = 0; u0 < width; u0 += kLanes) {
    Load(packet.dx, dx, u0);
    Load(packet.dy, dy, u0);
    Load(packet.dz, dz, u0);
    for (int i = width - u0; i < kLanes; ++i) packet.Disable(i);
    if (log_ != nullptr) log_->nearest.push_back(packet);
    const PacketHits found = world_->rays.Nearest(packet);
    std::memcpy(Triangles(v) + u0, found.triangle.data(), sizeof found.triangle);
  }
}

/// Casts again in double where an edge is near that may be seen.
void View::DecideEdges() {
  edges_.clear();
  world_->edges.Near(T_wc_, world_->camera, world_->image_rays.Window(), kEdgeMargin_px,
                     edges_);
  decided_.resize(Index(world_->camera.width) * Index(world_->camera.height), 0);
  for (const EdgePixel& edge : edges_) DecidePixel(edge);
  for (const EdgePixel& edge : edges_) decided_[edge.pixel] = 0;
}

void View::DecidePixel(const EdgePixel& edge) {
  const int u = static_cast<int>(edge.pixel) % world_->camera.width;
  const int v = static_cast<int>(edge.pixel) / world_->camera.width;
  if (decided_[edge.pixel] != 0 || v < rows_.start || v >= rows_.end) return;
  int& triangle = Triangles(v)[u];
  const Eigen::Vector3d ray = world_->image_rays.At(u, v);
  // An edge well behind what the ray tracer found cannot change the answer.
  if (triangle != PacketHits::kNothing) {
    const double shown = facets_.At(triangle).inverse_depth.dot(ray);
    if (!(edge.inverse_depth >= kEdgeDepthShare * shown)) return;
  }
  triangle = world_->caster.Nearest(T_wc_.t, T_wc_.R * ray, kNear_m).triangle;
  decided_[edge.pixel] = 1;
}

void View::RecordRow(int v) {
  LoadRow(v);
  const int* triangles = Triangles(v);
  const int width = world_->camera.width;
  // Neighbours that show one triangle are worked out together.
  for (int first = 0, last = 0; first < width; first = last) {
    while (last < width && triangles[last] == triangles[first]) ++last;
    if (triangles[first] == PacketHits::kNothing) {
      RecordSky(v, first, last);
    } else {
      RecordRun(v, first, last, facets_.At(triangles[first]));
    }
  }
}

void View::RecordSky(int v, int first, int last) {
  const auto fill = [&](auto* row, auto value) { std::fill(row + first, row + last, value); };
  fill(out_->depth_m[v], 0.0);
  for (cv::Mat1f* image :
       {&out_->incidence_cos, &out_->infrared, &out_->gloss, &out_->mirror_cos}) {
    fill((*image)[v], 0.0F);
  }
  fill(out_->plane_id[v], ushort{0});
  fill(out_->object_id[v], ushort{0});
  fill(Surfaces(v), std::uint32_t{0});
  fill(row_.sun_far.data(), -1.0F);
  fill(row_.eye_far.data(), -1.0F);
}

void View::RecordRun(int v, int first, int last, const SeenFacet& facet) {
  MeetPlane(
      {facet.inverse_depth, facet.n_c, T_wc_.t + kLeaveSurface_m * facet.n_w, eye_w_}, first,
      last,
      {row_.x.data(), row_.y.data(), row_.dx.data(), row_.dy.data(), row_.dz.data(),
       out_->depth_m[v], out_->incidence_cos[v], row_.start_x.data(), row_.start_y.data(),
       row_.start_z.data(), row_.to_eye_x.data(), row_.to_eye_y.data(), row_.to_eye_z.data()});
  const auto fill = [&](auto* row, auto value) { std::fill(row + first, row + last, value); };
  fill(out_->plane_id[v], ushort{facet.plane});
  fill(out_->object_id[v], ushort{facet.object});
  fill(out_->infrared[v], facet.infrared);
  fill(out_->gloss[v], facet.gloss);
  if (facet.gloss > 0) {
    const Eigen::Vector3d projector_c(options_.projector_offset_m, 0, 0);
    MirrorCosines(facet.n_c, projector_c, row_.x.data(), row_.y.data(), out_->depth_m[v], first,
                  last, out_->mirror_cos[v]);
  } else {
    fill(out_->mirror_cos[v], 0.0F);
  }
  fill(Surfaces(v), facet.surface);
  fill(row_.sun_far.data(), facet.faces_sun ? std::numeric_limits<float>::infinity() : -1.0F);
  fill(row_.eye_far.data(), facet.faces_eye ? 1.0F : -1.0F);
}

std::array<bool, kLanes> View::Blocked(const RayPacket& packet) const {
  auto blocked = world_->rays.Blocked(packet);
  for (const Blocker& other : around_->others) {
    // The same rays in the other world's frame; those already blocked are not cast again.
    RayPacket moved;
    for (int i = 0; i < kLanes; ++i) {
      const std::size_t k = Index(i);
      const Eigen::Vector3f start(packet.x[k], packet.y[k], packet.z[k]);
      const Eigen::Vector3f way(packet.dx[k], packet.dy[k], packet.dz[k]);
      moved.Set(i, other.T_bw * start.cast<double>(), other.T_bw.R * way.cast<double>(),
                packet.near[k], blocked[k] ? -1.0F : packet.far[k]);
    }
    const auto by_it = other.rays->Blocked(moved);
    for (std::size_t k = 0; k < by_it.size(); ++k) blocked[k] = blocked[k] || by_it[k];
  }
  return blocked;
}

void View::CastToSun(int v) {
  RayPacket packet;
  for (int i = 0; i < kLanes; ++i) {
    packet.Set(i, Eigen::Vector3d::Zero(), to_sun_w_, 0.0F);
  }
  std::uint32_t* surfaces = Surfaces(v);
  for (int u0 = 0; u0 < world_->camera.width; u0 += kLanes) {
    Load(packet.far, row_.sun_far, u0);
    if (!AnyRay(packet)) continue;
    Load(packet.x, row_.start_x, u0);
    Load(packet.y, row_.start_y, u0);
    Load(packet.z, row_.start_z, u0);
    if (log_ != nullptr) log_->blocked.push_back(packet);
    const auto blocked = Blocked(packet);
    for (int i = 0; i < kLanes; ++i) {
      if (packet.far[Index(i)] > 0 && !blocked[Index(i)]) surfaces[u0 + i] |= 1u;
    }
  }
}

void View::CastToEye(int v) {
  RayPacket packet;
  uchar* lit = out_->projector_lit[v];
  const int width = world_->camera.width;
  for (int u0 = 0; u0 < width; u0 += kLanes) {
    const int lanes = std::min(kLanes, width - u0);
    std::fill_n(lit + u0, lanes, uchar{0});
    Load(packet.far, row_.eye_far, u0);
    if (!AnyRay(packet)) continue;
    Load(packet.x, row_.start_x, u0);
    Load(packet.y, row_.start_y, u0);
    Load(packet.z, row_.start_z, u0);
    Load(packet.dx, row_.to_eye_x, u0);
    Load(packet.dy, row_.to_eye_y, u0);
    Load(packet.dz, row_.to_eye_z, u0);
    if (log_ != nullptr) log_->blocked.push_back(packet);
    const auto blocked = Blocked(packet);
    for (int i = 0; i < lanes; ++i) {
      if (packet.far[Index(i)] > 0 && !blocked[Index(i)]) lit[u0 + i] = 255;
    }
  }
}

}  // namespace sim
