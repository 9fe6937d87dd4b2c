#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "slam/features/point_features.h"
#include "slam/geometry/camera.h"
#include "slam/geometry/pose.h"
#include "slam/model/frame.h"

namespace slam {

/// Reads the depths of features that were found in the colour image, and tells both as the camera
/// of the middle row would have seen them.
///
/// @param depth_m  planar z, metres, 0 = none; of the camera's size, or empty for no depth at all
/// @param T_dc     from the camera of the colour image to that of the depth image; a small motion
/// @param readout  what is taken out of how the image was read
/// @throws std::invalid_argument when the depth image has another size.
void ReadDepths(const cv::Mat1f& depth_m, const Camera& camera,
                const PointFeatureConfig& config, const Pose& T_dc, const Readout& readout,
                std::vector<PointFeature>& features);

}  // namespace slam
