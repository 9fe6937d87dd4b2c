#pragma once

#include <vector>

#include "slam/extract/pixel_labels.h"

namespace slam {

/// What lies between two parts of one plane in the image: something in front, so that the plane
/// can pass behind it, or something behind, so that the plane ends.
class SightLines {
 public:
  /// Samples every component of the image on a grid.
  void Start(const DepthGrid& grid, const LabelComponents& components,
             const LabelImage& labels);

  /// Share of the measured pixels on lines between components `a` and `b`, where they are
  /// nearest to each other, that lie behind `plane`; 0 where nothing between them is measured.
  double ShareBehind(const DepthGrid& grid, const LabelComponents& components,
                     const LabelImage& labels, int a, int b, const LabelPlane& plane) const;

 private:
  struct Pixel {
    int u = 0, v = 0;
  };
  struct Pair {
    int distance2 = 0;
    Pixel a, b;
  };
  std::vector<std::vector<Pixel>> samples_;  ///< of each component
  mutable std::vector<Pair> pairs_;
};

}  // namespace slam
