#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "eval/draw/draw_camera.h"
#include "eval/formats/run.h"
#include "eval/formats/sequence.h"

namespace eval {

/// `count` of `total` indices, evenly spread from the first to the last.
std::vector<std::size_t> SpreadEvenly(std::size_t total, std::size_t count);

/// A page of frames of a run, evenly spread over the sequence, each drawn by DrawFrame under
/// its number and time. @throws InputError when an image cannot be read
cv::Mat ContactSheet(const Run& run, const Sequence& sequence,
                     const std::optional<Camera>& camera, int frames);

}  // namespace eval
