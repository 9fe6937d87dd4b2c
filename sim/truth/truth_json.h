#pragma once

#include <string>

#include "sim/truth/frame_truth.h"

namespace sim {

/// Text of gt/scene.json (formats.md): objects and planes, world frame, metres. Faces that are
/// hidden for ever are listed too; they never get a pixel.
/// @param planes  all of the scene
std::string SceneTruthJson(const Scene& scene, const std::vector<ScenePlane>& planes);

/// One line of gt/frames.jsonl, without the line end.
std::string FrameTruthJson(double timestamp_s, const FrameTruth& truth);

}  // namespace sim
