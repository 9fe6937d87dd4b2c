#include "slam/tracking/map_covariance.h"

#include <algorithm>
#include <vector>

#include "slam/base/index.h"
#include "slam/mapping/keyframe_planes.h"
#include "slam/model/map_queries.h"

namespace slam {

int KeyframeByPlanes(const Frame& frame, const Map& map) {
  std::vector<const MapPlane*> shown;
  for (const PlaneMatch& match : frame.plane_matches) {
    if (match.ShowsLandmark())
      shown.push_back(&map.planes.At(CurrentPlane(map, match.map_plane)));
  }
  int best = kNone;
  std::ptrdiff_t most = 0;
  for (const Keyframe& keyframe : map.keyframes) {
    if (keyframe.culled) continue;
    const auto shared = std::count_if(
        keyframe.planes.begin(), keyframe.planes.end(), [&](const KeyframePlane& plane) {
          const MapPlane* landmark = LandmarkOf(map, plane);
          return landmark != nullptr &&
                 std::find(shown.begin(), shown.end(), landmark) != shown.end();
        });
    if (shared > most) best = keyframe.id, most = shared;
  }
  return best;
}

Matrix6d MapCovarianceAt(const Pose& T_cw, const Map& map, int keyframe) {
  const Matrix6d carry = Adjoint(T_cw * Inverse(KeyframePose(map, keyframe)));
  return carry * map.keyframes[Index(keyframe)].covariance * carry.transpose();
}

}  // namespace slam
