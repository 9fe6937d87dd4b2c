#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include "sim/trace/edge_pixels.h"
#include "sim/trace/exact_cast.h"
#include "sim/trace/image_rays.h"
#include "sim/trace/ray_scene.h"
#include "sim/trace/surface.h"

namespace sim {

inline constexpr float kNearRay_m = static_cast<float>(kNear_m);  ///< the same for rays
inline constexpr double kLeaveSurface_m = 1e-4;  ///< second rays start this far off the surface

/// Everything about a scene that its views share. Const and thread-safe.
struct RenderWorld {
  RenderWorld(const Scene& scene_in, const Camera& camera_in, InstructionSet set_in,
              double reflections_in);
  std::vector<Triangle> TrianglesOf(std::size_t object_index) const;
  /// The object with nothing else there, built when it is first asked for.
  const RayScene& Alone(std::size_t object_index) const;

  Scene scene;
  Camera camera;
  InstructionSet set;
  ImageRays image_rays;
  SceneMesh mesh;
  RayScene rays;
  SceneEdges edges;
  ExactCaster caster;
  SurfaceTable surfaces;
  Eigen::Vector3d to_sun_w;
  double reflections;  ///< as FrameRenderer's

 private:
  struct LoneObject {
    std::once_flag once;
    std::unique_ptr<const RayScene> rays;
  };
  std::vector<std::unique_ptr<LoneObject>> alone_;  ///< by object
};

}  // namespace sim
