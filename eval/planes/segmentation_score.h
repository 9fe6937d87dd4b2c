#pragma once

#include "eval/planes/overlap.h"

namespace eval {

/// Hoover et al. 1996 at T = 0.8 (>=). A region takes part in one instance at most; the one
/// with the larger mean measure wins. missed / noise: regions in no instance.
struct HooverScore {
  int truth = 0, machine = 0;
  int correct = 0, over = 0, under = 0, missed = 0, noise = 0;
  long long truth_pixels = 0, correct_pixels = 0;  ///< of true regions: all, found correctly

  HooverScore& operator+=(const HooverScore& other);
};
inline constexpr double kHooverShare = 0.8;
/// Whether the regions make a correct instance: each holds `min_share` of the other.
bool IsCorrect(const Overlap& overlap, int truth, int machine, double min_share = kHooverShare);
HooverScore ScoreHoover(const Overlap& overlap, double min_share = kHooverShare);

/// Panoptic quality (Kirillov, arXiv 1801.00868): TP iff IoU > 0.5; counts add over frames.
struct PanopticCounts {
  int tp = 0, fp = 0, fn = 0;
  double iou_sum = 0.0;

  double Sq() const { return tp > 0 ? iou_sum / tp : 0.0; }
  double Rq() const {
    const double whole = tp + 0.5 * fp + 0.5 * fn;
    return whole > 0.0 ? tp / whole : 0.0;
  }
  double Pq() const { return Sq() * Rq(); }
  PanopticCounts& operator+=(const PanopticCounts& other);
};
PanopticCounts CountPanoptic(const Overlap& overlap);

}  // namespace eval
