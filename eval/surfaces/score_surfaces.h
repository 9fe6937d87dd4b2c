#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "eval/formats/run/run.h"
#include "eval/surfaces/depth_views.h"
#include "eval/surfaces/surface_scorer.h"

namespace eval {

/// The label of a surface for each pixel of a view, 0 = none.
using LabelView = std::function<cv::Mat1w(const DepthView& view)>;

/// Scores the segmentation and the landmarks of a run on labelled surfaces. Frames that the run
/// took (frame_planes.jsonl) count, merges of landmarks are followed as map.json says.
/// @throws InputError when the run has no segmentation images or they have another size
SurfaceScore ScoreSurfaces(const Run& run, const DepthViews& views, const LabelView& label);

/// Ids of landmarks as the final map has them: follows merges; nothing for what is not in the
/// map.
class FinalLandmarks {
 public:
  /// Without a map, as another system may leave it out, the ids are final.
  explicit FinalLandmarks(const Run& run);
  std::optional<int> Of(const std::optional<int>& map_plane) const;

 private:
  bool has_map_;
  std::map<int, std::optional<int>> merged_into_;
};

}  // namespace eval
