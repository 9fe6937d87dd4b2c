#include "eval/planes/truth_of_planes.h"

#include <cmath>
#include <limits>
#include <numbers>

#include "eval/planes/polygon.h"

namespace eval {

std::map<int, int> TruthByPixels(const TrueFrame& frame, const LabelPairs& pairs) {
  const Overlap overlap = OverlapOf(pairs);
  std::map<int, int> truth_of;
  for (const auto& [label, pixels] : overlap.machine_pixels) {
    long long most = 0, on_truth = 0;
    int truth = 0;
    for (const SeenPlane& seen : frame.planes) {
      const long long shared = overlap.Shared(seen.plane->id, label);
      on_truth += shared;
      if (shared > most) {
        most = shared;
        truth = seen.plane->id;
      }
    }
    truth_of[label - 1] = most >= pixels - on_truth ? truth : 0;
  }
  return truth_of;
}

int TruthByGeometry(const TrueFrame& frame, const RunFramePlane& plane) {
  int truth = 0;
  double least = std::numeric_limits<double>::infinity();
  for (const SeenPlane& seen : frame.planes) {
    const double angle_deg = Angle(seen.pi_c.n, plane.pi_c.n) * 180.0 / std::numbers::pi;
    const double offset_m = SignedDistance(seen.pi_c, plane.centroid_c);
    if (!(angle_deg <= kMaxTruthNormal_deg) || !(std::abs(offset_m) <= kMaxTruthOffset_m)) {
      continue;
    }
    const PlaneChart chart = ChartOf(seen.pi_c, seen.corners_c.front());
    const double gap_m =
        Distance(chart(plane.centroid_c), ConvexHull(Project(chart, seen.corners_c)));
    if (!(gap_m <= kMaxTruthGap_m)) continue;
    const double times = plane.pixels > 0 ? double(plane.pixels) / seen.pixels : 1.0;
    const double unlike =
        std::pow(offset_m / kTruthOffsetScale_m, 2) + std::pow(std::log(times), 2);
    if (!(unlike < least)) continue;
    truth = seen.plane->id;
    least = unlike;
  }
  return truth;
}

LabelPairs CountedPairs(const TrueFrame& frame, const LabelPairs& pairs,
                        const std::map<int, int>& region_of) {
  std::map<int, bool> counts;  // by id of a scored plane
  for (const SeenPlane& seen : frame.planes) counts[seen.plane->id] = seen.counted;
  LabelPairs counted;
  for (const auto& [labels, pixels] : pairs) {
    const auto plane = counts.find(labels.first);
    if (plane != counts.end() && !plane->second) continue;
    const int truth = plane != counts.end() ? labels.first : 0;
    const auto region = region_of.find(labels.second);
    counted[{truth, region == region_of.end() ? 0 : region->second}] += pixels;
  }
  return counted;
}

}  // namespace eval
