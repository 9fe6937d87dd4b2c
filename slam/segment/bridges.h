#pragma once

#include <cstdint>
#include <vector>

#include "slam/segment/depth_grid.h"
#include "slam/segment/label_components.h"
#include "slam/segment/pixel_labels.h"
#include "slam/segment/sight_lines.h"

namespace slam {

/// Takes components apart that only a bridge of a pixel or two holds together, when what lies
/// between their parts is behind the plane: two tops of one height, the desk's edge pixels
/// between them mistaken for theirs. A surface that holes make thin has nothing behind it and
/// stays whole. The memory of one image serves the next.
class BridgeCutter {
 public:
  /// @param planes      one a label
  /// @param max_behind  share of the measured pixels between two parts that may lie behind
  /// @param components  those of a label image; what is cut is split into runs of one
  ///                    component each
  void Cut(const DepthGrid& grid, const std::vector<LabelPlane>& planes, double max_behind,
           LabelComponents& components);

 private:
  /// A core large enough to be a surface of its own.
  struct Core {
    int component = 0, id = 0, pixels = 0;
    int part = 0;  ///< which part of its component it belongs to
  };
  void FindCores(const LabelComponents& components);
  int NumberParts(std::vector<Core>::iterator first, std::vector<Core>::iterator last,
                  const LabelPlane& plane, double max_behind);
  void Seed(const DepthGrid& grid, std::vector<Core>::iterator first,
            std::vector<Core>::iterator last);
  void Spread(const DepthGrid& grid);
  void Split(const DepthGrid& grid, int component, int part_count, LabelComponents& components);

  LabelComponents interior_;
  std::vector<Core> cores_;  ///< by component, the largest first
  SightLines between_;
  std::vector<std::int16_t> part_at_;  ///< for each pixel of a component that is cut
  std::vector<int> front_;             ///< pixels whose neighbours are to be looked at
  std::vector<int> part_of_core_;
  LabelRuns split_runs_;
  std::vector<int> split_components_;
};

}  // namespace slam
