#include "slam/places/keyframe_index.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "slam/base/random.h"
#include "slam/places/train_vocabulary.h"

namespace slam {
namespace {

constexpr int kPlaces = 6, kViews = 4, kFeatures = 150;

/// What there is to see at a place: descriptors that no other place has.
std::vector<Descriptor> ThingsAt(int place) {
  Random random{77, static_cast<std::uint64_t>(place)};
  std::vector<Descriptor> things(kFeatures);
  for (Descriptor& bits : things) {
    for (std::uint8_t& byte : bits) byte = static_cast<std::uint8_t>(random.Below(256));
  }
  return things;
}

/// A noisy image of a place: some things are missing, bits have flipped, others come in.
std::vector<PointFeature> ImageOf(int place, std::uint64_t view) {
  Random random{5, static_cast<std::uint64_t>(place), view};
  std::vector<PointFeature> features;
  for (Descriptor bits : ThingsAt(place)) {
    if (random.Below(4) == 0) continue;
    for (int i = 0; i < 12; ++i) {
      const auto bit = static_cast<std::size_t>(random.Below(256));
      bits[bit / 8] = static_cast<std::uint8_t>(bits[bit / 8] ^ (1u << (bit % 8)));
    }
    features.emplace_back().descriptor = bits;
  }
  for (int i = 0; i < kFeatures / 3; ++i) {
    for (std::uint8_t& byte : features.emplace_back().descriptor) {
      byte = static_cast<std::uint8_t>(random.Below(256));
    }
  }
  return features;
}

const Vocabulary& Words() {
  static const Vocabulary words = [] {
    std::vector<std::vector<Descriptor>> images;
    for (int place = 0; place < kPlaces; ++place) images.push_back(ThingsAt(place));
    return TrainVocabulary(images, {.branching = 8, .depth = 3, .min_members = 2});
  }();
  return words;
}

/// kViews keyframes of each place, covisible with one another; place p has kViews p and on.
Map MapOfPlaces() {
  Map map;
  for (int id = 0; id < kPlaces * kViews; ++id) {
    Keyframe keyframe;
    keyframe.id = id;
    keyframe.features = ImageOf(id / kViews, static_cast<std::uint64_t>(id));
    keyframe.map_points.assign(keyframe.features.size(), kNone);
    for (int other = id - id % kViews; other < id - id % kViews + kViews; ++other) {
      if (other != id) keyframe.covisible[other] = 50;
    }
    map.keyframes.push_back(keyframe);
  }
  return map;
}

// Fails when words or weights do not tell places apart, or a group is listed many times over.
TEST(KeyframeIndex, NamesThePlaceOnceAndFirst) {
  const Map map = MapOfPlaces();
  KeyframeIndex index(Words());
  index.Update(map);
  for (int place = 0; place < kPlaces; ++place) {
    const auto like = index.Like(Words().Bag(ImageOf(place, 999)), map, {}, {});
    ASSERT_FALSE(like.empty());
    EXPECT_EQ(like.front().keyframe / kViews, place);
    EXPECT_GT(like.front().support, like.front().likeness) << "its neighbours speak for it";
    EXPECT_EQ(
        std::count_if(like.begin(), like.end(),
                      [&](const LikeKeyframe& k) { return k.keyframe / kViews == place; }),
        1);
  }
}

TEST(KeyframeIndex, LeavesOutTheCulledAndTheExcepted) {
  Map map = MapOfPlaces();
  KeyframeIndex index(Words());
  index.Update(map);
  map.keyframes[8].culled = true;
  const auto like = index.Like(Words().Bag(ImageOf(2, 999)), map, {9, 10, 11}, {});
  ASSERT_FALSE(like.empty());
  for (const LikeKeyframe& k : like) EXPECT_NE(k.keyframe / kViews, 2);
}

TEST(KeyframeIndex, ForgetsACulledKeyframeOnceAndNoOther) {
  const WordBag bag = Words().Bag(ImageOf(2, 999));
  const auto seen_after = [&](int updates) {
    Map map = MapOfPlaces();
    KeyframeIndex index(Words());
    index.Update(map);
    map.keyframes[8].culled = true;
    for (int i = 0; i < updates; ++i) index.Update(map);
    EXPECT_TRUE(index.Bag(8).empty());
    EXPECT_FALSE(index.Bag(9).empty());
    return index.Like(bag, map, {}, {});
  };
  const auto once = seen_after(1), often = seen_after(4);
  ASSERT_FALSE(once.empty());
  EXPECT_EQ(once.front().keyframe / kViews, 2);
  ASSERT_EQ(once.size(), often.size());
  for (std::size_t i = 0; i < once.size(); ++i) {
    EXPECT_EQ(once[i].keyframe, often[i].keyframe);
    EXPECT_EQ(once[i].support, often[i].support);
  }
}

TEST(KeyframeIndex, GrowsWithTheMapAsIfMadeAtOnce) {
  const Map map = MapOfPlaces();
  KeyframeIndex whole(Words()), grown(Words());
  whole.Update(map);
  Map part;
  for (const Keyframe& keyframe : map.keyframes) {
    part.keyframes.push_back(keyframe);
    grown.Update(part);
  }
  const WordBag bag = Words().Bag(ImageOf(3, 999));
  const auto one = whole.Like(bag, map, {}, {}), other = grown.Like(bag, map, {}, {});
  ASSERT_EQ(one.size(), other.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].keyframe, other[i].keyframe);
    EXPECT_EQ(one[i].support, other[i].support);
  }
}

/// An image of which a third shows another place.
std::vector<PointFeature> ImageOfTwo(int place, int other) {
  std::vector<PointFeature> features = ImageOf(place, 999);
  const std::vector<PointFeature> more = ImageOf(other, 998);
  features.insert(features.end(), more.begin(), more.begin() + kFeatures / 3);
  return features;
}

TEST(KeyframeIndex, AsksKeyframesThatShareAsManyWordsAsSaid) {
  const Map map = MapOfPlaces();
  KeyframeIndex index(Words());
  index.Update(map);
  const WordBag bag = Words().Bag(ImageOfTwo(1, 4));
  const auto common = [&](int keyframe) {
    const WordBag& other = index.Bag(keyframe);
    return std::count_if(bag.begin(), bag.end(), [&](const auto& word) {
      return std::any_of(other.begin(), other.end(),
                         [&](const auto& own) { return own.first == word.first; });
    });
  };
  std::ptrdiff_t most = 0;
  for (const Keyframe& keyframe : map.keyframes) most = std::max(most, common(keyframe.id));
  for (const double least : {0.1, 0.3, 0.5, 0.7, 0.9}) {
    // Each for itself, however alike.
    const auto like = index.Like(bag, map, {}, {least, 0.0, 0});
    for (const Keyframe& keyframe : map.keyframes) {
      const bool named = std::any_of(like.begin(), like.end(), [&](const LikeKeyframe& k) {
        return k.keyframe == keyframe.id;
      });
      EXPECT_EQ(named,
                static_cast<double>(common(keyframe.id)) >= least * static_cast<double>(most))
          << keyframe.id << " " << least;
    }
  }
}

TEST(KeyframeIndex, NamesPlacesWithAsMuchSupportAsSaid) {
  const Map map = MapOfPlaces();
  KeyframeIndex index(Words());
  index.Update(map);
  const WordBag bag = Words().Bag(ImageOfTwo(1, 4));
  const auto all = index.Like(bag, map, {}, {0.0, 0.0, 10});
  ASSERT_GT(all.size(), 2u);
  const double best = all.front().support;
  for (const double share : {0.05, 0.2, 0.5, 0.9}) {
    const auto supported = std::count_if(all.begin(), all.end(), [&](const LikeKeyframe& k) {
      return k.support >= share * best;
    });
    EXPECT_EQ(static_cast<std::ptrdiff_t>(index.Like(bag, map, {}, {0.0, share, 10}).size()),
              supported)
        << share;
  }
}

// Each neighbour of keyframe 11 knows that one alone, and comes before it.
TEST(KeyframeIndex, CountsForAPlaceTheMostThatSpeakForIt) {
  Map map = MapOfPlaces();
  for (const std::size_t k : {8u, 9u, 10u}) map.keyframes[k].covisible = {{11, 50}};
  KeyframeIndex index(Words());
  index.Update(map);
  const WordBag bag = index.Bag(11);  // as like it as can be
  double sum = 0.0;
  for (const int k : {8, 9, 10, 11}) sum += Likeness(bag, index.Bag(k));
  const auto like = index.Like(bag, map, {}, {0.0, 0.0, 10});
  ASSERT_FALSE(like.empty());
  EXPECT_EQ(like.front().keyframe, 11);
  EXPECT_NEAR(like.front().support, sum, 1e-12);
}

TEST(KeyframeIndex, AnImageWithoutFeaturesIsLikeNothing) {
  const Map map = MapOfPlaces();
  KeyframeIndex index(Words());
  index.Update(map);
  EXPECT_TRUE(index.Like({}, map, {}, {}).empty());
  EXPECT_TRUE(KeyframeIndex(Words()).Like(Words().Bag(ImageOf(0, 1)), {}, {}, {}).empty());
}

}  // namespace
}  // namespace slam
