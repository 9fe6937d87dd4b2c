#include "sim/trace/rendered_scene.h"

#include <algorithm>

#include "sim/scene/geometry.h"

namespace sim {
namespace {

Scene Standing(Scene scene) {
  std::erase_if(scene.objects, [](const Object& object) { return !object.way.empty(); });
  return scene;
}

Scene Alone(const Object& object, Scene scene) {
  scene.objects = {ObjectAt(object, object.way.front().time_s)};
  return scene;
}

/// The mover's part of a view, put over what is there.
class Overlay {
 public:
  Overlay(const Rendering& mover, const cv::Mat1b& coverage, Rendering& out)
      : mover_(mover), coverage_(coverage), out_(out) {}

  void PutRow(int v, const cv::Range& rows) {
    for (int u = 0; u < out_.depth_m.cols; ++u) {
      if (Nearer(v, u, v, u)) {
        PutPixel(v, u);
      } else if (!out_.radiance.empty() && coverage_(v, u) > 0 && Beside(v, u, rows)) {
        Mix(v, u);
      }
    }
  }
  /// Truth and depth of what won; apart from PutRow, which compares with what was there.
  void Finish() {
    for (const auto& [v, u] : won_) {
      out_.depth_m(v, u) = mover_.depth_m(v, u);
      out_.plane_id(v, u) = 0;
      out_.object_id(v, u) = mover_.object_id(v, u);
      if (!out_.incidence_cos.empty()) {
        out_.incidence_cos(v, u) = mover_.incidence_cos(v, u);
        out_.infrared(v, u) = mover_.infrared(v, u);
        out_.gloss(v, u) = mover_.gloss(v, u);
        out_.mirror_cos(v, u) = mover_.mirror_cos(v, u);
      }
      if (!out_.projector_lit.empty()) out_.projector_lit(v, u) = mover_.projector_lit(v, u);
    }
  }

 private:
  /// Whether the mover at one pixel is before what was there at another.
  bool Nearer(int v, int u, int there_v, int there_u) const {
    const double z = mover_.depth_m(v, u), there = out_.depth_m(there_v, there_u);
    return z > 0 && (there == 0 || z < there);
  }
  /// Whether the mover covers a neighbour, and is before what is here.
  bool Beside(int v, int u, const cv::Range& rows) const {
    return (u > 0 && Nearer(v, u - 1, v, u)) ||
           (u + 1 < out_.depth_m.cols && Nearer(v, u + 1, v, u)) ||
           (v > rows.start && Nearer(v - 1, u, v, u)) ||
           (v + 1 < rows.end && Nearer(v + 1, u, v, u));
  }
  void PutPixel(int v, int u) {
    won_.emplace_back(v, u);
    if (!out_.radiance.empty()) Mix(v, u);
  }
  /// What the mover's rays missed shows what was there, not the sky.
  void Mix(int v, int u) {
    const float missed = 1.0F - 0.25F * static_cast<float>(coverage_(v, u));
    out_.radiance(v, u) = mover_.radiance(v, u) + missed * (out_.radiance(v, u) - kSky);
  }

  const Rendering& mover_;
  const cv::Mat1b& coverage_;
  Rendering& out_;
  std::vector<std::pair<int, int>> won_;
};

}  // namespace

Pose MotionOf(const Object& object, double time_s) {
  return ObjectPoseAt(object, time_s) *
         Inverse(ObjectPoseAt(object, object.way.front().time_s));
}

Mover::Mover(const Object& object, const Scene& scene, const Camera& camera, InstructionSet set,
             double reflections)
    : given(object), world(Alone(object, scene), camera, set, reflections) {}

RenderedScene::RenderedScene(const Scene& scene_in, const Camera& camera, InstructionSet set,
                             double reflections)
    : scene(scene_in), standing(Standing(scene_in), camera, set, reflections) {
  for (const Object& object : scene.objects) {
    if (object.way.empty()) continue;
    movers.push_back(std::make_unique<const Mover>(object, scene, camera, set, reflections));
  }
}

std::pair<const RenderWorld*, std::size_t> RenderedScene::Find(std::size_t object_index) const {
  const auto moves = [](const Object& object) { return !object.way.empty(); };
  const auto end = scene.objects.begin() + static_cast<std::ptrdiff_t>(object_index);
  const auto before =
      static_cast<std::size_t>(std::count_if(scene.objects.begin(), end, moves));
  if (moves(scene.objects.at(object_index))) return {&movers[before]->world, 0};
  return {&standing, object_index - before};
}

void RenderMoving(const RenderedScene& scene, const Pose& T_wc, const RenderOptions& options,
                  View& view, Rendering& out) {
  // Frame 0 is the world; frame k that of mover k - 1, where it stands.
  std::vector<Pose> T_wk{{}};
  std::vector<const RenderWorld*> worlds{&scene.standing};
  for (const auto& mover : scene.movers) {
    T_wk.push_back(MotionOf(mover->given, options.time_s));
    worlds.push_back(&mover->world);
  }
  const auto around = [&](std::size_t k, cv::Mat1b* coverage) {
    Surroundings surroundings{T_wk[k], {}, coverage};
    for (std::size_t j = 0; j < worlds.size(); ++j) {
      if (j != k) surroundings.others.push_back({&worlds[j]->rays, Inverse(T_wk[j]) * T_wk[k]});
    }
    return surroundings;
  };
  view.Render(*worlds[0], T_wc, options, around(0, nullptr), out);
  const int height = scene.standing.camera.height;
  const cv::Range rows = options.rows == cv::Range::all() ? cv::Range(0, height) : options.rows;
  thread_local Rendering part;  // memory only
  thread_local cv::Mat1b coverage;
  for (std::size_t k = 1; k < worlds.size(); ++k) {
    view.Render(*worlds[k], Inverse(T_wk[k]) * T_wc, options, around(k, &coverage), part);
    Overlay overlay(part, coverage, out);
    for (int v = rows.start; v < rows.end; ++v) overlay.PutRow(v, rows);
    overlay.Finish();
  }
}

}  // namespace sim
