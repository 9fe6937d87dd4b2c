#pragma once

#include "eval/formats/run/timing.h"
#include "eval/regression/gated_metrics.h"

namespace eval {

/// "/time_ratio/MODULE" for each module that is gated: its time over that of the plain pass of the
/// same run, so that a slower machine changes nothing. The plain pass is the search for ORB
/// features, which every frame does once on the colour image alone; its own time is told over that
/// of plane extraction. Both times are the 10th percentiles over the frames, which nothing else on the
/// machine has held up. Nothing for a module that did not run.
Figures TimeRatios(const Timing& timing);

}  // namespace eval
