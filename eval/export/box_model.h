#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "eval/formats/sequence/scene_truth.h"

namespace eval {

/// The truth's planes of the object are the six faces of its box, so its shape is known.
bool IsBox(const SceneTruth& scene, const TruthObject& object);

/// A box of `size_m` about the origin as an ASCII PLY: millimetres, normals, four vertices a
/// face so that edges stay sharp.
std::string BoxPly(const Eigen::Vector3d& size_m);

/// Its entry of models_info.json: bounds, sizes and diameter, millimetres.
nlohmann::ordered_json BoxInfo(const Eigen::Vector3d& size_m);

}  // namespace eval
