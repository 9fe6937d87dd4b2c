#pragma once

#include "slam/mapping/plane_map_config.h"

namespace slam {

/// Planes of small images hold few pixels.
inline PlaneMapConfig SmallImages() {
  PlaneMapConfig config;
  config.min_pixels = 40;
  return config;
}

}  // namespace slam
