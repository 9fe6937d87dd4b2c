#pragma once

#include <vector>

#include "eval/formats/run/run.h"
#include "eval/surfaces/label_surfaces.h"
#include "eval/surfaces/score_surfaces.h"

namespace eval {

/// One page by which a person checks a surfaces file: the outlines from above, a list, and
/// frames over the recording with their surfaces tinted and named.
/// @throws InputError when an image cannot be read
cv::Mat DrawSurfaces(const SurfaceFile& file, const DepthViews& views);

/// A frame twice: its surfaces, and the run's segments in the colours of their landmarks, grey
/// where there is none.
cv::Mat DrawCutSurfaces(const cv::Mat1w& surfaces, const Run& run, const DepthViews& views,
                        const FrameWholeness& frame);

/// The frames in which most of the surfaces' pixels lie outside their largest segments, worst
/// first.
std::vector<FrameWholeness> WorstFrames(const SurfaceScore& score, std::size_t count);

}  // namespace eval
