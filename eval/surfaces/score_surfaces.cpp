#include "eval/surfaces/score_surfaces.h"

#include <fmt/format.h>

#include <algorithm>

#include "eval/planes/frame_evidence.h"
#include "eval/surfaces/surface_scorer.h"

namespace eval {
namespace {

/// Landmark of each segment of a frame, by label of the segmentation.
std::map<int, int> LandmarksOf(const RunFrame& frame, const FinalLandmarks& final_landmarks) {
  std::map<int, int> landmarks;
  for (const RunFramePlane& plane : frame.planes) {
    if (!Decided(plane)) continue;
    if (const auto id = final_landmarks.Of(plane.map_plane)) landmarks[plane.index + 1] = *id;
  }
  return landmarks;
}

RunEvent EventOf(const UndecidedSegment& undecided, const RunFrame& frame, int number) {
  RunEvent event;
  event.kind = EventKind::kNoDecision;
  event.frame = number;
  event.stamp_s = frame.stamp_s;
  event.truth = undecided.surface;
  event.pixels = undecided.pixels;
  const auto plane =
      std::find_if(frame.planes.begin(), frame.planes.end(),
                   [&](const RunFramePlane& p) { return p.index + 1 == undecided.segment; });
  event.cue = WhyUndecided(plane == frame.planes.end() ? nullptr : &*plane);
  return event;
}

}  // namespace

FinalLandmarks::FinalLandmarks(const Run& run) : has_map_(run.has_map) {
  for (const RunMapPlane& plane : run.map) merged_into_[plane.id] = plane.merged_into;
}

std::optional<int> FinalLandmarks::Of(const std::optional<int>& map_plane) const {
  if (!map_plane || !has_map_) return map_plane;
  auto found = merged_into_.find(*map_plane);
  // The reader has told of merges in a circle; the count only makes an end of them.
  for (std::size_t steps = 0; steps <= merged_into_.size(); ++steps) {
    if (found == merged_into_.end()) return std::nullopt;
    if (!found->second) return found->first;
    found = merged_into_.find(*found->second);
  }
  return std::nullopt;
}

SurfaceScore ScoreSurfaces(const Run& run, const DepthViews& views, const LabelView& label) {
  if (run.segmentation_files.empty()) {
    throw io::InputError((run.folder / "segmentation").string(),
                         "has no images; surfaces are counted by pixels: run `pas slam` with "
                         "--save-segmentation");
  }
  const FinalLandmarks final_landmarks(run);
  const std::vector<double> stamps_s = StampsOf(run.frames);
  SurfaceScorer scorer;
  std::optional<double> first_s;
  std::vector<RunEvent> events;
  for (std::size_t i = 0; i < views.size(); ++i) {
    const auto at = FindStamp(stamps_s, views.StampOf(i));
    if (!at) continue;
    const auto segments = ReadSegmentation(run, views.StampOf(i));
    if (!segments) {
      throw io::InputError((run.folder / "segmentation").string(),
                           fmt::format("has no image for the frame at {:.6f} s; run `pas slam` "
                                       "again with --save-segmentation",
                                       views.StampOf(i)));
    }
    const DepthView view = views.Read(i);
    if (segments->size() != view.depth_m.size()) {
      throw io::InputError(
          (run.folder / "segmentation").string(),
          fmt::format("has images of {} x {}, the recording's are {} x {}; name the run's own "
                      "recording with --truth",
                      segments->cols, segments->rows, view.depth_m.cols, view.depth_m.rows));
    }
    const RunFrame& frame = run.frames[*at];
    if (!first_s) first_s = frame.stamp_s;
    const bool is_settled = frame.stamp_s - *first_s > kFirstLandmarks_s;
    for (const UndecidedSegment& segment : scorer.Add(
             i, label(view), *segments, LandmarksOf(frame, final_landmarks), is_settled)) {
      events.push_back(EventOf(segment, frame, views.NumberOf(i)));
    }
  }
  SurfaceScore score = scorer.Score();
  score.events = std::move(events);
  return score;
}

}  // namespace eval
