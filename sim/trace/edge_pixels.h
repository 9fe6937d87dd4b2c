#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "sim/base/pose.h"
#include "sim/camera/camera.h"
#include "sim/shapes/mesh.h"
#include "sim/trace/edge_blocks.h"
#include "sim/trace/image_rays.h"

namespace sim {

inline constexpr double kNear_m = 1e-3;  ///< nothing is seen closer than this

/// A pixel whose centre lies beside the projection of an edge.
struct EdgePixel {
  std::uint32_t pixel = 0;   ///< v * width + u
  double inverse_depth = 0;  ///< largest 1/z of the edge within the margin
};

/// The edges of a scene's triangles. Where two of one plane of one object meet, what a ray
/// shows is the same on both sides; still a ray tracer may slip through there.
class SceneEdges {
 public:
  explicit SceneEdges(std::span<const Triangle> triangles);

  /// Appends the pixels within `margin_px` of a projected edge, hidden ones too, in no order; a
  /// pixel may come more than once. Edges inside a face get a fifth of the margin. Nothing of a
  /// pixel further than two margins from every edge.
  /// @param window  of the camera's rays
  /// @param blocks  if given, every edge in the image is marked there
  void Near(const Pose& T_wc, const Camera& camera, const RayWindow& window, double margin_px,
            std::vector<EdgePixel>& pixels, EdgeBlocks* blocks = nullptr) const;

 private:
  struct Edge {
    std::array<Eigen::Vector3d, 2> ends_w;
    bool inside_a_face = false;
  };
  /// Neighbours in the list, culled as one.
  struct Bundle {
    std::size_t first = 0, last = 0;
    Eigen::Vector3d center_w;
    double radius_m = 0;
  };
  void MakeBundles();

  std::vector<Edge> edges_;
  std::vector<Bundle> bundles_;
};

}  // namespace sim
