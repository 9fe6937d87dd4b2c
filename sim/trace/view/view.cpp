#include "sim/trace/view/view.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/trace/pixel_rows.h"

namespace sim {
namespace {

/// The ray tracer takes origins, directions and corners in single precision: 1e-3 px at most
/// for things metres away.
constexpr double kEdgeMargin_px = 0.03;
/// An edge this much behind what a pixel shows cannot be what it shows.
constexpr double kEdgeDepthShare = 0.98;

}  // namespace

void View::RowArrays::Resize(std::size_t size) {
  for (auto* row : {&x, &y, &dx, &dy, &dz}) row->resize(size);
  for (auto* row : {&start_x, &start_y, &start_z, &to_eye_x, &to_eye_y, &to_eye_z}) {
    row->resize(size);
  }
  // Stretches start anywhere, and are read as whole packets.
  for (auto* row : {&print_u, &print_v}) row->resize(size + kLanes);
  for (auto* row : {&sun_far, &eye_far, &view_far}) row->assign(size, -1.0F);
  blocked.resize(size);
}

/// What the rays of all rows have in common.
void View::RowArrays::FillConstants(std::size_t width, const Eigen::Vector3d& camera_w,
                                    const Eigen::Vector3d& to_sun_w) {
  const std::size_t size = view_far.size();
  std::fill_n(view_far.begin(), width, std::numeric_limits<float>::infinity());
  view_near.assign(size, kNearRay_m);
  zero.assign(size, 0.0F);
  const auto fill = [&](const Eigen::Vector3d& vector_w, auto& across, auto& along, auto& up) {
    across.assign(size, static_cast<float>(vector_w.x()));
    along.assign(size, static_cast<float>(vector_w.y()));
    up.assign(size, static_cast<float>(vector_w.z()));
  };
  fill(camera_w, camera_x, camera_y, camera_z);
  fill(to_sun_w, to_sun_x, to_sun_y, to_sun_z);
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
  Trace();
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
    if (options_.sensed) {
      image->create(size);
    } else {
      image->release();
    }
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
  row_.FillConstants(Index(camera.width), T_wc_.t, to_sun_w_);
  triangles_.resize(stride_ * Index(camera.height));
  surfaces_.resize(stride_ * Index(camera.height));
}

/// The rays of a row's pixels, camera frame.
void View::LoadRow(int v) { world_->image_rays.Row(v, row_.x.data(), row_.y.data()); }

void View::Trace() {
  if (options_.exact_edges) {
    edges_.clear();
    blocks_.Start(world_->camera);
    world_->edges.Near(T_wc_, world_->camera, world_->image_rays.Window(), kEdgeMargin_px,
                       edges_, CanFill() ? &blocks_ : nullptr);
  }
  if (CanFill()) {
    TraceFilling();
  } else {
    for (int v = rows_.start; v < rows_.end; ++v) TraceRow(v, row_.view_far);
  }
}

void View::TraceRow(int v, const std::vector<float>& far) {
  LoadRow(v);
  TraceLoaded(static_cast<int>(stride_), far, Triangles(v));
}

/// What the rays that row_ holds show.
void View::TraceLoaded(int length, const std::vector<float>& far, int* triangles) {
  TurnRays(T_wc_.R, row_.x.data(), row_.y.data(), length, row_.dx.data(), row_.dy.data(),
           row_.dz.data());
  // The arrays of second rays are free still.
  std::vector<float>&dx = row_.start_x, &dy = row_.start_y, &dz = row_.start_z;
  ToSingle(row_.dx.data(), length, dx.data());
  ToSingle(row_.dy.data(), length, dy.data());
  ToSingle(row_.dz.data(), length, dz.data());
  const RayRow rays{row_.camera_x.data(),
                    row_.camera_y.data(),
                    row_.camera_z.data(),
                    dx.data(),
                    dy.data(),
                    dz.data(),
                    row_.view_near.data(),
                    far.data()};
  if (log_ != nullptr) RayLog::Add(rays, length, log_->nearest);
  world_->rays.Nearest(rays, length, triangles);
}

/// Casts again in double where an edge is near that may be seen.
void View::DecideEdges() {
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
  TurnRays(T_wc_.R, row_.x.data(), row_.y.data(), static_cast<int>(stride_), row_.dx.data(),
           row_.dy.data(), row_.dz.data());
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
    if (options_.sensed) fill((*image)[v], 0.0F);
  }
  fill(out_->plane_id[v], ushort{0});
  fill(out_->object_id[v], ushort{0});
  fill(Surfaces(v), std::uint32_t{0});
  fill(row_.sun_far.data(), -1.0F);
  fill(row_.eye_far.data(), -1.0F);
}

void View::RecordRun(int v, int first, int last, const SeenFacet& facet) {
  const bool second_eye = options_.projector_offset_m != 0;
  MeetPlane(
      {facet.inverse_depth, facet.n_c, T_wc_.t + kLeaveSurface_m * facet.n_w, eye_w_}, first,
      last,
      {row_.x.data(), row_.y.data(), row_.dx.data(), row_.dy.data(), row_.dz.data(),
       out_->depth_m[v], options_.sensed ? out_->incidence_cos[v] : nullptr,
       row_.start_x.data(), row_.start_y.data(), row_.start_z.data(),
       second_eye ? row_.to_eye_x.data() : nullptr, second_eye ? row_.to_eye_y.data() : nullptr,
       second_eye ? row_.to_eye_z.data() : nullptr});
  const auto fill = [&](auto* row, auto value) { std::fill(row + first, row + last, value); };
  fill(out_->plane_id[v], ushort{facet.plane});
  fill(out_->object_id[v], ushort{facet.object});
  fill(Surfaces(v), facet.surface);
  fill(row_.sun_far.data(), facet.faces_sun ? std::numeric_limits<float>::infinity() : -1.0F);
  fill(row_.eye_far.data(), facet.faces_eye ? 1.0F : -1.0F);
  if (options_.sensed) RecordSensed(v, first, last, facet);
}

void View::RecordSensed(int v, int first, int last, const SeenFacet& facet) {
  const auto fill = [&](auto* row, auto value) { std::fill(row + first, row + last, value); };
  fill(out_->infrared[v], facet.infrared);
  fill(out_->gloss[v], facet.gloss);
  if (facet.gloss > 0) {
    const Eigen::Vector3d projector_c(options_.projector_offset_m, 0, 0);
    MirrorCosines(facet.n_c, projector_c, row_.x.data(), row_.y.data(), out_->depth_m[v], first,
                  last, out_->mirror_cos[v]);
  } else {
    fill(out_->mirror_cos[v], 0.0F);
  }
}

void View::Block(const RayRow& rays, int count, std::uint8_t* blocked) const {
  world_->rays.Blocked(rays, count, blocked);
  for (const Blocker& other : around_->others) {
    for (int first = 0; first < count; first += kLanes) {
      // The same rays in the other world's frame; those already blocked are not cast again.
      RayPacket moved;
      for (int i = 0; i < kLanes; ++i) {
        const int k = first + i;
        const Eigen::Vector3f start(rays.x[k], rays.y[k], rays.z[k]);
        const Eigen::Vector3f way(rays.dx[k], rays.dy[k], rays.dz[k]);
        moved.Set(i, other.T_bw * start.cast<double>(), other.T_bw.R * way.cast<double>(),
                  rays.near[k], blocked[k] != 0 ? -1.0F : rays.far[k]);
      }
      const auto by_it = other.rays->Blocked(moved);
      for (int i = 0; i < kLanes; ++i) {
        if (by_it[Index(i)]) blocked[first + i] = 1;
      }
    }
  }
}

std::array<bool, kLanes> View::Blocked(const RayPacket& packet) const {
  std::array<std::uint8_t, kLanes> found;
  Block(packet.Row(), kLanes, found.data());
  std::array<bool, kLanes> blocked{};
  std::copy(found.begin(), found.end(), blocked.begin());
  return blocked;
}

void View::CastToSun(int v) {
  const int length = static_cast<int>(stride_);
  const RayRow rays{row_.start_x.data(),  row_.start_y.data(),  row_.start_z.data(),
                    row_.to_sun_x.data(), row_.to_sun_y.data(), row_.to_sun_z.data(),
                    row_.zero.data(),     row_.sun_far.data()};
  if (log_ != nullptr) RayLog::Add(rays, length, log_->blocked);
  Block(rays, length, row_.blocked.data());
  std::uint32_t* surfaces = Surfaces(v);
  for (std::size_t u = 0; u < stride_; ++u) {
    surfaces[u] |= row_.sun_far[u] > 0 && row_.blocked[u] == 0 ? 1u : 0u;
  }
}

void View::CastToEye(int v) {
  const int length = static_cast<int>(stride_);
  const RayRow rays{row_.start_x.data(),  row_.start_y.data(),  row_.start_z.data(),
                    row_.to_eye_x.data(), row_.to_eye_y.data(), row_.to_eye_z.data(),
                    row_.zero.data(),     row_.eye_far.data()};
  if (log_ != nullptr) RayLog::Add(rays, length, log_->blocked);
  Block(rays, length, row_.blocked.data());
  uchar* lit = out_->projector_lit[v];
  const std::size_t width = Index(world_->camera.width);
  for (std::size_t u = 0; u < width; ++u) {
    lit[u] = row_.eye_far[u] > 0 && row_.blocked[u] == 0 ? 255 : 0;
  }
}

}  // namespace sim
