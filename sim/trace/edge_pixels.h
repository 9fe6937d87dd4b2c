#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "sim/camera/camera.h"
#include "sim/scene/mesh.h"
#include "sim/scene/pose.h"

namespace sim {

/// A pixel whose centre lies beside the projection of an edge.
struct EdgePixel {
  std::uint32_t pixel = 0;   ///< v * width + u
  double inverse_depth = 0;  ///< largest 1/z of the edge within the margin
};

/// The edges at which a scene's surface bends or ends; a line between two triangles of one
/// plane and one object is none.
class SceneEdges {
 public:
  explicit SceneEdges(std::span<const Triangle> triangles);

  /// Pixels within `margin_px` of a projected edge, hidden ones too, in the order of pixels;
  /// a pixel may come twice. Nothing of a pixel further than 1.5 margins from every edge.
  std::vector<EdgePixel> Near(const Pose& T_wc, const Camera& camera, double margin_px) const;

 private:
  std::vector<std::array<Eigen::Vector3d, 2>> edges_w_;
};

}  // namespace sim
