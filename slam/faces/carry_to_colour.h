#pragma once

#include <opencv2/core/mat.hpp>

#include "slam/geometry/camera.h"
#include "slam/model/frame.h"

namespace slam {

/// Tells what was found in the depth image as the camera of the colour image sees it, which was
/// elsewhere (Frame::T_dc, a small motion): planes, their points and edges, the label and the
/// depth of each pixel. A plane that it would see from behind stays as it is.
///
/// Planes, points and edges move exactly. Labels and depths are taken from the nearest pixel, as if
/// a block of 8 x 8 pixels were as far away as its middle; where depth does not show it there is
/// none. Images are replaced, not written to.
/// @param rays  PixelRays of the camera
void CarryToColour(const Camera& camera, const cv::Mat2d& rays, Frame& frame);

/// Moves planes that were carried to colour with T_dc to where Frame::T_dc says now, with their
/// lines and vertices. Labels and depth stay: they are off by less than the blocks they moved in.
void CarryPlanesAgain(const Pose& T_dc, const Camera& camera, Frame& frame);

}  // namespace slam
