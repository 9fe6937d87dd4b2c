#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "eval/formats/pose/pose.h"

namespace eval {

/// Indices (i, j), i < j, of two poses of one list.
using PosePair = std::pair<std::size_t, std::size_t>;
enum class PairMode { kConsecutive, kAll };

/// (0, d), (d, 2d), ... or every (i, i + d). @throws std::invalid_argument if d is 0.
std::vector<PosePair> PairsByFrames(std::size_t count, std::size_t delta, PairMode mode);

/// Consecutive: a mark wherever the path since the last mark reaches delta_m (pose 0 is none,
/// the overshoot is dropped); pairs of successive marks. All: for each i the single j > i whose
/// path length is nearest to delta_m, kept within tolerance_m.
std::vector<PosePair> PairsByPath(const std::vector<Pose>& poses, double delta_m,
                                  double tolerance_m, PairMode mode);

/// Consecutive: the accumulated rotation closes a pair whenever it reaches delta_rad, from pose
/// 0 on. All: every j > i whose direct angle is within tolerance_rad of delta_rad.
std::vector<PosePair> PairsByAngle(const std::vector<Pose>& poses, double delta_rad,
                                   double tolerance_rad, PairMode mode);

/// All: for each i the j > i whose stamp is nearest to stamp_i + delta_s, kept if it is at most
/// tolerance_s away: a gap of the run closes no pair. Consecutive: of these, each that begins where
/// the one before ends, or later. `stamps_s` rise.
std::vector<PosePair> PairsByTime(const std::vector<double>& stamps_s, double delta_s,
                                  double tolerance_s, PairMode mode = PairMode::kAll);

}  // namespace eval
