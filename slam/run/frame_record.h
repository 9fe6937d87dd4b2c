#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "slam/model/frame.h"

namespace slam {

/// "far", "inliers", ... as in formats.md.
const char* BadReasonText(BadReason reason);
/// "matched", "new", "none".
const char* DecisionText(PlaneDecision decision);

/// One line of frame_planes.jsonl: what was seen in a frame, and what was decided in it. `by`
/// is null where nothing decided. `degenerate` stands in frames whose pose planes hold: the
/// directions, in the world, that nothing in the frame observes.
/// @throws std::invalid_argument if the matches are not parallel to the planes, or a number is
///         not finite.
/// @param state  of tracking, see StateName; left out when empty
nlohmann::ordered_json FramePlanesRecord(const Frame& frame, bool tracked,
                                         const char* state = "");

/// [x, y, z].
nlohmann::ordered_json VectorJson(const Eigen::Vector3d& x);

}  // namespace slam
