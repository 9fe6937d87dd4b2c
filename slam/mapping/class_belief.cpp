#include "slam/mapping/class_belief.h"

#include <algorithm>

#include "slam/associate/class_likelihood.h"

namespace slam {

void UpdateClassBelief(MapPlane& map_plane, const std::string& class_name, double score) {
  constexpr double kMinScore = 0.1;  // a detection that was reported is evidence of something
  map_plane.class_belief[class_name] +=
      class_name.empty() ? 1.0 : std::clamp(score, kMinScore, 1.0);
  map_plane.class_name = BelievedClass(map_plane.class_belief);
}

}  // namespace slam
