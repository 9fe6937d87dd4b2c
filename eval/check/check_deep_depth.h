#pragma once

#include "eval/check/deep_frames.h"

namespace eval {

/// Whether depth fits the pose of its own frame better than those of the frames before and
/// after.
void CheckDepthTime(Folder& folder, const DeepFrames& frames);

/// Whether depth of one frame, carried into another by the poses, agrees with that one's.
void CheckWarp(Folder& folder, const DeepFrames& frames);

}  // namespace eval
