#include "eval/planes/truth_of_planes.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "eval/planes/polygon.h"

namespace eval {

std::map<int, int> TruthByPixels(const TrueFrame& frame, const cv::Mat1w& segmentation) {
  if (!frame.plane_ids) {
    throw std::invalid_argument("TruthByPixels: the frame has no image of plane ids");
  }
  const Overlap overlap = CountOverlap(*frame.plane_ids, segmentation);
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
  struct Candidate {
    int id;
    double offset_m, gap_m;
  };
  std::vector<Candidate> candidates;
  double least_offset_m = std::numeric_limits<double>::infinity();
  for (const SeenPlane& seen : frame.planes) {
    const double angle_deg = Angle(seen.pi_c.n, plane.pi_c.n) * 180.0 / std::numbers::pi;
    const double offset_m = std::abs(SignedDistance(seen.pi_c, plane.centroid_c));
    if (!(angle_deg <= kMaxTruthNormal_deg) || !(offset_m <= kMaxTruthOffset_m)) continue;
    const PlaneChart chart = ChartOf(seen.pi_c, seen.corners_c.front());
    const double gap_m =
        Distance(chart(plane.centroid_c), ConvexHull(Project(chart, seen.corners_c)));
    if (!(gap_m <= kMaxTruthGap_m)) continue;
    candidates.push_back({seen.plane->id, offset_m, gap_m});
    least_offset_m = std::min(least_offset_m, offset_m);
  }
  int truth = 0;
  double least_gap_m = std::numeric_limits<double>::infinity();
  for (const Candidate& c : candidates) {
    if (c.offset_m > least_offset_m + kSameOffset_m || !(c.gap_m < least_gap_m)) continue;
    truth = c.id;
    least_gap_m = c.gap_m;
  }
  return truth;
}

Overlap CountedOverlap(const TrueFrame& frame, const cv::Mat1w& segmentation,
                       const std::map<int, int>& region_of) {
  constexpr std::size_t kLabels = std::size_t{1} << 16;  // all that a pixel can hold
  std::vector<std::uint16_t> machine_table(kLabels, 0), truth_table(kLabels, 0);
  std::vector<bool> is_void(kLabels, false);
  for (const auto& [label, region] : region_of) {
    machine_table[static_cast<std::size_t>(label)] = static_cast<std::uint16_t>(region);
  }
  for (const SeenPlane& seen : frame.planes) {
    const auto id = static_cast<std::uint16_t>(seen.plane->id);
    is_void[id] = !seen.counted;
    if (seen.counted) truth_table[id] = id;
  }
  cv::Mat1w truth(segmentation.size()), machine(segmentation.size());
  for (int y = 0; y < truth.rows; ++y) {
    for (int x = 0; x < truth.cols; ++x) {
      const std::uint16_t id = (*frame.plane_ids)(y, x);
      truth(y, x) = truth_table[id];
      machine(y, x) = is_void[id] ? std::uint16_t{0} : machine_table[segmentation(y, x)];
    }
  }
  return CountOverlap(truth, machine);
}

}  // namespace eval
