#include "slam/localise/keyframe_decision.h"

#include <algorithm>

#include "slam/base/require.h"

namespace slam {
namespace {

constexpr int kMinTracked = 15;
constexpr double kFeaturesOfTheRule = 1000.0;

/// Points of a keyframe that others see as well; while there are no others, all of them.
int WellSeenPoints(const Map& map, int keyframe) {
  const auto alive = std::count_if(map.keyframes.begin(), map.keyframes.end(),
                                   [](const Keyframe& k) { return !k.culled; });
  const std::size_t min_views = alive <= 2 ? 1 : alive == 3 ? 2 : 3;
  int count = 0;
  for (const int point : map.keyframes.at(static_cast<std::size_t>(keyframe)).map_points) {
    if (point == kNone) continue;
    if (map.points[static_cast<std::size_t>(point)].observations.size() >= min_views) ++count;
  }
  return count;
}

}  // namespace

KeyframeEvidence DecideKeyframe(const Frame& frame, const Map& map, int reference,
                                int frames_since_last, const Camera& camera,
                                const KeyframeConfig& keyframes,
                                const KeyframeDecisionConfig& config) {
  Require(frame.map_points.size() == frame.features.size(),
          "DecideKeyframe: map_points is not parallel to features");
  KeyframeEvidence evidence;
  const double close_m = CloseDepth(camera, keyframes);
  for (std::size_t f = 0; f < frame.features.size(); ++f) {
    const bool tracked = frame.map_points[f] != kNone;
    const double z = frame.features[f].depth_m;
    if (tracked) ++evidence.tracked;
    if (z > 0 && z < close_m) ++(tracked ? evidence.close_tracked : evidence.close_untracked);
  }
  evidence.reference_points = WellSeenPoints(map, reference);
  if (frames_since_last < config.min_frames_between || evidence.tracked <= kMinTracked) {
    return evidence;
  }
  const double ratio =
      map.keyframes.size() < 2 ? config.first_reference_ratio : config.min_reference_ratio;
  const double share =
      std::min(1.0, static_cast<double>(frame.features.size()) / kFeaturesOfTheRule);
  const bool sees_less = evidence.tracked < ratio * evidence.reference_points;
  const bool close_to_be_had = evidence.close_tracked < share * config.min_close_tracked &&
                               evidence.close_untracked > share * config.min_close_untracked;
  evidence.wanted = sees_less || close_to_be_had;
  return evidence;
}

}  // namespace slam
