#pragma once

#include <vector>

#include "sim/trace/frame_renderer.h"
#include "sim/truth/silhouette.h"

namespace sim {

/// An object in one frame; only objects with pixels are listed.
struct ObjectInFrame {
  int id = 0;
  int pixels = 0;             ///< visible, of the object_id image
  int unoccluded_pixels = 0;  ///< inside the image, were nothing else there
  PixelBox visible_box;       ///< first to last visible pixel centre, inclusive
  PixelBox amodal_box;  ///< of the whole object with z > 1 cm, not cut at the image border
  double visible_fraction = 0;  ///< pixels / unoccluded_pixels, in (0, 1]
};

struct PlaneInFrame {
  int id = 0;
  int pixels = 0;
};

/// Both lists in the order of ids.
struct FrameTruth {
  std::vector<ObjectInFrame> objects;
  std::vector<PlaneInFrame> planes;
};

/// What is visible where, from the id images; how much of each object the others hide, by
/// casting each object's rays alone. Const and thread-safe.
class TruthMaker {
 public:
  explicit TruthMaker(const FrameRenderer& renderer);  ///< kept by reference
  FrameTruth Describe(const Rendering& rendering, const Pose& T_wc) const;

 private:
  const FrameRenderer& renderer_;
  std::vector<std::vector<Triangle>> triangles_;  ///< by object
};

}  // namespace sim
