#pragma once

#include "slam/base/field_visitor.h"

namespace slam {

/// How planes grow over pixels (PixelGrowth).
struct GrowthConfig {
  double max_pixel_sigmas = 3.0;
  /// A plane that explains its pixels hardly better than the next best plane there only steals
  /// from its neighbours, as the plane of a block across a step does.
  double min_gain = 3.0;
};

inline void VisitFields(GrowthConfig& c, FieldVisitor& v) {
  v.Number("max_pixel_sigmas", c.max_pixel_sigmas, "(0, inf)",
           "largest distance of a plane's pixel from it, in standard deviations of the depth");
  v.Number("min_gain", c.min_gain, "[0, inf)",
           "mean lead over the next best plane that a plane's pixels must show, in squared "
           "standard deviations");
}

}  // namespace slam
