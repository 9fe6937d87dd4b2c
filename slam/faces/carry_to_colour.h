#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "slam/geometry/camera.h"
#include "slam/model/frame.h"

namespace slam {

/// Tells planes as another camera close by sees them, with all that is known of them: points,
/// edges, lines and vertices. One that it would see from behind stays as it is.
/// @param T_oc  from the camera that they are of to the other
void MovePlanes(const Pose& T_oc, const Camera& camera, std::vector<FramePlane>& planes);

/// Tells what was found in the depth image as the camera of the colour image sees it, which was
/// elsewhere (Frame::T_dc, a small motion): planes, their points and edges, the label and the
/// depth of each pixel. A plane that it would see from behind stays as it is.
///
/// Planes, points and edges move exactly. Labels and depths are taken from the nearest pixel, as if
/// a block of 8 x 8 pixels were as far away as its middle; where depth does not show it there is
/// none. Images are replaced, not written to.
/// @param rays  PixelRays of the camera
void CarryToColour(const Camera& camera, const cv::Mat2d& rays, Frame& frame);

}  // namespace slam
