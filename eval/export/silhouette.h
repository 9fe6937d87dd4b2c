#pragma once

#include <opencv2/core.hpp>

#include "eval/export/exportable.h"
#include "eval/formats/pose/pose.h"

namespace eval {

/// What a box alone would cover.
struct Silhouette {
  cv::Mat1b mask;  ///< as large as the image: 255 or 0
  PixelSet all;    ///< also beyond the border, on a canvas of three images by three
};

/// Silhouette of a box of `size_m` about the origin of o: the pixels whose centre rays meet it
/// in front of the camera. No lens distortion.
Silhouette BoxSilhouette(const Camera& camera, const Pose& T_co, const Eigen::Vector3d& size_m);

}  // namespace eval
