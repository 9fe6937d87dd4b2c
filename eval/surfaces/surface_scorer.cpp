#include "eval/surfaces/surface_scorer.h"

#include <algorithm>

namespace eval {
namespace {

using Pixels = long long;

double ShareOf(Pixels part, Pixels whole) {
  return whole > 0 ? double(part) / double(whole) : 0.0;
}

void Accumulate(const SurfaceCounts& from, SurfaceCounts& sum) {
  sum.pixels += from.pixels;
  sum.in_largest += from.in_largest;
  sum.in_any += from.in_any;
  sum.segment_on_it += from.segment_on_it;
  sum.segment_on_any += from.segment_on_any;
  sum.large_frames += from.large_frames;
  sum.undecided_frames += from.undecided_frames;
}

Pixels InLandmarks(const SurfaceCounts& c) {
  Pixels sum = 0;
  for (const auto& [landmark, held] : c.landmarks) sum += held;
  return sum;
}

Pixels InCommonestLandmark(const SurfaceCounts& c) {
  Pixels most = 0;
  for (const auto& [landmark, held] : c.landmarks) most = std::max(most, held);
  return most;
}

int LandmarksThatHoldIt(const SurfaceCounts& c) {
  return int(std::count_if(c.landmarks.begin(), c.landmarks.end(), [&](const auto& held) {
    return double(held.second) >= kMinLandmarkShare * double(c.pixels);
  }));
}

SurfaceFigures FiguresOf(const SurfaceCounts& c) {
  SurfaceFigures figures;
  figures.whole = ShareOf(c.in_largest, c.pixels);
  figures.covered = ShareOf(c.in_any, c.pixels);
  figures.purity = ShareOf(c.segment_on_it, c.segment_on_any);
  figures.segments_per_frame = ShareOf(c.segments, c.frames);
  figures.coverage = ShareOf(InLandmarks(c), c.pixels);
  figures.identity = ShareOf(InCommonestLandmark(c), InLandmarks(c));
  figures.landmarks = LandmarksThatHoldIt(c);
  figures.no_decision = ShareOf(c.undecided_frames, c.large_frames);
  figures.frames = c.frames;
  figures.pixels = c.pixels;
  figures.segment_pixels = c.segment_on_any;
  figures.landmark_pixels = InLandmarks(c);
  figures.large_frames = c.large_frames;
  return figures;
}

/// Its largest segment in a frame.
struct LargestSegment {
  int label = 0;  ///< 0: none
  Pixels pixels = 0;
};

LargestSegment AddSurface(SurfaceCounts& counts, int id, Pixels pixels, const Overlap& overlap,
                          const std::map<int, int>& landmarks, double image_pixels) {
  counts.pixels += pixels;
  ++counts.frames;
  LargestSegment largest;
  const auto shared = overlap.shared.find(id);
  if (shared != overlap.shared.end()) {
    for (const auto& [segment, common] : shared->second) {
      counts.in_any += common;
      if (common > largest.pixels) largest = {segment, common};
      const auto landmark = landmarks.find(segment);
      if (landmark != landmarks.end()) counts.landmarks[landmark->second] += common;
    }
  }
  counts.in_largest += largest.pixels;
  if (double(pixels) > kLargeSurfaceShare * image_pixels) {
    ++counts.large_frames;
    counts.undecided_frames += landmarks.count(largest.label) == 0 ? 1 : 0;
  }
  return largest;
}

}  // namespace

std::vector<UndecidedSegment> SurfaceScorer::Add(std::size_t view, const cv::Mat1w& surfaces,
                                                 const cv::Mat1w& segments,
                                                 const std::map<int, int>& landmarks,
                                                 bool is_settled) {
  std::vector<UndecidedSegment> undecided;
  const Overlap overlap = CountOverlap(surfaces, segments);
  FrameWholeness wholeness{view, 0, 0};
  for (const auto& [id, pixels] : overlap.truth_pixels) {
    SurfaceCounts& counts = counts_[id];
    const LargestSegment largest =
        AddSurface(counts, id, pixels, overlap, landmarks, double(surfaces.total()));
    wholeness.pixels += pixels;
    wholeness.in_largest += largest.pixels;
    const bool is_large = double(pixels) > kLargeSurfaceShare * double(surfaces.total());
    const bool decided = landmarks.count(largest.label) > 0;
    if (is_large && is_settled && counts.has_landmark) {
      ++known_surfaces_;
      if (!decided) undecided.push_back({id, largest.label, int(pixels)});
    }
    counts.has_landmark = counts.has_landmark || decided;
  }
  AddSegments(overlap);
  segments_ += int(overlap.machine_pixels.size());
  by_frame_.push_back(wholeness);
  return undecided;
}

SurfaceScore SurfaceScorer::Score() const {
  SurfaceScore score;
  score.frames = int(by_frame_.size());
  score.by_frame = by_frame_;
  score.known_surfaces = known_surfaces_;
  SurfaceCounts all;
  Pixels in_landmarks = 0, in_commonest = 0;
  double landmarks = 0.0;
  for (const auto& [id, counts] : counts_) {
    score.surfaces[id] = FiguresOf(counts);
    Accumulate(counts, all);
    in_landmarks += InLandmarks(counts);
    in_commonest += InCommonestLandmark(counts);
    landmarks += LandmarksThatHoldIt(counts);
  }
  score.total = FiguresOf(all);
  score.total.coverage = ShareOf(in_landmarks, all.pixels);
  score.total.identity = ShareOf(in_commonest, in_landmarks);
  score.total.landmark_pixels = in_landmarks;
  score.total.landmarks = counts_.empty() ? 0.0 : landmarks / double(counts_.size());
  score.total.segments_per_frame = ShareOf(segments_, score.frames);
  score.total.frames = score.frames;
  return score;
}

/// Each segment belongs to the surface that it shows mostly.
void SurfaceScorer::AddSegments(const Overlap& overlap) {
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

}  // namespace eval
