#pragma once

#include <cstdint>
#include <vector>

#include "eval/formats/run/frame_planes.h"
#include "slam/model/frame.h"
#include "slam/model/map.h"

namespace app {

/// A match that was made wrong.
struct WrongPlane {
  int frame = 0;  ///< its index
  double stamp_s = 0.0;
  int plane = 0;      ///< index in the frame
  int map_plane = 0;  ///< id that it was put on
};

/// Makes a share of a run's matches of planes wrong, for benches and tests: a matched frame plane is
/// put on another landmark that the frame shows. The parallel ones come first, of them the one
/// nearest to the patch: the mistake that is hardest to see. Which ones depends on the seed, the
/// frame and the plane alone. A hook of the tracker (TrackerHooks::after_association).
class WrongPlanes {
 public:
  /// @param share  of the matches, in [0, 1]
  WrongPlanes(double share, std::uint64_t seed) : share_(share), seed_(seed) {}

  void operator()(slam::Frame& frame, const slam::Map& map);

  int matches() const { return matches_; }  ///< of landmarks, in all frames
  const std::vector<WrongPlane>& made() const { return made_; }

 private:
  double share_;
  std::uint64_t seed_;
  int matches_ = 0;
  std::vector<WrongPlane> made_;
};

/// How many of the wrong matches a run took back before the map learnt from them.
/// @param frames  its decisions
int CountTakenBack(const std::vector<WrongPlane>& wrong,
                   const std::vector<eval::RunFrame>& frames);

}  // namespace app
