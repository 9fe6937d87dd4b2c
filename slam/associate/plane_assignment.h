#pragma once

#include <utility>
#include <vector>

namespace slam {

/// One admissible pair, `cost` in -2 log likelihood: lower is better.
struct PlaneCandidate {
  int frame_plane = 0;
  int map_plane = 0;
  double cost = 0.0;
};

/// What is known besides the costs. Both relations are symmetric.
struct PlaneRelations {
  /// [f][g]: the two frame planes can be pieces of one surface.
  std::vector<std::vector<bool>> one_surface;
  /// Map planes, by position: can be the same landmark found twice. Pairs (m, m') with m < m'.
  std::vector<std::pair<int, int>> duplicates;
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
/// not duplicates of one landmark, or when it and a rival that cannot share the landmark are
/// that close. The outcome does not depend on the order of `candidates`. Cost: O(c log c + c f)
/// for c candidates and f frame planes.
PlaneAssignment AssignPlanes(int frame_planes, std::vector<PlaneCandidate> candidates,
                             const PlaneRelations& relations, double min_margin);

}  // namespace slam
