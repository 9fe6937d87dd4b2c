#pragma once

#include "app/bench/bench_planes.h"
#include "eval/planes/true_frame.h"
#include "slam/model/frame.h"

namespace app {

/// Takes out of the truth what has no depth: a plane is then its measured pixels, and a corner
/// is in view if its plane is measured within 3 pixels of it (at a width of 640). Nearer than
/// its least distance, beside a near edge and at a slant a sensor sees nothing, and no method
/// can segment what was not measured.
void LeaveOutUnmeasured(const cv::Mat1f& depth_m, const slam::Camera& camera,
                        eval::TrueFrame& truth);

/// Adds to the bench what the planes of one processed frame are worth against its truth.
/// @throws std::invalid_argument if the frame's truth has no image of plane ids.
void ScoreFrame(const slam::Frame& found, const eval::TrueFrame& truth,
                const eval::SceneTruth& scene, PlaneBench& bench);

/// Adds the largest plane of the frame that is level in the world.
void AddLevelPlane(const slam::Frame& found, const eval::Pose& T_gc, PlaneBench& bench);

}  // namespace app
