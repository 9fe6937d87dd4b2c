#pragma once

#include <array>
#include <cstddef>

namespace slam {

/// What refused a pair of a frame plane and a map plane, or put it in doubt.
enum class PairRefusal {
  kNormalAngle,          ///< eq6
  kNoEdgePoints,         ///< eq8 has nothing to ask
  kOffsetAndEdgePoints,  ///< eq7 and eq8
  kParameters,           ///< chi-square of offset and slopes
  kOverlap,              ///< the footprints do not meet
  kCost,                 ///< all cues together
  kRankTest,             ///< eq9 to eq12
  kNearestPoint          ///< bounds of the peers' programs
};

inline constexpr std::array<const char*, 8> kPairRefusalNames = {
    "normal_angle", "no_edge_points", "offset_and_edge_points", "parameters", "overlap",
    "cost",         "rank_test",      "nearest_point"};

/// How many pairs each cue refused or put in doubt. The sums over a run stand in run.json as
/// `refused_pairs`, by these names.
struct PairRefusals {
  std::array<long, kPairRefusalNames.size()> count{};

  void Add(PairRefusal refusal) { ++count[static_cast<std::size_t>(refusal)]; }
  void Add(const PairRefusals& other) {
    for (std::size_t i = 0; i < count.size(); ++i) count[i] += other.count[i];
  }
};

}  // namespace slam
