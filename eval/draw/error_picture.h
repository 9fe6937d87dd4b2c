#pragma once

#include <opencv2/core.hpp>

#include "eval/draw/error_curve.h"
#include "eval/draw/run_title.h"

namespace eval {

/// Two panels over one axis of time: the position error in mm (m beyond 2000) and the rotation
/// error in degrees. Spans without errors are shaded, in a colour for each reason; where the
/// run is not aligned with the truth the picture says why.
cv::Mat DrawErrors(const ErrorCurve& curve, const RunTitle& title);

/// A round step (1, 2 or 5 times a power of ten) that divides `range` into about `parts`.
double RoundStep(double range, int parts);

}  // namespace eval
