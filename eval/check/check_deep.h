#pragma once

#include "eval/check/sequence_truth.h"

namespace eval {

/// Slower checks of a sequence with id images and poses, on up to 24 frames spread over it;
/// without those nothing is checked.
///  - Ids: a pixel's ray meets the plane of its id inside the face's corners, to 0.2 px. Finds
///    id images that are shifted, of another frame, or rendered with other poses.
///  - Time: the depth fits the pose of its own frame better than that of the frame before or
///    after, else it was written with another frame's name.
///  - Warp: depth of frame A, carried by the poses into frame B 0.1 to 0.4 m away, agrees
///    with B's where both show the same plane; it needs no plane equation. The median of
///    |difference| / sigma must be at most 1, where sigma is the sensor's.
void CheckDeep(Folder& folder, const SequenceTruth& truth);

}  // namespace eval
