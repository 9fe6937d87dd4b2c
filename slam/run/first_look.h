#pragma once

#include <functional>
#include <memory>

#include "slam/input/frame_source.h"
#include "slam/run/tracker.h"

namespace slam {

/// Tracks the first frames of a recording by points alone. What the tracker then knows of the device
/// and of how the camera sets out is there before the recording is run (Tracker::StartFrom), so that
/// its map is not begun with depth that lies beside its colour and rows that are told at the wrong
/// time.
/// @param count  frames, at most those there are
/// @param go_on  asked after each frame, with how many are done; false: no more are looked at
/// @throws InputError for a frame that cannot be read
std::unique_ptr<Tracker> LookFirst(FrameSource& frames, int count, const Camera& camera,
                                   Config config, int threads,
                                   const std::function<bool(int done)>& go_on);

}  // namespace slam
