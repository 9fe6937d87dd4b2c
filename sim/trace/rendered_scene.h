#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "sim/trace/render_world.h"
#include "sim/trace/view/view.h"

namespace sim {

/// Motion of an object since the first point of its way.
Pose MotionOf(const Object& object, double time_s);

/// One object that moves, in a world of its own where it stands at the first point of its way.
struct Mover {
  Mover(const Object& object, const Scene& scene, const Camera& camera, InstructionSet set,
        double reflections);
  Object given;  ///< with its way
  RenderWorld world;
};

/// A scene taken apart: what stands, and each thing that moves. Const and thread-safe.
struct RenderedScene {
  RenderedScene(const Scene& scene_in, const Camera& camera, InstructionSet set,
                double reflections);
  /// The world an object is in, and its place there.
  std::pair<const RenderWorld*, std::size_t> Find(std::size_t object_index) const;

  Scene scene;
  RenderWorld standing;
  std::vector<std::unique_ptr<const Mover>> movers;
};

/// Renders a scene in which something moves: each world by itself with the camera where it is
/// as seen from there, then what is nearest, pixel by pixel. Colours mix at the movers'
/// outlines.
void RenderMoving(const RenderedScene& scene, const Pose& T_wc, const RenderOptions& options,
                  View& view, Rendering& out);

}  // namespace sim
