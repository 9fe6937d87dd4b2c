#pragma once

#include <vector>

#include "slam/extract/depth_grid.h"
#include "slam/extract/pixel_labels.h"

namespace slam {

/// What lies in the image between parts of one plane: something in front of it, so that the
/// plane can pass behind, or something behind it, so that the plane ends.
class SightLines {
 public:
  /// Samples every part on a grid of pixels. @param part  of each pixel, -1 = none
  /// @param unsure_side_sigmas  at least so far behind is clearly behind
  SightLines(const DepthGrid& grid, const std::vector<int>& part, int part_count,
             double unsure_side_sigmas = 0.0);

  /// Share of the measured pixels on the lines between parts `a` and `b`, where they are
  /// nearest to each other, that lie clearly behind `plane`; 0 where nothing between them is
  /// measured.
  double ShareBehind(int a, int b, const LabelPlane& plane) const;

 private:
  struct Pixel {
    int u = 0, v = 0;
  };
  struct Line {
    int length2 = 0;
    Pixel from, to;
  };
  std::vector<Line> NearestLines(int a, int b) const;

  const DepthGrid& grid_;
  const std::vector<int>& part_;
  float behind_sigmas_;
  std::vector<std::vector<Pixel>> samples_;  ///< of each part
};

}  // namespace slam
