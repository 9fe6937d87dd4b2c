#pragma once

#include <array>
#include <vector>

#include "eval/formats/pose/pose.h"
#include "slam/geometry/camera.h"
#include "slam/input/frame_source.h"

namespace app {

/// What of images is compared with poses.
struct EpipolarRules {
  int apart = 20;                ///< frames from one image of a pair to the other
  int every = 5;                 ///< frames from one pair to the next
  double min_baseline_m = 0.05;  ///< nearer cameras say little of where they are
};

/// Distances of matched pixels from the epipolar lines on which trajectories have them, pixels without
/// the lens; of each trajectory, over the same matches. They need no truth: what is told of the
/// path of a camera is told by its images.
///
/// Matches are SIFT's by Lowe's ratio test at 0.6. The same pairs of frames count for all: both
/// have a pose in every trajectory, not nearer to each other than `min_baseline_m`.
/// @param trajectories  by rising stamp, on the clock of the images
/// @throws InputError of the frames
std::vector<std::vector<double>> EpipolarDistances(
    slam::FrameSource& frames, const slam::Camera& camera,
    const std::vector<eval::Trajectory>& trajectories, const EpipolarRules& rules);

}  // namespace app
