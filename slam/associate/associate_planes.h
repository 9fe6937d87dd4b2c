#pragma once

#include <vector>

#include "slam/associate/association_config.h"
#include "slam/associate/refusals.h"
#include "slam/model/frame.h"
#include "slam/model/map.h"

namespace slam {

/// What association came to in one frame.
struct PlaneAssociation {
  /// Parallel to frame.planes; kMatched, kTrial or kUnmatched.
  std::vector<PlaneMatch> matches;
  std::vector<FrameStep> steps;  ///< see Frame::plane_steps
  PairRefusals refused;          ///< pairs by the cue that refused them
};

/// Decides which surface of the map each frame plane shows, at frame.T_cw: a landmark, a
/// candidate, or none. Asked once a frame; nothing is changed.
///
/// The integrated rule keeps a pair whose offset and slopes agree within everybody's
/// uncertainty (chi-square), whose footprints cover each other as seen now, whose class the map
/// plane's belief allows and whose projected box meets the detection; it then assigns all planes at
/// once, best first.
/// The landmarks that fit beyond doubt first correct the predicted pose, because an error of
/// the pose moves all planes alike: what is left are the millimetres between them. The rank
/// test refuses pairs that hardly overlap and whose points are distributed otherwise. Two
/// nearly equal answers give none. A candidate takes a plane from a landmark only if it is
/// likelier and not the same surface.
///
/// The other rules (nearest_rules.h) take the nearest landmark that passes their bounds, or else the
/// nearest such candidate.
///
/// Planes that are far, badly fitted or on an unstructured object stay kUnmatched. The outcome
/// depends neither on the order of frame and map planes nor on where the world lies. Source:
/// PAS-SLAM eq6 to eq12 and its class rule (corrected as said in the headers of the parts).
/// Cost: about 2 ms for 20 frame planes and 50 map planes of 1,000 cloud points.
[[nodiscard]] PlaneAssociation AssociatePlanes(const Frame& frame, const Map& map,
                                               const Camera& camera,
                                               const AssociationConfig& config);

}  // namespace slam
