#pragma once

#include "eval/planes/evops_score.h"
#include "eval/planes/frame_evidence.h"
#include "eval/planes/segmentation_score.h"

namespace eval {

/// Means per frame of Hoover's counts, of how alike the divisions are and of EVOPS; panoptic
/// quality, pixels and shares over all frames.
struct RegionScore {
  double truth = 0.0, machine = 0.0;
  double correct = 0.0, over = 0.0, under = 0.0, missed = 0.0, noise = 0.0;
  double correct_ratio = 0.0;        ///< of the true planes, by Hoover
  double correct_pixel_ratio = 0.0;  ///< of their pixels
  PanopticCounts panoptic;
  double pixel_precision = 0.0;  ///< pixels of trusted planes that show the plane's own truth
  double pixel_recall = 0.0;     ///< pixels of true planes that count, so covered
  double rand_index = 0.0, voi_bits = 0.0, covering = 0.0;  ///< see PartitionScore
  EvopsScore evops;  ///< over frames with a plane of either side
};

/// Counts how the segments of frames cover the true planes that count.
class RegionScorer {
 public:
  /// @param e  with pairs of labels
  /// @returns the counts of this frame
  HooverScore Add(const FrameEvidence& e);
  /// @returns nothing without a frame
  std::optional<RegionScore> Score() const;

 private:
  HooverScore hoover_;
  PanopticCounts panoptic_;
  double rand_index_ = 0.0, voi_bits_ = 0.0, covering_ = 0.0;  ///< sums
  EvopsScore evops_;                                           ///< sum
  int frames_ = 0, frames_with_planes_ = 0;
  double truth_pixels_ = 0.0, machine_pixels_ = 0.0, right_pixels_ = 0.0;
};

}  // namespace eval
