#pragma once

#include <array>
#include <map>
#include <optional>
#include <vector>

#include "sim/shapes/planes.h"
#include "sim/trace/frame_renderer.h"
#include "sim/truth/mesh_corner.h"
#include "sim/truth/polygon.h"
#include "sim/truth/silhouette.h"
#include "sim/truth/surface_end.h"

namespace sim {

/// An object in one frame; only objects with pixels are listed.
struct ObjectInFrame {
  int id = 0;
  int pixels = 0;             ///< visible, of the object_id image
  int unoccluded_pixels = 0;  ///< inside the image, were nothing else there
  PixelBox visible_box;       ///< first to last visible pixel centre, inclusive
  PixelBox amodal_box;        ///< the whole object's with z > 1 cm, not cut at the image border
  std::optional<Pose> T_wo;   ///< only of what moves, at the moment of the frame
  double visible_fraction = 0;  ///< pixels / unoccluded_pixels, in (0, 1]
};

/// Where a corner of a face is.
enum class VertexState {
  kVisible,
  kOccluded,  ///< inside the image, but something is 0.1 mm or more before it (of a mesh: before
              ///< the mesh's own corner, and no face that meets in it)
  kOutside    ///< outside the image, or nearer than kSilhouetteNear_m
};

struct VertexInFrame {
  Eigen::Vector3d x_w;
  Eigen::Vector2d pixel;  ///< its projection; only when z > kSilhouetteNear_m
  bool projects = false;
  VertexState state = VertexState::kOutside;
  bool surface_ends = false;  ///< only when visible: whether it lies at the surface's edge,
                              ///< where depth breaks off (SurfaceEnds)
};

struct PlaneInFrame {
  int id = 0;
  int pixels = 0;
  Polygon outline;                      ///< ProjectedFace: what hides it does not change it
  std::vector<VertexInFrame> vertices;  ///< in the order of ScenePlane::vertices_w
};

/// Both lists in the order of ids.
struct FrameTruth {
  std::vector<ObjectInFrame> objects;
  std::vector<PlaneInFrame> planes;
  /// By detection_group, of those with pixels: what its objects would show together, were nothing
  /// else there. Structure is no part of a group.
  std::map<int, int> unoccluded_pixels_of_group = {};
};

/// What is visible where, from the id images; how much of each object and group the others hide,
/// by casting each object's rays alone. Const and thread-safe.
class TruthMaker {
 public:
  explicit TruthMaker(const FrameRenderer& renderer);  ///< kept by reference
  /// @param time_s  where what moves is; as the rendering's
  FrameTruth Describe(const Rendering& rendering, const Pose& T_wc, double time_s = 0) const;

 private:
  void DescribeObjects(const Rendering& rendering, const Pose& T_wc, double time_s,
                       FrameTruth& truth) const;
  void DescribePlanes(const Rendering& rendering, const Pose& T_wc, double time_s,
                      FrameTruth& truth) const;
  VertexInFrame DescribeCorner(const Eigen::Vector3d& x_w, const MeshCorner& on_mesh,
                               const Pose& T_wc, double time_s) const;

  const FrameRenderer& renderer_;
  std::vector<std::vector<Triangle>> triangles_;  ///< by object
  const std::vector<ScenePlane>& planes_;         ///< by id - 1
  /// By id - 1 and vertex: the same number where faces meet in the very same point.
  std::vector<std::vector<std::size_t>> corners_;
  std::vector<MeshCorner> mesh_corners_;  ///< by that number
  SurfaceEnds ends_;
};

}  // namespace sim
