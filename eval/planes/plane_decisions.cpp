#include "eval/planes/plane_decisions.h"

namespace eval {
namespace {

/// The frame plane that shows most of the surface; null when none shows it mostly.
const RunFramePlane* LargestPlaneOn(const FrameEvidence& e, int truth) {
  const RunFramePlane* largest = nullptr;
  for (const RunFramePlane& plane : e.planes) {
    if (e.TruthOf(plane) != truth) continue;
    if (largest == nullptr || plane.pixels > largest->pixels) largest = &plane;
  }
  return largest;
}

}  // namespace

std::string WhyUndecided(const RunFramePlane* plane) {
  if (plane == nullptr) return kNoFramePlane;
  if (plane->by) return *plane->by;
  return plane->bad ? "bad: " + *plane->bad : "";
}

void DecisionHistory::Add(const FrameEvidence& e) {
  if (!first_s) first_s = e.truth.stamp_s;
  for (const RunFramePlane& plane : e.planes) {
    if (!Decided(plane)) continue;
    decisions.push_back({{e.number, e.TruthOf(plane), *plane.map_plane, plane.pixels},
                         e.truth.stamp_s,
                         plane.by.value_or(""),
                         e.truth.T_gc * plane.centroid_c});
  }
  for (const SeenPlane& seen : e.truth.planes) {
    if (!seen.counted) continue;
    const bool is_large = seen.pixels > kLargeSurfaceShare * e.truth.image_px;
    const RunFramePlane* plane = LargestPlaneOn(e, seen.plane->id);
    const bool decided = plane != nullptr && Decided(*plane);
    surfaces.push_back({e.number, e.truth.stamp_s, seen.plane->id, seen.pixels, is_large,
                        decided, decided ? "" : WhyUndecided(plane)});
  }
}

std::vector<AssociationRecord> RecordsOf(const std::vector<PlaneDecision>& decisions) {
  std::vector<AssociationRecord> records;
  records.reserve(decisions.size());
  for (const PlaneDecision& decision : decisions) records.push_back(decision.record);
  return records;
}

UndecidedSurfaces FindUndecided(const DecisionHistory& history) {
  UndecidedSurfaces found;
  const std::map<int, int> owners = OwnersOf(RecordsOf(history.decisions));
  std::set<int> owned;  // truths that own a map plane, as of the frame before
  auto decision = history.decisions.begin();
  for (const SeenSurface& surface : history.surfaces) {
    for (; decision != history.decisions.end() && decision->record.frame < surface.frame;
         ++decision) {
      owned.insert(owners.at(decision->record.map_plane));
    }
    const bool early = !(surface.stamp_s - *history.first_s > kFirstLandmarks_s);
    if (early || !surface.is_large || owned.count(surface.truth) == 0) continue;
    ++found.large;
    if (!surface.decided) found.undecided.push_back(surface);
  }
  return found;
}

}  // namespace eval
