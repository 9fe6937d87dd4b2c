#pragma once

#include "eval/planes/tracking.h"

namespace eval {

/// Identity: one-to-one matching of whole trajectories. Definitions of TrackEval 12c8791, which tests
/// hold them to.
struct IdentityScore {
  int idtp = 0, idfp = 0, idfn = 0;
  double idf1 = 0.0, idp = 0.0, idr = 0.0;
};
IdentityScore ScoreIdentity(const std::vector<TrackingFrame>& frames);

}  // namespace eval
