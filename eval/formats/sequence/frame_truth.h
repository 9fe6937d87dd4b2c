#pragma once

#include <optional>
#include <vector>

#include "eval/formats/folder.h"
#include "eval/formats/sequence/box.h"

namespace eval {

/// What of the scene one frame shows (gt/frames.jsonl). Boxes are [x0, y0, x1, y1] in pixels.
struct VisiblePlane {
  int id = 0;
  int pixels = 0;
};
struct VisibleObject : VisiblePlane {
  std::optional<Box> visible_box_px;
};
struct FrameTruth {
  double stamp_s = 0.0;
  std::vector<VisibleObject> objects;  ///< in the order of the file
  std::vector<VisiblePlane> planes;    ///< in the order of the file
  int line = 0;                        ///< in the file; 0 when it comes from none
};

/// Reads gt/frames.jsonl, by rising stamp.
std::vector<FrameTruth> ReadFrameTruth(Folder& folder);

}  // namespace eval
