#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "slam/calibrate/warp_learner.h"
#include "slam/input/frame_source.h"
#include "slam/run/tracker.h"

namespace slam {

/// What the first frames of a recording tell of the device and of how the camera sets out.
struct FirstLook {
  std::unique_ptr<Tracker> tracker;  ///< that followed them by points alone
  std::optional<WarpLearner> bend;   ///< of their planes; none where it is not to be learnt
};

/// Looks at the first frames of a recording before it is run (Tracker::StartFrom), so that its map is
/// not begun with depth that is bent or lies beside its colour and rows that are told at the wrong
/// time.
/// @param count  frames, at most those there are
/// @param with_planes  whether the run will have planes
/// @param go_on  asked after each frame, with how many are done; false: no more are looked at
/// @throws InputError for a frame that cannot be read
FirstLook LookFirst(FrameSource& frames, int count, const Camera& camera, Config config,
                    bool with_planes, int threads, const std::function<bool(int done)>& go_on);

}  // namespace slam
