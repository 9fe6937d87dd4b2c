#include "sim/trace/frame_renderer.h"

#include <algorithm>
#include <array>

#include "sim/scene/geometry.h"
#include "sim/trace/box_outline.h"
#include "sim/trace/render_world.h"
#include "sim/trace/rendered_scene.h"
#include "sim/trace/view/view.h"

namespace sim {
namespace {

/// As the header's UnoccludedPixels, by rays at the object alone.
int CastAlone(const RenderWorld& world, std::size_t object_index, const Pose& T_wc,
              const cv::Rect& area, const cv::Mat1w& object_id, cv::Mat1b* covered) {
  const auto own = static_cast<ushort>(world.scene.objects[object_index].id);
  const RayScene& alone = world.Alone(object_index);
  int count = 0;
  for (int v = area.y; v < area.y + area.height; ++v) {
    RayPacket packet;
    std::array<int, RayPacket::kLanes> column{};
    int lane = 0;
    const auto add = [&](int u) {
      ++count;
      if (covered != nullptr) (*covered)(v, u) = 255;
    };
    const auto cast = [&] {
      for (int i = lane; i < RayPacket::kLanes; ++i) packet.Disable(i);
      const auto blocked = alone.Blocked(packet);
      for (std::size_t i = 0; i < static_cast<std::size_t>(lane); ++i) {
        if (blocked[i]) add(column[i]);
      }
      lane = 0;
    };
    for (int u = area.x; u < area.x + area.width; ++u) {
      if (object_id(v, u) == own) {
        add(u);
        continue;
      }
      column[static_cast<std::size_t>(lane)] = u;
      packet.Set(lane++, T_wc.t, T_wc.R * world.image_rays.At(u, v), kNearRay_m);
      if (lane == RayPacket::kLanes) cast();
    }
    if (lane > 0) cast();
  }
  return count;
}

}  // namespace

FrameRenderer::FrameRenderer(const Scene& scene, const Camera& camera, InstructionSet set,
                             double reflections)
    : world_(std::make_unique<const RenderedScene>(scene, camera, set, reflections)) {}
FrameRenderer::~FrameRenderer() = default;
FrameRenderer::FrameRenderer(FrameRenderer&&) noexcept = default;

Rendering FrameRenderer::Render(const Pose& T_wc, const RenderOptions& options) const {
  Rendering out;
  Render(T_wc, options, out);
  return out;
}

void FrameRenderer::Render(const Pose& T_wc, const RenderOptions& options,
                           Rendering& out) const {
  thread_local View view;  // memory only; nothing of one view tells on the next
  if (world_->movers.empty()) {
    view.Render(world_->standing, T_wc, options, {}, out);
  } else {
    RenderMoving(*world_, T_wc, options, view, out);
  }
}

double FrameRenderer::BareTraversal_s(const Pose& T_wc, const RenderOptions& options) const {
  Rendering out;
  RayLog log;
  View().Render(world_->standing, T_wc, options, {}, out, &log);
  return world_->standing.rays.TimeToCast(log);
}

int FrameRenderer::UnoccludedPixels(std::size_t object_index, const Pose& T_wc,
                                    const cv::Rect& where, const cv::Mat1w& object_id,
                                    double time_s, cv::Mat1b* covered) const {
  const Camera& camera = world_->standing.camera;
  const cv::Rect area = where & cv::Rect(0, 0, camera.width, camera.height);
  const auto [world, place] = world_->Find(object_index);
  const Pose T_mc = Inverse(Moved(object_index, time_s)) * T_wc;
  const Object& object = world->scene.objects.at(place);
  if (object.shape != ShapeKind::kBox) {
    return CastAlone(*world, place, T_mc, area, object_id, covered);
  }
  return BoxOutline(object, T_mc).PixelsInside(camera, world->image_rays, area, covered);
}

Pose FrameRenderer::Moved(std::size_t object_index, double time_s) const {
  const Object& object = world_->scene.objects.at(object_index);
  if (object.way.empty()) return {};
  return MotionOf(object, time_s);
}

bool FrameRenderer::Sees(const Pose& T_wc, const Eigen::Vector3d& x_w, double time_s,
                         std::span<const int> own_planes) const {
  const Eigen::Vector3d ray_w = x_w - T_wc.t;
  const auto owned = [&](const RenderWorld& world, int triangle) {
    const int plane = world.mesh.triangles[static_cast<std::size_t>(triangle)].plane;
    return plane > 0 &&
           std::find(own_planes.begin(), own_planes.end(), plane) != own_planes.end();
  };
  const auto sees_past = [&](const RenderWorld& world, const Eigen::Vector3d& from,
                             const Eigen::Vector3d& ray) {
    ExactHit hit = world.caster.Nearest(from, ray, 0.0);
    while (hit.triangle >= 0 && (1 - hit.distance) * ray_w.norm() > kLeaveSurface_m) {
      if (!owned(world, hit.triangle)) return false;
      hit = world.caster.Nearest(from, ray, hit.distance);
    }
    return true;
  };
  if (!sees_past(world_->standing, T_wc.t, ray_w)) return false;
  // What moves has no planes, so it never owns the point.
  return std::all_of(world_->movers.begin(), world_->movers.end(), [&](const auto& mover) {
    const Pose T_mw = Inverse(MotionOf(mover->given, time_s));
    return sees_past(mover->world, T_mw * T_wc.t, T_mw.R * ray_w);
  });
}

std::vector<Triangle> FrameRenderer::TrianglesOf(std::size_t object_index) const {
  const auto [world, place] = world_->Find(object_index);
  return world->TrianglesOf(place);
}

const Camera& FrameRenderer::camera() const { return world_->standing.camera; }
const ImageRays& FrameRenderer::image_rays() const { return world_->standing.image_rays; }
const Scene& FrameRenderer::scene() const { return world_->scene; }
const SceneMesh& FrameRenderer::standing() const { return world_->standing.mesh; }

}  // namespace sim
