#pragma once

#include <opencv2/core/types.hpp>
#include <optional>
#include <string>
#include <vector>

#include "eval/formats/run/run.h"
#include "eval/formats/sequence/sequence.h"

namespace eval {

/// Pixel of a point of the camera frame; nothing behind or beside the camera.
std::optional<cv::Point2d> Project(const Camera& camera, const Eigen::Vector3d& p_c);
/// A closed outline, cut at the near plane.
std::vector<cv::Point2d> ProjectOutline(const Camera& camera,
                                        const std::vector<Eigen::Vector3d>& points_c);

/// `name` is tum1, tum2, tum3 or a camera.yaml. @throws InputError for anything else.
Camera ReadNamedCamera(const std::string& name);

/// The camera of a run: `choice` when it is given, else the sequence's, else the one that
/// run.json names. Nothing when none of them tells.
std::optional<Camera> ChooseCamera(const std::string& choice, const Sequence& sequence,
                                   const Run& run);

}  // namespace eval
