#pragma once

#include "slam/mapping/plane_map_config.h"

namespace slam {

/// Planes of small images hold few pixels.
inline PlaneMapConfig SmallImages() {
  PlaneMapConfig config;
  config.trial_pixels = 480;
  return config;
}

}  // namespace slam
