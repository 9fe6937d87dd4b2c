#pragma once

#include <opencv2/core/mat.hpp>

#include "sim/camera/camera.h"
#include "sim/trace/frame_renderer.h"

namespace sim {

/// How much each pixel is lit by the other wall of a concave corner that it belongs to: 1 in
/// the corner of two planes at a right angle (or sharper), less where they are flatter
/// (1 - n1 . n2), falling with the distance along the surface to 0 at reach_m. 0 elsewhere.
/// Corners are those the image shows: neighbouring pixels of two planes that touch, each in
/// front of the other's plane.
cv::Mat1f CornerGlow(const Rendering& rendering, const Camera& camera, double reach_m);

}  // namespace sim
