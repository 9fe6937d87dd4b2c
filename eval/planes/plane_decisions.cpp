#include "eval/planes/plane_decisions.h"

#include <algorithm>
#include <iterator>

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

/// The surface has a landmark since an earlier frame.
bool IsInMap(const std::map<int, FirstLandmark>& landmarks, int truth, int frame) {
  const auto found = landmarks.find(truth);
  return found != landmarks.end() && found->second.frame < frame;
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
    says_by = says_by || plane.by.has_value();
    const int truth = e.TruthOf(plane);
    if (Decided(plane)) {
      decisions.push_back({{e.number, truth, *plane.map_plane, plane.pixels},
                           e.truth.stamp_s,
                           plane.by.value_or(""),
                           e.truth.T_gc * plane.centroid_c});
    } else if (plane.by == kByAmbiguous && truth != 0) {
      const bool is_largest = LargestPlaneOn(e, truth) == &plane;
      ambiguous.push_back({e.number, e.truth.stamp_s, truth, plane.pixels, is_largest});
    }
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

std::map<int, FirstLandmark> FirstLandmarks(const std::vector<PlaneDecision>& decisions) {
  std::map<int, FirstLandmark> landmarks;
  const std::map<int, int> owners = OwnersOf(RecordsOf(decisions));
  for (const PlaneDecision& decision : decisions) {
    const AssociationRecord& record = decision.record;
    landmarks.emplace(owners.at(record.map_plane),
                      FirstLandmark{record.map_plane, record.frame});
  }
  return landmarks;
}

UndecidedSurfaces FindUndecided(const DecisionHistory& history) {
  UndecidedSurfaces found;
  const std::map<int, FirstLandmark> landmarks = FirstLandmarks(history.decisions);
  for (const SeenSurface& surface : history.surfaces) {
    const bool early = !(surface.stamp_s - *history.first_s > kFirstLandmarks_s);
    const bool in_map = IsInMap(landmarks, surface.truth, surface.frame);
    if (early || !surface.is_large || !in_map) continue;
    ++found.large;
    if (!surface.decided) found.undecided.push_back(surface);
  }
  return found;
}

std::vector<AmbiguousPlane> FindAmbiguous(const DecisionHistory& history) {
  const std::map<int, FirstLandmark> landmarks = FirstLandmarks(history.decisions);
  std::vector<AmbiguousPlane> found;
  std::copy_if(history.ambiguous.begin(), history.ambiguous.end(), std::back_inserter(found),
               [&](const AmbiguousPlane& plane) {
                 return IsInMap(landmarks, plane.truth, plane.frame);
               });
  return found;
}

}  // namespace eval
