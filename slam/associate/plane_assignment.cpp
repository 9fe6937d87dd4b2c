#include "slam/associate/plane_assignment.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <tuple>

#include "slam/base/index.h"

namespace slam {
namespace {

class Assigner {
 public:
  Assigner(int frame_planes, std::vector<AdmissiblePair> pairs, const PlaneRelations& relations,
           double min_margin)
      : pairs_(std::move(pairs)), relations_(relations), min_margin_(min_margin) {
    out_.map_plane.assign(static_cast<std::size_t>(frame_planes), PlaneAssignment::kNothing);
    settled_.assign(static_cast<std::size_t>(frame_planes), false);
    std::sort(pairs_.begin(), pairs_.end(), [](const auto& a, const auto& b) {
      return std::tie(a.cost, a.frame_plane, a.map_plane) <
             std::tie(b.cost, b.frame_plane, b.map_plane);
    });
  }

  PlaneAssignment Run() {
    for (const AdmissiblePair& pair : pairs_) {
      if (settled_[Index(pair.frame_plane)] || !Open(pair)) continue;
      settled_[Index(pair.frame_plane)] = true;
      if (HasCloseAlternative(pair) || HasCloseCompetitor(pair)) {
        out_.map_plane[Index(pair.frame_plane)] = PlaneAssignment::kAmbiguous;
      } else {
        out_.map_plane[Index(pair.frame_plane)] = pair.map_plane;
        taken_[pair.map_plane].emplace_back(pair);
      }
    }
    return out_;
  }

 private:
  bool OneSurface(const AdmissiblePair& pair, const AdmissiblePair& other) const {
    const Pieces pieces = relations_.pieces[Index(pair.frame_plane)][Index(other.frame_plane)];
    return MayShare(pieces, pair.was_seen, other.was_seen);
  }

  bool Duplicates(int m, int n) const {
    return relations_.duplicates.contains(std::minmax(m, n));
  }

  /// Every frame plane that already has this landmark can be the same surface.
  bool Open(const AdmissiblePair& pair) const {
    const auto found = taken_.find(pair.map_plane);
    if (found == taken_.end()) return true;
    return std::all_of(found->second.begin(), found->second.end(),
                       [&](const auto& other) { return OneSurface(pair, other); });
  }

  /// Another landmark explains this frame plane nearly as well.
  bool HasCloseAlternative(const AdmissiblePair& pair) const {
    return std::any_of(pairs_.begin(), pairs_.end(), [&](const auto& other) {
      return other.frame_plane == pair.frame_plane && other.map_plane != pair.map_plane &&
             other.on_trial == pair.on_trial && other.cost - pair.cost < min_margin_ &&
             Open(other) && !Duplicates(pair.map_plane, other.map_plane);
    });
  }

  /// Another frame plane, not of this surface, explains the landmark nearly as well, or is in doubt and
  /// explains it better.
  bool HasCloseCompetitor(const AdmissiblePair& pair) const {
    return std::any_of(pairs_.begin(), pairs_.end(), [&](const auto& other) {
      if (other.map_plane != pair.map_plane || other.frame_plane == pair.frame_plane)
        return false;
      if (OneSurface(pair, other)) return false;
      if (other.cost - pair.cost >= min_margin_) return false;
      if (!settled_[Index(other.frame_plane)]) return pair.cost - other.cost < min_margin_;
      // One that is at home elsewhere does not compete.
      return out_.map_plane[Index(other.frame_plane)] == PlaneAssignment::kAmbiguous;
    });
  }

  std::vector<AdmissiblePair> pairs_;
  const PlaneRelations& relations_;
  double min_margin_;
  PlaneAssignment out_;
  std::vector<bool> settled_;
  std::map<int, std::vector<AdmissiblePair>> taken_;
};

}  // namespace

PlaneAssignment AssignPlanes(int frame_planes, std::vector<AdmissiblePair> pairs,
                             const PlaneRelations& relations, double min_margin) {
  return Assigner(frame_planes, std::move(pairs), relations, min_margin).Run();
}

}  // namespace slam
