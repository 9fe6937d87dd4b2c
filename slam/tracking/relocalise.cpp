#include "slam/tracking/relocalise.h"

#include <utility>

#include "slam/base/index.h"

namespace slam {
namespace {

/// The newest, because a camera that is lost for a moment is near it, and those alike.
std::vector<int> Candidates(const Frame& frame, const Map& map, const KeyframeIndex& index,
                            const PlaceSearchConfig& config) {
  std::vector<int> candidates;
  for (auto k = map.keyframes.rbegin(); k != map.keyframes.rend(); ++k) {
    if (k->culled) continue;
    candidates.push_back(k->id);
    break;
  }
  const WordBag bag = index.vocabulary().Bag(frame.features);
  for (const LikeKeyframe& like : index.Like(bag, map, {}, config.likeness)) {
    if (candidates.size() >= Index(config.max_keyframes)) break;
    if (like.keyframe != candidates.front()) candidates.push_back(like.keyframe);
  }
  return candidates;
}

}  // namespace

std::optional<PlacePose> Relocalise(const Frame& frame, const Map& map,
                                    const KeyframeIndex& index, const Camera& camera,
                                    const FeatureScale& scale,
                                    const PointSearchConfig& search) {
  // Each candidate gives a pose, or none.
  const PlaceSearchConfig& config = search.place;
  std::vector<PlacePose> found;
  for (const int id : Candidates(frame, map, index, config)) {
    auto one = FindPose(map.keyframes[Index(id)], frame, map, camera, scale, search);
    if (one) found.push_back(std::move(*one));
  }
  const PlacePose* best = ClearlyBest(found, config);
  return best != nullptr ? std::optional(*best) : std::nullopt;
}

}  // namespace slam
