#include "eval/planes/tracking.h"

namespace eval {

TrackingIndices NumberIds(const std::vector<TrackingFrame>& frames) {
  TrackingIndices ids;
  for (const TrackingFrame& frame : frames) {
    for (const int id : frame.truth_ids) ids.truth.emplace(id, 0);
    for (const int id : frame.predicted_ids) ids.predicted.emplace(id, 0);
  }
  int next = 0;
  for (auto& [id, index] : ids.truth) index = next++;
  next = 0;
  for (auto& [id, index] : ids.predicted) index = next++;
  return ids;
}

double SafeRatio(double part, double whole) { return whole > 0.0 ? part / whole : 0.0; }

}  // namespace eval
