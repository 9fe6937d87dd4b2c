#pragma once

#include <optional>
#include <vector>

#include "slam/geometry/plane_sums.h"

namespace slam {

/// The pixels of a segment in a square of the image.
struct SeamCell {
  double u = 0.0, v = 0.0;  ///< its middle, pixels
  PlaneSums sums;
};

/// A straight line in the image.
struct Seam {
  double cosine = 1.0, sine = 0.0;  ///< of the direction across it
  double at_px = 0.0;               ///< its place in that direction

  /// Signed distance of a pixel from the line.
  double Beyond(double u, double v) const { return u * cosine + v * sine - at_px; }
  double Along(double u, double v) const { return v * cosine - u * sine; }
};

/// Finds the line that divides a segment so that two planes, one on either side, explain its
/// pixels best: the boundary between faces of boxes is straight, or nearly so where a lens
/// bends it. Lines a large cell apart are tried in twelve directions; those around the best
/// direction, a small cell apart, follow. The memory of one search serves the next.
class SeamSearch {
 public:
  struct Bounds {
    double min_pixels = 0.0;  ///< on either side
    double min_gain = 0.0;    ///< of two planes over one, in squared sigmas
  };

  /// @param small  cells of side `small_px`
  /// @param large  the same pixels in cells of twice that
  /// @returns nothing if no line keeps the bounds
  std::optional<Seam> Find(const std::vector<SeamCell>& small,
                           const std::vector<SeamCell>& large, double small_px,
                           const Bounds& bounds);

 private:
  void TryDirection(const std::vector<SeamCell>& cells, double step_px, double angle_rad);

  Bounds bounds_;
  PlaneSums all_;
  std::vector<PlaneSums> strips_;
  double least_error_ = 0.0, best_angle_rad_ = 0.0;
  Seam best_;
};

}  // namespace slam
