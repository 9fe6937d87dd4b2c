#pragma once

#include <set>
#include <utility>
#include <vector>

namespace slam {

/// Whether two planes of a frame can be pieces of one surface.
enum class Pieces {
  kOfTwo,   ///< on two objects, or certainly two by their parameters
  kUnsure,  ///< a step between them, or their parameters, speak against it
  kOfOne    ///< each fits the other, and where they are neighbours there is no step
};

/// Whether two planes of a frame can be pieces of one landmark. Where they alone leave that
/// unsure, it is enough that both have been seen as that landmark before: what looks like a
/// step between them is then what the sensor bends, or a wrong edge.
inline bool MayShare(Pieces pieces, bool one_was_seen, bool other_was_seen) {
  return pieces == Pieces::kOfOne ||
         (pieces == Pieces::kUnsure && one_was_seen && other_was_seen);
}

/// [f][g]: of planes f and g. Symmetric.
using PieceTable = std::vector<std::vector<Pieces>>;

/// A frame plane and a map plane that it can show.
struct AdmissiblePair {
  int frame_plane = 0;    ///< index
  int map_plane = 0;      ///< id
  double cost = 0.0;      ///< -2 log likelihood: less is better
  bool on_trial = false;  ///< the map plane is a candidate
  bool was_seen = false;  ///< the frame plane has been seen as the map plane before
};

/// What is known besides the costs. Both relations are symmetric.
struct PlaneRelations {
  PieceTable pieces;
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
/// frame planes only if all of them may share it (MayShare). A frame plane is ambiguous
/// when its best remaining candidate leads the next by less than `min_margin` and the two are
/// not duplicates of one landmark, or when it and a frame plane that cannot share the landmark
/// compete for it that closely, or the other fits better and is ambiguous itself: so a larger margin
/// never adds a match where no landmark is shared. A candidate makes no landmark ambiguous, nor a
/// landmark a candidate. The outcome does not depend on the order of `pairs`. Cost: O(c log c + c f)
/// for c pairs and f frame planes.
PlaneAssignment AssignPlanes(int frame_planes, std::vector<AdmissiblePair> pairs,
                             const PlaneRelations& relations, double min_margin);

}  // namespace slam
