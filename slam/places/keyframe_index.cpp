#include "slam/places/keyframe_index.h"

#include <algorithm>
#include <map>
#include <set>

#include "slam/model/map_queries.h"

namespace slam {

void KeyframeIndex::Forget(int keyframe) {
  WordBag& bag = bags_[static_cast<std::size_t>(keyframe)];
  for (const auto& [word, weight] : bag) {
    std::vector<int>& shown_by = keyframes_[static_cast<std::size_t>(word)];
    shown_by.erase(std::lower_bound(shown_by.begin(), shown_by.end(), keyframe));
  }
  WordBag().swap(bag);
}

void KeyframeIndex::Update(const Map& map) {
  for (std::size_t k = 0; k < bags_.size(); ++k) {
    if (map.keyframes[k].culled) Forget(static_cast<int>(k));
  }
  keyframes_.resize(static_cast<std::size_t>(vocabulary_->words()));
  for (std::size_t k = bags_.size(); k < map.keyframes.size(); ++k) {
    bags_.push_back(vocabulary_->Bag(map.keyframes[k].features));
    for (const auto& [word, weight] : bags_.back()) {
      keyframes_[static_cast<std::size_t>(word)].push_back(static_cast<int>(k));
    }
  }
}

std::vector<LikeKeyframe> KeyframeIndex::Like(const WordBag& bag, const Map& map,
                                              const std::vector<int>& except,
                                              const LikenessConfig& config) const {
  // How many words each keyframe shares with the image.
  std::map<int, int> common;  // keyframe -> words
  int most = 0;
  for (const auto& [word, weight] : bag) {
    if (static_cast<std::size_t>(word) >= keyframes_.size()) continue;
    for (const int k : keyframes_[static_cast<std::size_t>(word)]) {
      if (map.keyframes[static_cast<std::size_t>(k)].culled) continue;
      if (std::binary_search(except.begin(), except.end(), k)) continue;
      most = std::max(most, ++common[k]);
    }
  }
  // Only those that share many are compared in full.
  std::map<int, double> likeness;
  for (const auto& [k, words] : common) {
    if (words >= config.min_common_words * most) likeness[k] = Likeness(bag, Bag(k));
  }
  // A place is seen by a group of keyframes; the most alike of each stands for it.
  std::map<int, LikeKeyframe> places;  // by representative
  double best = 0;
  for (const auto& [k, own] : likeness) {
    LikeKeyframe place{k, own, own};
    for (const int near : BestCovisible(map, k, config.neighbours)) {
      const auto found = likeness.find(near);
      if (found == likeness.end()) continue;
      place.support += found->second;
      if (found->second > place.likeness) place = {near, found->second, place.support};
    }
    best = std::max(best, place.support);
    LikeKeyframe& kept = places.emplace(place.keyframe, place).first->second;
    kept.support = std::max(kept.support, place.support);
  }
  // The best supported places.
  std::vector<LikeKeyframe> out;
  for (const auto& [k, place] : places) {
    if (place.support >= config.min_support * best) out.push_back(place);
  }
  std::stable_sort(out.begin(), out.end(), [](const LikeKeyframe& a, const LikeKeyframe& b) {
    return a.support > b.support;
  });
  return out;
}

}  // namespace slam
