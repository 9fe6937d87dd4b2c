#pragma once

#include <string>

#include "eval/report/evaluate.h"

namespace eval {

/// Everything that went wrong, planes and lost frames, the most harmful first.
/// @param of_surfaces  events of the surfaces that a recording was scored on
std::vector<RunEvent> EventsOf(const Evaluation& evaluation, const Sequence& sequence,
                               const std::vector<RunEvent>& of_surfaces = {});

/// A line for each event, under a header; what is not known is empty.
std::string EventsCsv(const std::vector<RunEvent>& events);
/// The same as an object of JSON on each line; what is not known is null.
std::string EventsJsonLines(const std::vector<RunEvent>& events);

/// A line for each frame of the sequence, under a header: tracking, errors of the pose, planes,
/// decisions and time. What is not defined is empty.
std::string FramesCsv(const Evaluation& evaluation, const Run& run, const Sequence& sequence);

}  // namespace eval
