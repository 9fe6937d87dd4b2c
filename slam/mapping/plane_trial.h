#pragma once

#include <vector>

#include "slam/mapping/plane_map_config.h"
#include "slam/model/frame.h"
#include "slam/model/map.h"

namespace slam {

/// Written into PlaneMatch::by while a surface is on trial: it is no landmark yet.
inline constexpr const char* kByCandidate = "candidate";

/// What a frame plane without landmark comes to.
struct TrialOutcome {
  static constexpr int kStartsAtOnce = -2;
  static constexpr int kStartsTrial = -3;
  /// By frame plane: index of the candidate that it shows, one of the above, or kNone.
  std::vector<int> candidate;
};

/// Asks which candidates the frame planes without landmark show. A good plane that shows none
/// starts a trial, or, while the map is empty and the segment alone is evidence enough, a
/// landmark. Nothing is changed.
TrialOutcome AskCandidates(const Frame& frame, const Map& map, const Camera& camera,
                           const PlaneMapConfig& config);

/// A candidate has shown itself in enough frames, and large enough in all of them together.
bool HasProvenItself(const MapPlane& candidate, const PlaneMapConfig& config);

/// Removes candidates that were missed too often or turn out to lie on an unstructured object,
/// as the frame sees them at frame.T_cw, and numbers the rest anew. A candidate misses every
/// frame after its first that does not show it, in view or not, so their number is bounded by
/// what a few frames can show.
void DropFailedCandidates(const Frame& frame, const Camera& camera,
                          const PlaneMapConfig& config, Map& map);

}  // namespace slam
