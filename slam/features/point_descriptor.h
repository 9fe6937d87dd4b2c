#pragma once

#include <opencv2/core/types.hpp>
#include <vector>

#include "slam/features/image_pyramid.h"
#include "slam/model/frame.h"

namespace slam {

/// Orientation of a patch by its intensity centroid: atan2(m01, m10) over a disc of radius 15
/// pixels, degrees in [0, 360). Rublee et al. 2011, section 3.2.
/// @param x, y  pixel of the octave's image, inside it
float PatchAngle(const PyramidImage& octave, int x, int y);

/// Rotated BRIEF (256 tests, OpenCV's learnt pattern) on the blurred octave, parallel to
/// `corners`, whose `angle` must be set and whose `pt` lies on the octave's image.
std::vector<Descriptor> DescribePoints(const PyramidImage& octave,
                                       const std::vector<cv::KeyPoint>& corners);

}  // namespace slam
