#pragma once

#include <cstddef>
#include <vector>

#include "slam/segment/block_pixels.h"
#include "slam/segment/depth_grid.h"
#include "slam/segment/label_runs.h"
#include "slam/segment/pixel_labels.h"

namespace slam {

/// What lies in the image between parts of one plane: something in front of it, so that the
/// plane can pass behind, or something behind it, so that the plane ends.
class SightLines {
 public:
  /// Samples every part on a grid of pixels. What is given must outlive what is asked; memory
  /// serves again.
  /// @param part  one a run, -1 = none
  void Begin(const DepthGrid& grid, const LabelRuns& runs, const std::vector<int>& part,
             int part_count);

  /// Share of the measured pixels on the lines between parts `a` and `b`, where they are
  /// nearest to each other, that lie clearly behind `plane`; 0 where nothing between them is
  /// measured.
  /// @param unsure_sigmas  what is as near to the plane is not clearly off it
  double ShareBehind(int a, int b, const LabelPlane& plane, double unsure_sigmas = 0.0);

  /// Whether `a` and `b` are what can be seen of one convex surface: of the lines between
  /// pixels all over both, most pass something clearly in front of `plane`, and hardly any sees
  /// past it. What else ends the parts, a table's own edge say, is not asked. Not for what
  /// noise cuts: then nothing is in front.
  bool AreSidesOfSomethingInFront(int a, int b, const LabelPlane& plane,
                                  double unsure_sigmas = 0.0) const;

 private:
  struct Pixel {
    int u = 0, v = 0;
  };
  struct Line {
    int length2 = 0;
    Pixel from, to;
  };
  /// Samples [begin, end) and what bounds them.
  struct Part {
    std::size_t begin = 0, end = 0;
    Pixel low, high;
  };
  struct Sample {
    int part = 0;
    Pixel at;
  };
  /// What a line from one part to another passes.
  enum class Sight { kPlaneOrNothing, kInFront, kBeyond };

  void AddMissed(int part_count);
  template <typename Visit>
  void Walk(const Line& line, const Visit& visit) const;
  int PartAt(std::size_t i) const;
  Sight Look(const Line& line, int a, int b, const PixelPlane& plane, float clear) const;
  void FindNearestLines(int a, int b);

  const DepthGrid* grid_ = nullptr;
  const LabelRuns* runs_ = nullptr;
  const std::vector<int>* part_ = nullptr;
  std::vector<Part> parts_;
  std::vector<Sample> samples_;
  std::vector<Pixel> pixels_;         ///< samples, part by part
  std::vector<std::size_t> row_end_;  ///< for each of them the next of its part not in its row
  std::vector<Line> lines_;           ///< the nearest, shortest first
};

}  // namespace slam
