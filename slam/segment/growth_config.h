#pragma once

#include "slam/base/field_visitor.h"

namespace slam {

/// Largest block_px and vote_reach_px, pixels: the memory around a block is made for them.
inline constexpr int kMaxBlockSide_px = 64, kMaxCostReach_px = 16;

/// How planes grow over pixels (PixelGrowth).
struct GrowthConfig {
  int block_px = 8;               ///< regions spread from block to block; domain [2, 64]
  double max_pixel_sigmas = 3.0;  ///< distance of a plane's pixel from it; domain (0, inf)
  /// A pixel between two planes goes to the one that fits the pixels within this many rows and
  /// columns best: the noise of single pixels must not decide. Domain [0, 16].
  int vote_reach_px = 2;
  /// A plane must explain its pixels better than the next best plane there does, by this much
  /// on average (difference of squared sigmas); otherwise it only steals from its neighbours,
  /// as the plane of a block across a step does. Domain [0, inf).
  double min_gain = 3.0;
};

inline void VisitFields(GrowthConfig& c, FieldVisitor& v) {
  v.Integer("block_px", c.block_px, "[2, 64]", "regions spread from block to block");
  v.Number("max_pixel_sigmas", c.max_pixel_sigmas, "(0, inf)",
           "distance of a plane's pixel from it");
  v.Integer("vote_reach_px", c.vote_reach_px, "[0, 16]",
            "pixels that decide between two planes");
  v.Number("min_gain", c.min_gain, "[0, inf)", "over the next best plane, squared sigmas");
}

}  // namespace slam
