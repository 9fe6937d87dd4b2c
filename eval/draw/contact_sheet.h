#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "eval/draw/draw_camera.h"
#include "eval/formats/run/run.h"
#include "eval/formats/sequence/sequence.h"

namespace eval {

/// `count` of `total` indices, evenly spread from the first to the last.
std::vector<std::size_t> SpreadEvenly(std::size_t total, std::size_t count);

/// How many frames of the sequence, from the first on, the run had come to: all of them unless
/// it was interrupted.
std::size_t FramesSeen(const Run& run, const Sequence& sequence);

/// A page of frames of a run, evenly spread over what the run saw of the sequence, each drawn
/// by DrawFrame under its number and its time since the first frame.
/// @throws InputError when an image cannot be read
cv::Mat ContactSheet(const Run& run, const Sequence& sequence,
                     const std::optional<Camera>& camera, int frames);

}  // namespace eval
