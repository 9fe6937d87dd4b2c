#include "eval/planes/region_score.h"

#include "eval/planes/association.h"

namespace eval {

HooverScore RegionScorer::Add(const FrameEvidence& e) {
  ++frames_;
  std::map<int, int> truth_of_label;
  const Overlap overlap = OverlapOf(e, [&](const RunFramePlane& plane) {
    if (plane.bad) return 0;
    truth_of_label[plane.index + 1] = e.TruthOf(plane);
    return plane.index + 1;
  });
  const HooverScore hoover = ScoreHoover(overlap);
  hoover_ += hoover;
  panoptic_ += CountPanoptic(overlap);
  for (const auto& [truth, pixels] : overlap.truth_pixels) truth_pixels_ += double(pixels);
  for (const auto& [label, pixels] : overlap.machine_pixels) {
    machine_pixels_ += double(pixels);
    right_pixels_ += double(overlap.Shared(truth_of_label.at(label), label));
  }
  return hoover;
}

std::optional<RegionScore> RegionScorer::Score() const {
  if (frames_ == 0) return std::nullopt;
  const double n = frames_;
  const PrecisionRecall pixels = MakeScores(right_pixels_, machine_pixels_, truth_pixels_);
  return RegionScore{hoover_.truth / n, hoover_.machine / n, hoover_.correct / n,
                     hoover_.over / n,  hoover_.under / n,   hoover_.missed / n,
                     hoover_.noise / n, panoptic_,           pixels.precision,
                     pixels.recall};
}

}  // namespace eval
