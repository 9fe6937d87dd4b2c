#pragma once

#include <array>

#include "eval/planes/tracking.h"

namespace eval {

inline constexpr std::size_t kHotaThresholds = 19;  ///< 0.05, 0.1, ... 0.95

/// HOTA and its parts at one threshold of similarity, or the means over all of them. TP, FN and FP
/// count detections.
struct HotaFigures {
  double hota = 0.0;  ///< sqrt(DetA AssA); of the means: the mean of these
  double det_a = 0.0, det_recall = 0.0, det_precision = 0.0;
  double ass_a = 0.0, ass_recall = 0.0, ass_precision = 0.0;
  double loc_a = 0.0;  ///< mean similarity of the matches, 1 without any
  double owta = 0.0;   ///< sqrt(DetRe AssA)
  double tp = 0.0, fn = 0.0, fp = 0.0;
};

/// Luiten 2020. Definitions of TrackEval 12c8791, which tests hold them to.
struct HotaScore : HotaFigures {
  std::array<HotaFigures, kHotaThresholds> at;  ///< by rising threshold
};
HotaScore ScoreHota(const std::vector<TrackingFrame>& frames);

}  // namespace eval
