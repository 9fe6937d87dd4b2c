#include "slam/tracking/look_alike.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "slam/features/match_features.h"
#include "slam/model/local_map.h"

namespace slam {
namespace {

/// A cell of a grid in space.
using Cell = std::array<int, 3>;

Cell CellOf(const Eigen::Vector3d& p, double side) {
  Cell cell{};
  for (int i = 0; i < 3; ++i) {
    cell[static_cast<std::size_t>(i)] = static_cast<int>(std::floor(p[i] / side));
  }
  return cell;
}

/// A matched feature: its look, and where its point is.
struct Seen {
  const Descriptor* look;
  Eigen::Vector3d p_w;
  double reach_m;
};

/// Points by where they are.
class PointCells {
 public:
  PointCells(const std::vector<int>& ids, const Map& map, double side_m)
      : map_(map), side_m_(side_m) {
    for (const int id : ids) {
      cells_[CellOf(map.points[static_cast<std::size_t>(id)].p_w, side_m)].push_back(id);
    }
  }

  /// @param visit  called with each point no farther than reach_m, at most the cells' side
  template <typename Visit>
  void Near(const Eigen::Vector3d& p_w, double reach_m, const Visit& visit) const {
    const Cell low = CellOf(p_w - Eigen::Vector3d::Constant(reach_m), side_m_),
               high = CellOf(p_w + Eigen::Vector3d::Constant(reach_m), side_m_);
    for (int x = low[0]; x <= high[0]; ++x) {
      for (int y = low[1]; y <= high[1]; ++y) {
        for (int z = low[2]; z <= high[2]; ++z) {
          const auto cell = cells_.find({x, y, z});
          if (cell == cells_.end()) continue;
          for (const int id : cell->second) {
            const MapPoint& point = map_.points[static_cast<std::size_t>(id)];
            if ((point.p_w - p_w).norm() <= reach_m) visit(point);
          }
        }
      }
    }
  }

 private:
  const Map& map_;
  double side_m_;
  std::map<Cell, std::vector<int>> cells_;
};

/// The frame's matches with the map.
/// @param reach  share of the distance to the camera
std::vector<Seen> MatchedFeatures(const Frame& frame, const Map& map, double reach) {
  std::vector<Seen> seen;
  for (std::size_t f = 0; f < frame.map_points.size(); ++f) {
    if (frame.map_points[f] == kNone) continue;
    const Eigen::Vector3d& p_w = map.points[static_cast<std::size_t>(frame.map_points[f])].p_w;
    seen.push_back({&frame.features[f].descriptor, p_w, reach * (frame.T_cw * p_w).norm()});
  }
  return seen;
}

/// Shifts that bring many features onto points of their look, the most voted first.
std::vector<Eigen::Vector3d> VotedShifts(const std::vector<Seen>& seen,
                                         const std::vector<int>& points, const Map& map,
                                         const LookAlikeConfig& config) {
  constexpr std::size_t kShifts = 8;  // that are tried; bounds the work
  struct Votes {
    int count = 0;
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  };
  // Each pair that looks alike votes for the shift between its points.
  std::map<Cell, Votes> votes;
  for (const Seen& one : seen) {
    for (const int id : points) {
      const MapPoint& point = map.points[static_cast<std::size_t>(id)];
      const Eigen::Vector3d shift = point.p_w - one.p_w;
      if (shift.norm() < config.min_shift_m ||
          DescriptorDistance(*one.look, point.descriptor) > config.max_distance) {
        continue;
      }
      Votes& cell = votes[CellOf(shift, config.min_shift_m)];
      ++cell.count;
      cell.sum += shift;
    }
  }
  // The mean shift of each of the fullest cells.
  std::vector<Votes> most;
  most.reserve(votes.size());
  for (const auto& [cell, vote] : votes) most.push_back(vote);
  std::stable_sort(most.begin(), most.end(),
                   [](const Votes& a, const Votes& b) { return a.count > b.count; });
  std::vector<Eigen::Vector3d> shifts;
  for (const Votes& vote : most) {
    if (shifts.size() == kShifts) break;
    shifts.push_back(vote.sum / vote.count);
  }
  return shifts;
}

/// How many features meet a point at a shift, and one that looks alike; the shift becomes the
/// mean of the latter.
/// @param slack  multiplies the reach
LookAlike TryShift(const std::vector<Seen>& seen, const PointCells& points,
                   const Eigen::Vector3d& shift_w, double slack, int max_distance) {
  LookAlike out{shift_w, 0, 0};
  Eigen::Vector3d off = Eigen::Vector3d::Zero();
  for (const Seen& one : seen) {
    const Eigen::Vector3d there = one.p_w + shift_w;
    int nearest = max_distance + 1;
    bool met = false;
    Eigen::Vector3d to = there;
    points.Near(there, slack * one.reach_m, [&](const MapPoint& point) {
      met = true;
      const int distance = DescriptorDistance(*one.look, point.descriptor);
      if (distance >= nearest) return;
      nearest = distance;
      to = point.p_w;
    });
    out.met += met;
    if (nearest > max_distance) continue;
    ++out.alike;
    off += to - there;
  }
  if (out.alike > 0) out.shift_w += off / out.alike;
  return out;
}

}  // namespace

std::optional<LookAlike> FindLookAlike(const Frame& frame, const Map& map,
                                       const LookAlikeConfig& config) {
  constexpr double kCoarse = 2.0, kFine = 1.0;  // times the reach
  const std::vector<int> around = GatherLocalMap(frame, map, config.max_keyframes).points;
  const std::vector<Seen> seen = MatchedFeatures(frame, map, config.reach);
  double side_m = config.min_shift_m;
  for (const Seen& one : seen) side_m = std::max(side_m, kCoarse * one.reach_m);
  const PointCells cells(around, map, side_m);

  // Try each shift twice: from the coarse vote, then from the mean of what it found.
  std::optional<LookAlike> best;
  for (const Eigen::Vector3d& voted : VotedShifts(seen, around, map, config)) {
    LookAlike there = TryShift(seen, cells, voted, kCoarse, config.max_distance);
    there = TryShift(seen, cells, there.shift_w, kFine, config.max_distance);
    if (there.shift_w.norm() < config.min_shift_m || there.alike < config.min_alike ||
        there.alike < config.min_share * there.met) {
      continue;
    }
    if (!best || there.alike > best->alike) best = there;
  }
  return best;
}

}  // namespace slam
