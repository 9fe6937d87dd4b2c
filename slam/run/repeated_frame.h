#pragma once

#include <opencv2/core/mat.hpp>

#include "slam/input/frame_source.h"
#include "slam/model/frame.h"
#include "slam/run/tracker.h"

namespace slam {

/// A frame after all stages, with what the detector saw.
struct TrackedFrame {
  Frame frame;
  cv::Mat3b bgr;
  TrackReport report;
};

/// A driver repeats an image once or twice; what comes again more often is a world that stands
/// still before a camera without noise, of which there is something to learn.
inline constexpr int kMostRepeats = 2;

/// Whether colour and depth are those of the frame before to the last bit. Noise never repeats
/// itself: a driver that had nothing new gave its last images again.
bool RepeatsImages(const TrackedFrame& last, const RecordedFrame& next);

/// Makes the frame before stand for one that repeats its images. The camera is where it was and
/// sees what it saw; the map learns nothing, for the same noise twice is no second observation,
/// and what was new then is known now.
void RepeatAt(const RecordedFrame& next, TrackedFrame& last);

}  // namespace slam
