#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "sim/base/pose.h"
#include "sim/camera/camera.h"
#include "sim/scene/scene.h"
#include "sim/trace/image_rays.h"

namespace sim {

/// The outline of a box seen from T_wc, as planes through the camera's centre: a ray (x, y, 1)
/// meets the box when it lies on the inner side of each. Seen from inside there is no plane and
/// every ray meets it.
class BoxOutline {
 public:
  BoxOutline(const Object& box, const Pose& T_wc);

  bool Meets(const Eigen::Vector3d& ray) const;
  /// Pixels of the area whose centre's ray meets the box; 255 in `covered`, if given.
  int PixelsInside(const Camera& camera, const ImageRays& rays, const cv::Rect& area,
                   cv::Mat1b* covered = nullptr) const;

 private:
  cv::Range InStraightRow(const Camera& camera, const ImageRays& rays, const cv::Rect& area,
                          int v) const;
  int InBentRows(const ImageRays& rays, const cv::Rect& area, cv::Mat1b* covered) const;

  std::vector<Eigen::Vector3d> sides_c_;  ///< normals, inwards
};

}  // namespace sim
