#include "slam/tracking/last_frame.h"

#include <algorithm>

#include "slam/base/index.h"
#include "slam/geometry/pixel_projection.h"
#include "slam/model/map_queries.h"

namespace slam {

Pose LastPose(const LastFrame& last, const Map& map) {
  return last.T_cr * KeyframePose(map, last.reference);
}

std::vector<SeenPoint> SeenPoints(const LastFrame& last, const Map& map, const Camera& camera,
                                  double close_m, int max_temporary) {
  // Features with a map point; the others wait when their depth is near enough.
  std::vector<SeenPoint> seen;
  std::vector<int> unmatched;
  for (int f = 0; f < static_cast<int>(last.features.size()); ++f) {
    const int id = CurrentPoint(map, last.map_points[Index(f)]);
    if (id != kNone) {
      seen.push_back({id, f, map.points[Index(id)].p_w});
    } else if (last.features[Index(f)].depth_m > 0 &&
               last.features[Index(f)].depth_m <= close_m) {
      unmatched.push_back(f);
    }
  }
  // The nearest of these become points for one frame, placed by their depth.
  std::stable_sort(unmatched.begin(), unmatched.end(), [&](int a, int b) {
    return last.features[Index(a)].depth_m < last.features[Index(b)].depth_m;
  });
  if (unmatched.size() > Index(max_temporary)) unmatched.resize(Index(max_temporary));
  const Pose T_wl = Inverse(LastPose(last, map));
  for (const int f : unmatched) {
    const PointFeature& feature = last.features[Index(f)];
    seen.push_back({kNone, f, T_wl * camera.Backproject(feature.u_px, feature.depth_m)});
  }
  return seen;
}

std::vector<PointQuery> QueriesOf(const std::vector<SeenPoint>& seen, const LastFrame& last,
                                  const Pose& T_cw, const Camera& camera,
                                  const FeatureScale& scale, double radius_px) {
  std::vector<PointQuery> queries;
  for (int i = 0; i < static_cast<int>(seen.size()); ++i) {
    const Eigen::Vector3d p_c = T_cw * seen[Index(i)].p_w;
    if (RecordedPixel(camera, p_c).x() < 0) continue;
    const PointFeature& feature = last.features[Index(seen[Index(i)].feature)];
    PointQuery query;
    query.point = i;
    query.u_px = camera.Project(p_c);
    query.radius_px = radius_px * scale.Scale(feature.octave);
    query.min_octave = feature.octave - 1;
    query.max_octave = feature.octave + 1;
    query.descriptor = feature.descriptor;
    query.angle_deg = feature.angle_deg;
    queries.push_back(query);
  }
  return queries;
}

}  // namespace slam
