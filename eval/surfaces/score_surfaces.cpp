#include "eval/surfaces/score_surfaces.h"

#include <fmt/format.h>

#include <algorithm>

#include "eval/planes/overlap.h"

namespace eval {
namespace {

using Pixels = long long;

double ShareOf(Pixels part, Pixels whole) {
  return whole > 0 ? double(part) / double(whole) : 0.0;
}

/// What is counted of one surface over the frames.
struct SurfaceCounts {
  Pixels pixels = 0, in_largest = 0, in_any = 0;
  Pixels segment_on_it = 0, segment_on_any = 0;  ///< of segments that show it mostly
  int segments = 0, frames = 0, large_frames = 0, undecided_frames = 0;
  std::map<int, Pixels> landmarks;

  SurfaceCounts& operator+=(const SurfaceCounts& other) {
    pixels += other.pixels;
    in_largest += other.in_largest;
    in_any += other.in_any;
    segment_on_it += other.segment_on_it;
    segment_on_any += other.segment_on_any;
    large_frames += other.large_frames;
    undecided_frames += other.undecided_frames;
    return *this;
  }
  Pixels InLandmarks() const {
    Pixels sum = 0;
    for (const auto& [landmark, held] : landmarks) sum += held;
    return sum;
  }
  Pixels InCommonestLandmark() const {
    Pixels most = 0;
    for (const auto& [landmark, held] : landmarks) most = std::max(most, held);
    return most;
  }
  int LandmarksThatHoldIt() const {
    return int(std::count_if(landmarks.begin(), landmarks.end(), [&](const auto& held) {
      return double(held.second) >= kMinLandmarkShare * double(pixels);
    }));
  }
};

SurfaceFigures FiguresOf(const SurfaceCounts& c) {
  SurfaceFigures figures;
  figures.whole = ShareOf(c.in_largest, c.pixels);
  figures.covered = ShareOf(c.in_any, c.pixels);
  figures.purity = ShareOf(c.segment_on_it, c.segment_on_any);
  figures.segments_per_frame = ShareOf(c.segments, c.frames);
  figures.coverage = ShareOf(c.InLandmarks(), c.pixels);
  figures.identity = ShareOf(c.InCommonestLandmark(), c.InLandmarks());
  figures.landmarks = c.LandmarksThatHoldIt();
  figures.no_decision = ShareOf(c.undecided_frames, c.large_frames);
  figures.frames = c.frames;
  figures.pixels = c.pixels;
  return figures;
}

/// Landmark of each segment of a frame, by label of the segmentation.
std::map<int, int> LandmarksOf(const RunFrame& frame, const FinalLandmarks& final_landmarks) {
  std::map<int, int> landmarks;
  for (const RunFramePlane& plane : frame.planes) {
    if (const auto id = final_landmarks.Of(plane.map_plane)) landmarks[plane.index + 1] = *id;
  }
  return landmarks;
}

class SurfaceScorer {
 public:
  void Add(std::size_t view, const cv::Mat1w& surfaces, const cv::Mat1w& segments,
           const std::map<int, int>& landmarks) {
    const Overlap overlap = CountOverlap(surfaces, segments);
    FrameWholeness wholeness{view, 0, 0};
    for (const auto& [id, pixels] : overlap.truth_pixels) {
      const Pixels in_largest =
          AddSurface(counts_[id], id, pixels, overlap, landmarks, double(surfaces.total()));
      wholeness.pixels += pixels;
      wholeness.in_largest += in_largest;
    }
    AddSegments(overlap);
    segments_ += int(overlap.machine_pixels.size());
    by_frame_.push_back(wholeness);
  }

  SurfaceScore Score() const {
    SurfaceScore score;
    score.frames = int(by_frame_.size());
    score.by_frame = by_frame_;
    SurfaceCounts all;
    Pixels in_landmarks = 0, in_commonest = 0;
    double landmarks = 0.0;
    for (const auto& [id, counts] : counts_) {
      score.surfaces[id] = FiguresOf(counts);
      all += counts;
      in_landmarks += counts.InLandmarks();
      in_commonest += counts.InCommonestLandmark();
      landmarks += counts.LandmarksThatHoldIt();
    }
    score.total = FiguresOf(all);
    score.total.coverage = ShareOf(in_landmarks, all.pixels);
    score.total.identity = ShareOf(in_commonest, in_landmarks);
    score.total.landmarks = counts_.empty() ? 0.0 : landmarks / double(counts_.size());
    score.total.segments_per_frame = ShareOf(segments_, score.frames);
    score.total.frames = score.frames;
    return score;
  }

 private:
  static Pixels AddSurface(SurfaceCounts& counts, int id, Pixels pixels, const Overlap& overlap,
                           const std::map<int, int>& landmarks, double image_pixels) {
    counts.pixels += pixels;
    ++counts.frames;
    int largest = 0;
    Pixels in_largest = 0;
    const auto shared = overlap.shared.find(id);
    if (shared != overlap.shared.end()) {
      for (const auto& [segment, common] : shared->second) {
        counts.in_any += common;
        if (common > in_largest) {
          largest = segment;
          in_largest = common;
        }
        const auto landmark = landmarks.find(segment);
        if (landmark != landmarks.end()) counts.landmarks[landmark->second] += common;
      }
    }
    counts.in_largest += in_largest;
    if (double(pixels) > kLargeShare * image_pixels) {
      ++counts.large_frames;
      counts.undecided_frames += landmarks.count(largest) == 0 ? 1 : 0;
    }
    return in_largest;
  }

  /// Each segment belongs to the surface that it shows mostly.
  void AddSegments(const Overlap& overlap) {
    struct Shown {
      int id = 0;
      Pixels most = 0, any = 0;
    };
    std::map<int, Shown> segments;
    for (const auto& [id, shared] : overlap.shared) {
      for (const auto& [segment, common] : shared) {
        Shown& shown = segments[segment];
        shown.any += common;
        if (common <= shown.most) continue;
        shown.most = common;
        shown.id = id;
      }
    }
    for (const auto& [segment, shown] : segments) {
      SurfaceCounts& counts = counts_[shown.id];
      ++counts.segments;
      counts.segment_on_it += shown.most;
      counts.segment_on_any += shown.any;
    }
  }

  std::map<int, SurfaceCounts> counts_;
  std::vector<FrameWholeness> by_frame_;
  int segments_ = 0;
};

}  // namespace

FinalLandmarks::FinalLandmarks(const std::vector<RunMapPlane>& map) {
  for (const RunMapPlane& plane : map) merged_into_[plane.id] = plane.merged_into;
}

std::optional<int> FinalLandmarks::Of(const std::optional<int>& map_plane) const {
  if (!map_plane) return std::nullopt;
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
  const FinalLandmarks final_landmarks(run.map);
  const std::vector<double> stamps_s = StampsOf(run.frames);
  SurfaceScorer scorer;
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
    scorer.Add(i, label(view), *segments, LandmarksOf(run.frames[*at], final_landmarks));
  }
  return scorer.Score();
}

}  // namespace eval
