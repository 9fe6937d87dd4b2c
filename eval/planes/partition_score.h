#pragma once

#include "eval/planes/overlap.h"

namespace eval {

/// How alike two divisions of the same things are, pixels or decisions. Every label is a part,
/// 0 too. Symmetric but for what names a side.
struct PartitionScore {
  /// Share of the pairs of things that both keep together or both keep apart (Rand 1971).
  double rand_index = 1.0;
  /// Mean over both sides of: each part's best IoU with one of the other side, by its size
  /// (segmentation covering, Arbelaez et al. 2011).
  double covering = 1.0;
  /// Entropies, in bits: what is left unknown of the one when the other is known.
  double truth_given_machine_bits = 0.0, machine_given_truth_bits = 0.0;
  /// Share of the things that belong to the largest part of the truth in their part of the machine,
  /// and the other way round.
  double purity = 1.0, inverse_purity = 1.0;

  /// Variation of information (Meila 2003).
  double VoiBits() const { return truth_given_machine_bits + machine_given_truth_bits; }
};

/// @param pairs  counts by (truth, machine); without any the two agree
/// Source: design of the metrics, sections 3.4 and 3.5; PlaneRCNN's RI, VOI and SC.
PartitionScore ScorePartition(const LabelPairs& pairs);

}  // namespace eval
