#include "sim/trace/frame_renderer.h"

#include <algorithm>

#include "sim/trace/box_outline.h"
#include "sim/trace/render_world.h"
#include "sim/trace/view.h"

namespace sim {
namespace {

/// As the header's UnoccludedPixels, by rays at the object alone.
int CastAlone(const RenderWorld& world, std::size_t object_index, const Pose& T_wc,
              const cv::Rect& area, const cv::Mat1w& object_id) {
  const auto own = static_cast<ushort>(world.scene.objects[object_index].id);
  const RayScene& alone = world.Alone(object_index);
  int count = 0;
  for (int v = area.y; v < area.y + area.height; ++v) {
    RayPacket packet;
    int lane = 0;
    const auto cast = [&] {
      for (int i = lane; i < RayPacket::kLanes; ++i) packet.Disable(i);
      const auto blocked = alone.Blocked(packet);
      count += static_cast<int>(std::count(blocked.begin(), blocked.end(), true));
      lane = 0;
    };
    for (int u = area.x; u < area.x + area.width; ++u) {
      if (object_id(v, u) == own) {
        ++count;
        continue;
      }
      packet.Set(lane++, T_wc.t, T_wc.R * world.image_rays.At(u, v), kNear_m);
      if (lane == RayPacket::kLanes) cast();
    }
    if (lane > 0) cast();
  }
  return count;
}

}  // namespace

FrameRenderer::FrameRenderer(const Scene& scene, const Camera& camera, InstructionSet set)
    : world_(std::make_unique<const RenderWorld>(scene, camera, set)) {}
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
  view.Render(*world_, T_wc, options, out);
}

double FrameRenderer::BareTraversal_s(const Pose& T_wc, const RenderOptions& options) const {
  Rendering out;
  RayLog log;
  View().Render(*world_, T_wc, options, out, &log);
  return world_->rays.TimeToCast(log);
}

int FrameRenderer::UnoccludedPixels(std::size_t object_index, const Pose& T_wc,
                                    const cv::Rect& where, const cv::Mat1w& object_id) const {
  const Camera& camera = world_->camera;
  const cv::Rect area = where & cv::Rect(0, 0, camera.width, camera.height);
  const Object& object = world_->scene.objects.at(object_index);
  if (object.shape != ShapeKind::kBox) {
    return CastAlone(*world_, object_index, T_wc, area, object_id);
  }
  return BoxOutline(object, T_wc).PixelsInside(camera, world_->image_rays, area);
}

bool FrameRenderer::Sees(const Pose& T_wc, const Eigen::Vector3d& x_w) const {
  const Eigen::Vector3d ray_w = x_w - T_wc.t;
  const ExactHit hit = world_->caster.Nearest(T_wc.t, ray_w, 0.0);
  return hit.triangle < 0 || (1 - hit.distance) * ray_w.norm() <= kLeaveSurface_m;
}

const Camera& FrameRenderer::camera() const { return world_->camera; }
const Scene& FrameRenderer::scene() const { return world_->scene; }

}  // namespace sim
