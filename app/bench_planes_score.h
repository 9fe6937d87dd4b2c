#pragma once

#include "app/bench_planes.h"
#include "eval/planes/true_frame.h"
#include "slam/model/frame.h"

namespace app {

/// Adds to the bench what the planes of one processed frame are worth against its truth.
/// @throws std::invalid_argument if the frame's truth has no image of plane ids.
void ScoreFrame(const slam::Frame& found, const eval::TrueFrame& truth,
                const eval::SceneTruth& scene, PlaneBench& bench);

/// Adds the largest plane of the frame that is level in the world.
void ScoreLevelPlane(const slam::Frame& found, const eval::Pose& T_gc, PlaneBench& bench);

}  // namespace app
