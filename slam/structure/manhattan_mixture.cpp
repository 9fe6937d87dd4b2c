#include "slam/structure/manhattan_mixture.h"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <map>

#include "slam/model/map_queries.h"
#include "slam/pose/plane_constraints.h"

namespace slam {
namespace {

using SeenLandmarks = std::map<int, const FramePlane*>;  // by id

/// The largest segment of each landmark that trusted, large planes show.
SeenLandmarks LandmarksIn(const Frame& frame, const Map& map, const ManhattanConfig& config) {
  SeenLandmarks seen;
  for (std::size_t i = 0; i < frame.planes.size(); ++i) {
    const FramePlane& plane = frame.planes[i];
    const MapPlane* matched = TrustedMatch(frame, map, i);
    if (matched == nullptr || !(plane.area_m2 > config.min_area_m2)) continue;
    const FramePlane*& largest = seen[CurrentPlane(map, matched->id)];
    if (largest == nullptr || plane.pixel_count > largest->pixel_count) largest = &plane;
  }
  return seen;
}

/// The frame's planes of a stored frame's landmarks, in its order; empty when one is missing.
std::vector<const FramePlane*> PlanesOf(const ManhattanFrame& stored, const Map& map,
                                        const SeenLandmarks& seen) {
  std::vector<const FramePlane*> planes;
  for (const int id : stored.landmarks) {
    if (id == kNone) continue;
    const auto found = seen.find(CurrentPlane(map, id));
    if (found == seen.end()) return {};
    planes.push_back(found->second);
  }
  return planes;
}

/// Directions at right angles nearest to the normals; the third of two is their product.
ManhattanFrame FrameOf(const std::vector<int>& ids, const SeenLandmarks& seen, int keyframe) {
  ManhattanFrame made;
  made.keyframe = keyframe;
  made.seen = 1;
  Eigen::Matrix3d normals = Eigen::Matrix3d::Zero();
  for (std::size_t k = 0; k < ids.size(); ++k) {
    const FramePlane& plane = *seen.at(ids[k]);
    made.landmarks[k] = ids[k];
    normals.col(static_cast<int>(k)) = plane.pi_c.n;
    made.sigma_rad[static_cast<int>(k)] = plane.AngleSigma_rad();
  }
  if (ids.size() == 2) normals.col(2) = normals.col(0).cross(normals.col(1)).normalized();
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(normals,
                                              Eigen::ComputeFullU | Eigen::ComputeFullV);
  made.axes_k = svd.matrixU() * svd.matrixV().transpose();
  return made;
}

class NewFrames {
 public:
  NewFrames(const SeenLandmarks& seen, int keyframe, const ManhattanConfig& config, Map& map)
      : seen_(seen), keyframe_(keyframe), config_(config), map_(map) {}

  bool AtRightAngles(int one, int other) const {
    const double angle = Angle(seen_.at(one)->pi_c.n, seen_.at(other)->pi_c.n);
    return std::abs(angle - 0.5 * M_PI) < config_.max_pair_angle_rad;
  }
  /// Stores these landmarks' frame, or counts the keyframe for it.
  void Learn(const std::vector<int>& ids) {
    for (ManhattanFrame& stored : map_.manhattan) {
      std::vector<int> known;
      for (const int id : stored.landmarks) {
        if (id != kNone) known.push_back(CurrentPlane(map_, id));
      }
      std::sort(known.begin(), known.end());
      if (known != ids) continue;
      ++stored.seen;
      return;
    }
    map_.manhattan.push_back(FrameOf(ids, seen_, keyframe_));
  }

 private:
  const SeenLandmarks& seen_;
  int keyframe_;
  const ManhattanConfig& config_;
  Map& map_;
};

}  // namespace

std::vector<AxisObservation> SeenManhattanFrame(const Frame& frame, const Map& map,
                                                const ManhattanConfig& config) {
  const SeenLandmarks seen = LandmarksIn(frame, map, config);
  const ManhattanFrame* best = nullptr;
  std::vector<const FramePlane*> best_planes;
  for (const ManhattanFrame& stored : map.manhattan) {
    std::vector<const FramePlane*> planes = PlanesOf(stored, map, seen);
    if (planes.empty() || planes.size() < best_planes.size()) continue;
    if (planes.size() == best_planes.size() && stored.seen <= best->seen) continue;
    best = &stored;
    best_planes = std::move(planes);
  }
  std::vector<AxisObservation> axes;
  for (std::size_t k = 0; k < best_planes.size(); ++k) {
    const int column = static_cast<int>(k);
    const Eigen::Matrix3d R_wk = KeyframePose(map, best->keyframe).R.transpose();
    const double now_rad = best_planes[k]->AngleSigma_rad();
    axes.push_back({R_wk * best->axes_k.col(column), best_planes[k]->pi_c.n,
                    std::hypot(now_rad, best->sigma_rad[column], config.axis_sigma_rad)});
  }
  return axes;
}

void LearnManhattanFrames(const Frame& frame, int keyframe, const ManhattanConfig& config,
                          Map& map) {
  const SeenLandmarks seen = LandmarksIn(frame, map, config);
  NewFrames frames(seen, keyframe, config, map);
  for (auto i = seen.begin(); i != seen.end(); ++i) {
    for (auto j = std::next(i); j != seen.end(); ++j) {
      if (!frames.AtRightAngles(i->first, j->first)) continue;
      frames.Learn({i->first, j->first});
      for (auto k = std::next(j); k != seen.end(); ++k) {
        if (frames.AtRightAngles(i->first, k->first) &&
            frames.AtRightAngles(j->first, k->first))
          frames.Learn({i->first, j->first, k->first});
      }
    }
  }
}

}  // namespace slam
