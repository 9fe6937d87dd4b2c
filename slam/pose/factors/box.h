#pragma once

#include "slam/geometry/camera.h"
#include "slam/pose/factors/linearised.h"
#include "slam/pose/pose_problem.h"

namespace slam {

/// f_b_pi: sides of the box around the map plane's projected corners minus those of the
/// detection box, pixels of the recorded (distorted) image, in the order min u, min v, max u,
/// max v. Rows whose `use` flag is off are zero. Not valid when a corner lies behind the camera
/// or far out of the picture, where the lens model is meaningless. Source: PAS-SLAM eq17
/// (corrected: sides that the image border or another object decides carry no information and
/// are left out).
Linearised<4> BoxFactor(const BoxConstraint& constraint, const Pose& T_cw,
                        const Camera& camera);

}  // namespace slam
