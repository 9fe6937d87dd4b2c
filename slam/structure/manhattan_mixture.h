#pragma once

#include <vector>

#include "slam/structure/manhattan_world.h"

namespace slam {

/// Structure "mixture": many Manhattan frames, each two or three landmarks at right angles that
/// one keyframe saw together, known again by these landmarks. The keyframe that saw it first says
/// where it lies. Source: ManhattanSLAM (Yunus, Li, Tombari 2021).

/// The directions of the best supported stored frame that this frame sees with all its landmarks:
/// most landmarks, then most keyframes, then the oldest. Empty: it sees none.
std::vector<AxisObservation> SeenManhattanFrame(const Frame& frame, const Map& map,
                                                const ManhattanConfig& config);

/// Stores the pairs and triples of matched planes of a keyframe that the map has not stored, and
/// counts it for those that it has.
/// @param frame  that the keyframe was made of
void LearnManhattanFrames(const Frame& frame, int keyframe, const ManhattanConfig& config,
                          Map& map);

}  // namespace slam
