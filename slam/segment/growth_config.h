#pragma once

#include "slam/base/field_visitor.h"

namespace slam {

/// Largest block_px and vote_reach_px, pixels: the memory around a block is made for them.
inline constexpr int kMaxBlockSide_px = 64, kMaxCostReach_px = 16;

/// How planes grow over pixels (PixelGrowth).
struct GrowthConfig {
  int block_px = 8;
  double max_pixel_sigmas = 3.0;
  int vote_reach_px = 2;  // the noise of single pixels must not decide
  /// A plane that explains its pixels hardly better than the next best plane there only steals
  /// from its neighbours, as the plane of a block across a step does.
  double min_gain = 3.0;
};

inline void VisitFields(GrowthConfig& c, FieldVisitor& v) {
  v.Integer("block_px", c.block_px, "[2, 64]", "side of the blocks over which regions spread");
  v.Number("max_pixel_sigmas", c.max_pixel_sigmas, "(0, inf)",
           "largest distance of a plane's pixel from it, in standard deviations of the depth");
  v.Integer("vote_reach_px", c.vote_reach_px, "[0, 16]",
            "rows and columns around a pixel that decide which of two planes it belongs to");
  v.Number("min_gain", c.min_gain, "[0, inf)",
           "mean lead over the next best plane that a plane's pixels must show, in squared "
           "standard deviations");
}

}  // namespace slam
