#include "slam/associate/plane_assignment.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <tuple>

namespace slam {
namespace {

class Assigner {
 public:
  Assigner(int frame_planes, std::vector<PlaneCandidate> candidates,
           const PlaneRelations& relations, double min_margin)
      : candidates_(std::move(candidates)), relations_(relations), min_margin_(min_margin) {
    out_.map_plane.assign(static_cast<std::size_t>(frame_planes), PlaneAssignment::kNothing);
    settled_.assign(static_cast<std::size_t>(frame_planes), false);
    std::sort(candidates_.begin(), candidates_.end(), [](const auto& a, const auto& b) {
      return std::tie(a.cost, a.frame_plane, a.map_plane) <
             std::tie(b.cost, b.frame_plane, b.map_plane);
    });
  }

  PlaneAssignment Run() {
    for (const PlaneCandidate& pair : candidates_) {
      if (settled_[At(pair.frame_plane)] || !Open(pair)) continue;
      settled_[At(pair.frame_plane)] = true;
      if (HasCloseAlternative(pair) || HasCloseRival(pair)) {
        out_.map_plane[At(pair.frame_plane)] = PlaneAssignment::kAmbiguous;
      } else {
        out_.map_plane[At(pair.frame_plane)] = pair.map_plane;
        taken_[pair.map_plane].emplace_back(pair);
      }
    }
    return out_;
  }

 private:
  static std::size_t At(int i) { return static_cast<std::size_t>(i); }

  bool OneSurface(int f, int g) const { return relations_.one_surface[At(f)][At(g)]; }

  bool Duplicates(int m, int n) const {
    const std::pair<int, int> key = std::minmax(m, n);
    return std::find(relations_.duplicates.begin(), relations_.duplicates.end(), key) !=
           relations_.duplicates.end();
  }

  /// Every frame plane that already has this landmark can be the same surface.
  bool Open(const PlaneCandidate& pair) const {
    const auto found = taken_.find(pair.map_plane);
    if (found == taken_.end()) return true;
    return std::all_of(found->second.begin(), found->second.end(), [&](const auto& other) {
      return OneSurface(pair.frame_plane, other.frame_plane);
    });
  }

  /// Another landmark explains this frame plane nearly as well.
  bool HasCloseAlternative(const PlaneCandidate& pair) const {
    return std::any_of(candidates_.begin(), candidates_.end(), [&](const auto& other) {
      return other.frame_plane == pair.frame_plane && other.map_plane != pair.map_plane &&
             other.cost - pair.cost < min_margin_ && Open(other) &&
             !Duplicates(pair.map_plane, other.map_plane);
    });
  }

  /// Another frame plane, not of this surface, explains the landmark nearly as well.
  bool HasCloseRival(const PlaneCandidate& pair) const {
    return std::any_of(candidates_.begin(), candidates_.end(), [&](const auto& other) {
      if (other.map_plane != pair.map_plane || other.frame_plane == pair.frame_plane)
        return false;
      if (OneSurface(pair.frame_plane, other.frame_plane)) return false;
      if (other.cost - pair.cost >= min_margin_ || pair.cost - other.cost >= min_margin_)
        return false;
      // A rival that is at home elsewhere is none.
      const int home = out_.map_plane[At(other.frame_plane)];
      return !settled_[At(other.frame_plane)] ? !HasBetterHome(other)
                                              : home == PlaneAssignment::kAmbiguous;
    });
  }

  /// The frame plane has another landmark that it fits clearly better than this one.
  bool HasBetterHome(const PlaneCandidate& pair) const {
    return std::any_of(candidates_.begin(), candidates_.end(), [&](const auto& other) {
      return other.frame_plane == pair.frame_plane && other.map_plane != pair.map_plane &&
             pair.cost - other.cost >= min_margin_;
    });
  }

  std::vector<PlaneCandidate> candidates_;
  const PlaneRelations& relations_;
  double min_margin_;
  PlaneAssignment out_;
  std::vector<bool> settled_;
  std::map<int, std::vector<PlaneCandidate>> taken_;
};

}  // namespace

PlaneAssignment AssignPlanes(int frame_planes, std::vector<PlaneCandidate> candidates,
                             const PlaneRelations& relations, double min_margin) {
  return Assigner(frame_planes, std::move(candidates), relations, min_margin).Run();
}

}  // namespace slam
