#include "app/bench/wrong_planes.h"

#include <cmath>
#include <limits>

#include "eval/formats/stamps.h"
#include "slam/base/random.h"

namespace app {
namespace {

constexpr double kParallelCosine = 0.985;  // 10 degrees: what association may take for parallel

bool IsMatch(const slam::PlaneMatch& match) {
  return match.decision == slam::PlaneDecision::kMatched && match.map_plane != slam::kNone;
}

/// The landmark that the frame plane is most easily taken for, of those in the frame; kNone when
/// there is no other.
int MostAlike(const slam::Frame& frame, const slam::Map& map, std::size_t f) {
  const slam::FramePlane& plane = frame.planes[f];
  const slam::Pose T_wc = slam::Inverse(frame.T_cw);
  const Eigen::Vector3d n_w = T_wc.R * plane.pi_c.n, x_w = T_wc * plane.centroid_c;
  int best = slam::kNone;
  bool best_parallel = false;
  double best_m = std::numeric_limits<double>::infinity();
  for (const slam::PlaneMatch& match : frame.plane_matches) {
    if (!IsMatch(match) || match.map_plane == frame.plane_matches[f].map_plane) continue;
    const slam::Plane& other = map.planes.At(match.map_plane).pi_w;
    const bool parallel = other.n.dot(n_w) > kParallelCosine;
    const double distance_m = std::abs(slam::SignedDistance(other, x_w));
    if (parallel < best_parallel) continue;
    if (parallel == best_parallel && !(distance_m < best_m)) continue;
    best = match.map_plane, best_parallel = parallel, best_m = distance_m;
  }
  return best;
}

}  // namespace

void WrongPlanes::operator()(slam::Frame& frame, const slam::Map& map) {
  const std::vector<slam::PlaneMatch> right = frame.plane_matches;
  std::vector<slam::PlaneMatch> spoilt = right;
  for (std::size_t f = 0; f < right.size(); ++f) {
    if (!IsMatch(right[f])) continue;
    ++matches_;
    slam::Random random{seed_, static_cast<std::uint64_t>(frame.index), f};
    if (!(random.Uniform() < share_)) continue;
    const int other = MostAlike(frame, map, f);
    if (other == slam::kNone) continue;
    spoilt[f].map_plane = other;
    made_.push_back({frame.index, frame.timestamp_s, static_cast<int>(f), other});
  }
  frame.plane_matches = std::move(spoilt);
}

int CountTakenBack(const std::vector<WrongPlane>& wrong,
                   const std::vector<eval::RunFrame>& frames) {
  const std::vector<double> stamps_s = eval::StampsOf(frames);
  int taken_back = 0;
  for (const WrongPlane& one : wrong) {
    const auto at = eval::FindStamp(stamps_s, one.stamp_s);
    if (!at || one.plane >= static_cast<int>(frames[*at].planes.size())) continue;
    const auto& plane = frames[*at].planes[static_cast<std::size_t>(one.plane)];
    taken_back += plane.map_plane != one.map_plane ? 1 : 0;
  }
  return taken_back;
}

}  // namespace app
