#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "eval/formats/run.h"
#include "eval/surfaces/depth_views.h"

namespace eval {

/// How a run fares on one surface, or on all of them. Shares are 0 when there is nothing to
/// share.
struct SurfaceFigures {
  double whole = 0.0;    ///< in a frame, share in its largest segment; frames by pixels
  double covered = 0.0;  ///< the same in any segment
  double purity = 0.0;   ///< of segments that show it mostly, share that is on it
  double segments_per_frame = 0.0;  ///< that show it mostly; in total: all of a frame
  double coverage = 0.0;            ///< share of its pixels in planes that have a landmark
  double identity = 0.0;            ///< of those, share in its commonest landmark
  double landmarks = 0.0;           ///< that hold kMinLandmarkShare of it; in total: the mean
  double no_decision =
      0.0;               ///< of frames where it is large, share whose largest segment has none
  int frames = 0;        ///< that show it
  long long pixels = 0;  ///< over all frames
};
inline constexpr double kMinLandmarkShare = 0.02;  ///< of the surface's pixels
inline constexpr double kLargeShare = 0.05;        ///< of the image's pixels

/// A frame by how badly its surfaces are cut up.
struct FrameWholeness {
  std::size_t view = 0;      ///< index in the views
  long long pixels = 0;      ///< on surfaces
  long long in_largest = 0;  ///< of each surface's largest segment
};

/// The group `surfaces` of metrics.json.
struct SurfaceScore {
  SurfaceFigures total;                    ///< shares weighted by pixels
  std::map<int, SurfaceFigures> surfaces;  ///< those that any frame shows
  int frames = 0;                          ///< with a pose and a segmentation
  std::vector<FrameWholeness> by_frame;
};

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
  explicit FinalLandmarks(const std::vector<RunMapPlane>& map);
  std::optional<int> Of(const std::optional<int>& map_plane) const;

 private:
  std::map<int, std::optional<int>> merged_into_;
};

}  // namespace eval
