#pragma once

#include <set>
#include <utility>
#include <vector>

namespace slam {

/// A frame plane and a map plane that it can show.
struct AdmissiblePair {
  int frame_plane = 0;    ///< index
  int map_plane = 0;      ///< id
  double cost = 0.0;      ///< -2 log likelihood: less is better
  bool on_trial = false;  ///< the map plane is a candidate
};

/// What is known besides the costs. Both relations are symmetric.
struct PlaneRelations {
  /// [f][g]: the two frame planes can be pieces of one surface.
  std::vector<std::vector<bool>> one_surface;
  /// Ids of map planes that can be one surface found twice, the lower first.
  std::set<std::pair<int, int>> duplicates;
};

/// For each frame plane: a map plane, nothing, or not to be decided.
struct PlaneAssignment {
  static constexpr int kNothing = -1;
  static constexpr int kAmbiguous = -2;
  std::vector<int> map_plane;
};

/// Best-first assignment. Pairs are taken from the likeliest on; a map plane takes several
/// frame planes only if all of them can be pieces of one surface. A frame plane is ambiguous
/// when its best remaining candidate leads the next by less than `min_margin` and the two are
/// not duplicates of one landmark, or when it and a frame plane that cannot share the landmark
/// compete for it that closely. A candidate makes no landmark ambiguous, nor a landmark a
/// candidate. The outcome does not depend on the order of `pairs`. Cost: O(c log c + c f) for c
/// pairs and f frame planes.
PlaneAssignment AssignPlanes(int frame_planes, std::vector<AdmissiblePair> pairs,
                             const PlaneRelations& relations, double min_margin);

}  // namespace slam
