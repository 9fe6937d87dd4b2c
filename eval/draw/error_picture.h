#pragma once

#include <opencv2/core.hpp>
#include <optional>

#include "eval/formats/run.h"
#include "eval/formats/sequence.h"

namespace eval {

/// Distance between estimated and true position over time, in mm, after the SE(3) alignment of
/// positions that the ATE uses (of whole poses where that is not defined); untracked times are
/// shaded. Nothing without a truth that shares times with the run.
std::optional<cv::Mat> ErrorOverTime(const Run& run, const Sequence& sequence);

/// A round step (1, 2 or 5 times a power of ten) that divides `range` into about `parts`.
double RoundStep(double range, int parts);

}  // namespace eval
