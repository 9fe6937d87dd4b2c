#include "eval/planes/region_score.h"

#include "eval/planes/association.h"
#include "eval/planes/partition_score.h"

namespace eval {

HooverScore RegionScorer::Add(const FrameEvidence& e) {
  ++frames_;
  std::map<int, int> truth_of_label;
  const LabelPairs pairs = PairsOf(e, [&](const RunFramePlane& plane) {
    if (plane.bad) return 0;
    truth_of_label[plane.index + 1] = e.TruthOf(plane);
    return plane.index + 1;
  });
  const Overlap overlap = OverlapOf(pairs);
  const HooverScore hoover = ScoreHoover(overlap);
  hoover_ += hoover;
  panoptic_ += CountPanoptic(overlap);
  const PartitionScore partition = ScorePartition(pairs);
  rand_index_ += partition.rand_index;
  voi_bits_ += partition.VoiBits();
  covering_ += partition.covering;
  evops_ += ScoreEvops(overlap);
  if (hoover.truth + hoover.machine > 0) ++frames_with_planes_;
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
  RegionScore score;
  score.truth = hoover_.truth / n, score.machine = hoover_.machine / n;
  score.correct = hoover_.correct / n, score.over = hoover_.over / n;
  score.under = hoover_.under / n, score.missed = hoover_.missed / n;
  score.noise = hoover_.noise / n;
  score.correct_ratio = MakeScores(hoover_.correct, hoover_.machine, hoover_.truth).recall;
  score.correct_pixel_ratio =
      MakeScores(double(hoover_.correct_pixels), machine_pixels_, truth_pixels_).recall;
  score.panoptic = panoptic_;
  const PrecisionRecall pixels = MakeScores(right_pixels_, machine_pixels_, truth_pixels_);
  score.pixel_precision = pixels.precision, score.pixel_recall = pixels.recall;
  score.rand_index = rand_index_ / n, score.voi_bits = voi_bits_ / n;
  score.covering = covering_ / n;
  score.evops = evops_;
  if (frames_with_planes_ > 0) score.evops /= frames_with_planes_;
  return score;
}

}  // namespace eval
