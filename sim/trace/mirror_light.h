#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <opencv2/core/matx.hpp>

#include "sim/scene/scene.h"

namespace sim {

/// A place on a glossy surface and how it is looked at, frame of the scene.
struct MirrorSpot {
  Eigen::Vector3d x_w;
  Eigen::Vector3d look_w;  ///< unit, from the camera to the place
  Eigen::Vector3d n_w;     ///< unit normal
  bool sunlit = false;
  std::uint32_t lights_seen = 0;  ///< bit k: no shadow of light k falls there
};

/// Linear RGB that a glossy surface with a slight haze mirrors at a spot: the room (brighter above
/// than below), the sun and the lamps. Of glass: next to what it is nearly all at grazing angles.
/// A light keeps its energy and is spread over the haze's lobe.
cv::Vec3f MirrorLight(const Scene& scene, const Eigen::Vector3d& to_sun_w,
                      const MirrorSpot& spot);

}  // namespace sim
