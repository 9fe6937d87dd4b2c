#pragma once

#include "eval/planes/overlap.h"

namespace eval {

/// Figures of one frame as EVOPS 1.0 defines them (Kornilova et al., arXiv 2204.05799). Regions are
/// a match at IoU >= 0.75 and partners at IoU >= 0.2. A share of nothing is 0.
struct EvopsScore {
  double precision = 0.0, recall = 0.0, f1 = 0.0;  ///< by matches
  double mean_iou = 0.0, mean_dice = 0.0;          ///< over matches
  double panoptic = 0.0;                           ///< mean_iou times f1
  double under_ratio = 0.0;  ///< USR: of the machine's regions, with more than one partner
  double over_ratio = 0.0;   ///< OSR: the same of the truth's
  /// Of the machine's: without a partner, or with a single one that is no match and has no other.
  double noise_ratio = 0.0;
  double missed_ratio = 0.0;  ///< the same of the truth's

  EvopsScore& operator+=(const EvopsScore& other);
  EvopsScore& operator/=(double divisor);
};
EvopsScore ScoreEvops(const Overlap& overlap);

}  // namespace eval
