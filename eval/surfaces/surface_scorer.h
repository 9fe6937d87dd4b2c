#pragma once

#include <cstddef>
#include <map>
#include <opencv2/core.hpp>
#include <vector>

#include "eval/planes/overlap.h"
#include "eval/planes/plane_events.h"

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
  /// What purity, identity and no_decision are shares of.
  long long segment_pixels = 0, landmark_pixels = 0;
  int large_frames = 0;
};
inline constexpr double kMinLandmarkShare = 0.02;  ///< of the surface's pixels

/// A frame by how badly its surfaces are cut up.
struct FrameWholeness {
  std::size_t view = 0;      ///< index in the views
  long long pixels = 0;      ///< on surfaces
  long long in_largest = 0;  ///< of each surface's largest segment
};

/// A large surface whose largest segment has no landmark although the surface has one.
struct UndecidedSegment {
  int surface = 0, segment = 0;  ///< ids; 0: no segment shows it
  int pixels = 0;                ///< of the surface
};

/// The group `surfaces` of metrics.json.
struct SurfaceScore {
  SurfaceFigures total;                    ///< shares weighted by pixels
  std::map<int, SurfaceFigures> surfaces;  ///< those that any frame shows
  int frames = 0;                          ///< with a pose and a segmentation
  std::vector<FrameWholeness> by_frame;
  /// Large surfaces in frames after the first second that had a landmark in an earlier frame, and
  /// those of them that got no decision.
  int known_surfaces = 0;
  std::vector<RunEvent> events;
};

/// What is counted of one surface over the frames.
struct SurfaceCounts {
  long long pixels = 0, in_largest = 0, in_any = 0;
  long long segment_on_it = 0, segment_on_any = 0;  ///< of segments that show it mostly
  int segments = 0, frames = 0, large_frames = 0, undecided_frames = 0;
  bool has_landmark = false;  ///< its largest segment had one in some frame
  std::map<int, long long> landmarks;
};

/// Counts how frames cut up the surfaces that they show.
class SurfaceScorer {
 public:
  /// @param view       index of the frame, for FrameWholeness
  /// @param surfaces   id at each pixel, 0 = none
  /// @param segments   label at each pixel, 0 = none
  /// @param landmarks  of the labels that have one
  /// @param is_settled  the first second is over: a surface with a landmark should be decided
  /// @returns the large surfaces that have a landmark since an earlier frame and got none in this
  ///   one, if it is settled
  std::vector<UndecidedSegment> Add(std::size_t view, const cv::Mat1w& surfaces,
                                    const cv::Mat1w& segments,
                                    const std::map<int, int>& landmarks,
                                    bool is_settled = false);
  SurfaceScore Score() const;

 private:
  void AddSegments(const Overlap& overlap);

  std::map<int, SurfaceCounts> counts_;
  std::vector<FrameWholeness> by_frame_;
  int segments_ = 0, known_surfaces_ = 0;
};

}  // namespace eval
