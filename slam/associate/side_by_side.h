#pragma once

#include <optional>
#include <vector>

#include "slam/geometry/camera.h"
#include "slam/model/frame.h"

namespace slam {

/// Height of one plane over another where they are neighbours in the picture.
struct StepBetween {
  double step_m = 0.0;
  double sigma_m = 0.0;  ///< by the scatter of what it was measured from
};

/// Compares planes of a frame where they lie side by side. What the sensor gets wrong there it
/// gets wrong for both: the step is known better than either plane is, and much better than
/// from planes extended to their neighbours.
class SideBySide {
 public:
  /// Reads depth and labels; a frame without them has no neighbours.
  SideBySide(const Frame& frame, const Camera& camera);

  /// From a common slope and two heights, fitted to tiles of both planes that are at most 40
  /// pixels (at a width of 640) from the other.
  /// @returns nothing where they are no neighbours, or too little of them is
  std::optional<StepBetween> Between(std::size_t one, std::size_t other) const;

 private:
  struct Tile {
    int column = 0, row = 0;
    double pixels = 0.0;
    Eigen::Vector3d mean_c = Eigen::Vector3d::Zero();
  };
  using Tiles = std::vector<Tile>;

  Tiles Near(const Tiles& of, const Tiles& to) const;

  const Frame& frame_;
  int columns_, rows_;
  int reach_;                 ///< tiles
  std::vector<Tiles> tiles_;  ///< by frame plane
};

}  // namespace slam
