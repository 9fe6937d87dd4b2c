#pragma once

#include <vector>

#include "slam/model/map.h"
#include "slam/places/vocabulary.h"

namespace slam {

/// A keyframe that looks like an image.
struct LikeKeyframe {
  int keyframe = kNone;
  double likeness = 0.0;  ///< see Likeness
  double support = 0.0;  ///< the same, summed over it and the keyframes that share most with it
};

/// Bounds of a question by words; keys: see VisitFields(PlaceSearchConfig).
struct LikenessConfig {
  double min_common_words = 0.8;  // ORB-SLAM2
  double min_support = 0.6;       // ORB-SLAM2: 0.75
  int neighbours = 10;            // ORB-SLAM2
};

/// Keyframes by the words that they show.
class KeyframeIndex {
 public:
  /// @param vocabulary  must outlive the index
  explicit KeyframeIndex(const Vocabulary& vocabulary) : vocabulary_(&vocabulary) {}

  /// Takes in the keyframes that came to the map since and forgets those that were culled;
  /// those of another map must not follow.
  void Update(const Map& map);

  /// Keyframes that look like the image, best supported first (the older one at a tie), one of
  /// each group that sees the same place. Culled keyframes and those in `except` (ascending)
  /// do not take part. Source: the candidates of Mur-Artal and Tardos 2014.
  std::vector<LikeKeyframe> Like(const WordBag& bag, const Map& map,
                                 const std::vector<int>& except,
                                 const LikenessConfig& config) const;

  const Vocabulary& vocabulary() const { return *vocabulary_; }
  /// @param keyframe  one that Update has taken in
  const WordBag& Bag(int keyframe) const { return bags_[static_cast<std::size_t>(keyframe)]; }

 private:
  void Forget(int keyframe);

  const Vocabulary* vocabulary_;
  std::vector<WordBag> bags_;                ///< by keyframe
  std::vector<std::vector<int>> keyframes_;  ///< by word: those that show it, ascending
};

}  // namespace slam
