#include "slam/mapping/keyframes.h"

#include <algorithm>

#include "slam/base/index.h"
#include "slam/base/require.h"
#include "slam/mapping/map_points.h"
#include "slam/model/map_queries.h"

namespace slam {
namespace {

/// Unmatched features with depth, the nearest first.
std::vector<int> NearestUnmatched(const Keyframe& keyframe) {
  std::vector<int> features;
  for (int f = 0; f < static_cast<int>(keyframe.features.size()); ++f) {
    if (keyframe.map_points[Index(f)] == kNone && keyframe.features[Index(f)].depth_m > 0) {
      features.push_back(f);
    }
  }
  std::stable_sort(features.begin(), features.end(), [&](int a, int b) {
    return keyframe.features[Index(a)].depth_m < keyframe.features[Index(b)].depth_m;
  });
  return features;
}

/// Makes points of features with trusted depth, and of farther ones until there are enough.
void AddPointsFromDepth(Map& map, int id, const Camera& camera, const FeatureScale& scale,
                        const KeyframeConfig& config) {
  const double close_m = scale.CloseDepth_m(camera.fx);
  const Pose T_wc = Inverse(map.keyframes[Index(id)].T_cw);
  int added = 0;
  for (const int f : NearestUnmatched(map.keyframes[Index(id)])) {
    const PointFeature& feature = map.keyframes[Index(id)].features[Index(f)];
    if (feature.depth_m > close_m && added >= config.min_new_points) break;
    AddPoint(map, T_wc * camera.Backproject(feature.u_px, feature.depth_m), id, f, scale);
    ++added;
  }
}

/// Whether enough other keyframes see the point at most an octave coarser.
bool SeenByOthers(const Map& map, const MapPoint& point, int keyframe, int octave,
                  const KeyframeConfig& config) {
  int others = 0;
  for (const auto& [other, feature] : point.observations) {
    if (other == keyframe) continue;
    if (map.keyframes[Index(other)].features[Index(feature)].octave <= octave + 1) ++others;
  }
  return others >= config.redundant_views;
}

/// Most of the keyframe's points with trusted depth are seen by enough others.
bool IsRedundant(const Map& map, const Keyframe& keyframe, double close_m,
                 const KeyframeConfig& config) {
  int points = 0, redundant = 0;
  for (std::size_t f = 0; f < keyframe.features.size(); ++f) {
    const int id = keyframe.map_points[f];
    const PointFeature& feature = keyframe.features[f];
    if (id == kNone || !(feature.depth_m > 0 && feature.depth_m <= close_m)) continue;
    ++points;
    if (SeenByOthers(map, map.points[Index(id)], keyframe.id, feature.octave, config)) {
      ++redundant;
    }
  }
  return points > 0 && redundant > config.max_redundancy * points;
}

/// Takes the keyframe out of the map; its pose follows its best neighbour from now on.
void CullKeyframe(Map& map, int id) {
  const std::vector<int> best = BestCovisible(map, id, 1);
  Keyframe& keyframe = map.keyframes[Index(id)];
  keyframe.parent = best.empty() ? 0 : best.front();
  keyframe.T_cp = keyframe.T_cw * Inverse(map.keyframes[Index(keyframe.parent)].T_cw);
  keyframe.culled = true;
  for (const int point : std::vector<int>(keyframe.map_points)) {
    if (point != kNone) RemoveObservation(map, point, id);
  }
  for (const auto& [other, shared] : keyframe.covisible) {
    map.keyframes[Index(other)].covisible.erase(id);
  }
  keyframe.covisible.clear();
  // Its pose is all that is asked of it from now on: a camera that goes on over known ground
  // makes and culls keyframes without end.
  std::vector<PointFeature>().swap(keyframe.features);  // clear() would keep the memory
  std::vector<int>().swap(keyframe.map_points);
  std::vector<KeyframePlane>().swap(keyframe.planes);
}

}  // namespace

int InsertKeyframe(Frame& frame, Map& map, const Camera& camera, const FeatureScale& scale,
                   const KeyframeConfig& config) {
  Require(frame.map_points.size() == frame.features.size(),
          "InsertKeyframe: map_points is not parallel to features");
  const int id = static_cast<int>(map.keyframes.size());
  Keyframe keyframe;
  keyframe.id = id;
  keyframe.frame_index = frame.index;
  keyframe.timestamp_s = frame.timestamp_s;
  keyframe.T_cw = frame.T_cw;
  keyframe.readout = frame.readout;
  keyframe.features = frame.features;
  keyframe.map_points.assign(frame.features.size(), kNone);
  map.keyframes.push_back(std::move(keyframe));

  // What tracking matched is observed, what it did not match makes new points.
  for (int f = 0; f < static_cast<int>(frame.features.size()); ++f) {
    const int point = CurrentPoint(map, frame.map_points[Index(f)]);
    if (point == kNone) continue;
    AddObservation(map, point, id, f);
    UpdatePoint(map, point, scale);
  }
  AddPointsFromDepth(map, id, camera, scale, config);
  UpdateCovisibility(map, id, config);
  frame.map_points = map.keyframes[Index(id)].map_points;
  return id;
}

void UpdateCovisibility(Map& map, int keyframe, const KeyframeConfig& config) {
  // Points shared with each other keyframe.
  std::map<int, int> shared;
  for (const int point : map.keyframes[Index(keyframe)].map_points) {
    if (point == kNone) continue;
    for (const auto& [other, feature] : map.points[Index(point)].observations) {
      if (other != keyframe) ++shared[other];
    }
  }
  // Where none shares enough, the best one still ties the keyframe to the map.
  const auto best =
      std::max_element(shared.begin(), shared.end(),
                       [](const auto& a, const auto& b) { return a.second < b.second; });
  // The old relation goes, from both sides, and the new one is noted in both.
  for (const auto& [other, count] : map.keyframes[Index(keyframe)].covisible) {
    map.keyframes[Index(other)].covisible.erase(keyframe);
  }
  map.keyframes[Index(keyframe)].covisible.clear();
  for (const auto& [other, count] : shared) {
    if (count < config.min_shared_points && other != best->first) continue;
    map.keyframes[Index(keyframe)].covisible[other] = count;
    map.keyframes[Index(other)].covisible[keyframe] = count;
  }
}

int CullKeyframes(Map& map, int keyframe, const Camera& camera, const FeatureScale& scale,
                  const KeyframeConfig& config) {
  const double close_m = scale.CloseDepth_m(camera.fx);
  std::vector<int> neighbours;
  for (const auto& [other, shared] : map.keyframes[Index(keyframe)].covisible) {
    neighbours.push_back(other);
  }
  int culled = 0;
  for (const int id : neighbours) {
    if (id == 0 || id + 1 >= keyframe) continue;  // the first, the newest, the one before
    if (!IsRedundant(map, map.keyframes[Index(id)], close_m, config)) continue;
    CullKeyframe(map, id);
    ++culled;
  }
  return culled;
}

}  // namespace slam
