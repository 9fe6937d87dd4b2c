#pragma once

#include "eval/planes/tracking.h"

namespace eval {

/// CLEAR: per-frame matches at similarity >= 0.5 that prefer the pair of the frame before.
/// Definitions of TrackEval 12c8791, which tests hold them to.
struct ClearScore {
  int frames = 0;
  int tp = 0, fp = 0, fn = 0, id_switches = 0;
  double similarity_sum = 0.0;  ///< of the matches
  /// Truths that are matched in more than 80 % of their frames, in at least 20 %, in fewer.
  int mostly_tracked = 0, partly_tracked = 0, mostly_lost = 0;
  int fragmentations = 0;  ///< times a truth is matched again after a frame without match

  double mota = 0.0;   ///< (TP - FP - IDSW) / (TP + FN)
  double motp = 0.0;   ///< mean similarity of the matches
  double moda = 0.0;   ///< (TP - FP) / (TP + FN)
  double smota = 0.0;  ///< (similarity - FP - IDSW) / (TP + FN)
  double motal = 0.0;  ///< MOTA with the decimal logarithm of IDSW
  double recall = 0.0, precision = 0.0, f1 = 0.0;
};
ClearScore ScoreClear(const std::vector<TrackingFrame>& frames);

}  // namespace eval
