#include "slam/places/vocabulary.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/input_error.h"
#include "slam/base/random.h"
#include "slam/features/match_features.h"
#include "slam/places/train_vocabulary.h"
#include "tests/support/refusal.h"

namespace slam {
namespace {

Descriptor RandomBits(Random& random) {
  Descriptor bits{};
  for (std::uint8_t& byte : bits) byte = static_cast<std::uint8_t>(random.Below(256));
  return bits;
}

Descriptor Disturbed(Descriptor bits, int flips, Random& random) {
  for (int i = 0; i < flips; ++i) {
    const auto bit = static_cast<std::size_t>(random.Below(256));
    bits[bit / 8] = static_cast<std::uint8_t>(bits[bit / 8] ^ (1u << (bit % 8)));
  }
  return bits;
}

PointFeature FeatureWith(const Descriptor& descriptor) {
  PointFeature feature;
  feature.descriptor = descriptor;
  return feature;
}

/// Descriptors around these centres, all through the images.
std::vector<std::vector<Descriptor>> Around(const std::vector<Descriptor>& centres, int images,
                                            int each, int flips) {
  std::vector<std::vector<Descriptor>> out(static_cast<std::size_t>(images));
  Random random{4};
  for (auto& image : out) {
    for (int i = 0; i < each; ++i) {
      for (const Descriptor& centre : centres) {
        image.push_back(Disturbed(centre, flips, random));
      }
    }
  }
  return out;
}

std::vector<Descriptor> Centres(int count) {
  Random random{8};
  std::vector<Descriptor> centres;
  for (int i = 0; i < count; ++i) centres.push_back(RandomBits(random));
  return centres;
}

Vocabulary Small() {
  return TrainVocabulary(Around(Centres(40), 6, 3, 20), {.branching = 4, .depth = 3});
}

// Fails when centres are not majorities, or a descriptor goes down to another child.
TEST(Vocabulary, ClustersFarApartAreAWordEach) {
  const std::vector<Descriptor> centres = Centres(6);
  const Vocabulary words =
      TrainVocabulary(Around(centres, 5, 10, 12), {.branching = 6, .depth = 1});
  ASSERT_EQ(words.words(), 6);
  std::vector<bool> taken(6);
  Random random{21};
  for (const Descriptor& centre : centres) {
    const int word = words.Word(centre);
    EXPECT_FALSE(taken[static_cast<std::size_t>(word)]) << "two clusters in one word";
    taken[static_cast<std::size_t>(word)] = true;
    for (int i = 0; i < 50; ++i) EXPECT_EQ(words.Word(Disturbed(centre, 30, random)), word);
  }
}

TEST(Vocabulary, WordsThatAllImagesHaveSayNothing) {
  const std::vector<Descriptor> centres = Centres(3);
  std::vector<std::vector<Descriptor>> images = Around({centres[0], centres[1]}, 4, 5, 3);
  images[2].push_back(centres[2]);  // one image of four
  const Vocabulary words =
      TrainVocabulary(images, {.branching = 3, .depth = 1, .min_members = 2});
  ASSERT_EQ(words.words(), 3);
  EXPECT_TRUE(words.Bag({FeatureWith(centres[0]), FeatureWith(centres[1])}).empty());
  const WordBag rare = words.Bag({FeatureWith(centres[0]), FeatureWith(centres[2])});
  ASSERT_EQ(rare.size(), 1u);
  EXPECT_EQ(rare[0].first, words.Word(centres[2]));
  EXPECT_DOUBLE_EQ(rare[0].second, 1.0);
}

TEST(Vocabulary, AWordWeighsAsOftenAsItIsSeen) {
  std::vector<VocabularyNode> nodes(3);
  nodes[0].first_child = 1;
  nodes[0].children = 2;
  nodes[2].centre.fill(0xff);
  const Vocabulary words(nodes, {1.0f, 3.0f});
  const PointFeature print = FeatureWith(nodes[1].centre), other = FeatureWith(nodes[2].centre);
  // Five of the one weigh five, one of the other three.
  const WordBag bag = words.Bag({print, print, other, print, print, print});
  ASSERT_EQ(bag.size(), 2u);
  EXPECT_EQ(bag[0].first, 0);
  EXPECT_DOUBLE_EQ(bag[0].second, 5.0 / 8);
  EXPECT_DOUBLE_EQ(bag[1].second, 3.0 / 8);
  // A wall full of one print is not like a single copy of it beside other things.
  EXPECT_DOUBLE_EQ(Likeness(bag, words.Bag({print, other})), 1.0 / 4 + 3.0 / 8);
}

TEST(Vocabulary, IsTheSameFromTheSameDescriptors) {
  EXPECT_EQ(Small().Bytes(), Small().Bytes());
  const auto images = Around(Centres(40), 6, 3, 20);
  EXPECT_NE(TrainVocabulary(images, {.branching = 4, .depth = 3, .seed = 1}).Bytes(),
            Small().Bytes());
}

TEST(Vocabulary, ComesBackFromItsBytes) {
  const Vocabulary small = Small();
  const Vocabulary back = Vocabulary::Parse(small.Bytes(), "copy");
  EXPECT_EQ(back.Bytes(), small.Bytes());
  Random random{5};
  std::vector<PointFeature> features;
  for (int i = 0; i < 200; ++i) features.push_back(FeatureWith(RandomBits(random)));
  EXPECT_EQ(back.Bag(features), small.Bag(features));
}

// Fails when a damaged file is read as words: one changed or missing byte is refused.
TEST(Vocabulary, DamagedBytesAreRefusedByName) {
  const std::string good = Small().Bytes();
  for (std::size_t at = 0; at < good.size(); at += 1 + at / 16) {
    std::string bad = good;
    bad[at] = static_cast<char>(bad[at] ^ 0x10);
    EXPECT_THROW(Vocabulary::Parse(bad, "words.bin"), io::InputError) << "byte " << at;
    EXPECT_THROW(Vocabulary::Parse(good.substr(0, at), "words.bin"), io::InputError);
  }
  EXPECT_THAT(
      test_support::RefusalOf([] { Vocabulary::Parse("PNG", "words.bin"); }),
      testing::AllOf(testing::HasSubstr("words.bin"), testing::HasSubstr("pas vocabulary")));
}

TEST(Vocabulary, NodesThatAreNoTreeAreRefused) {
  std::vector<VocabularyNode> nodes(3);
  nodes[0].first_child = 1;
  nodes[0].children = 2;
  EXPECT_NO_THROW(Vocabulary(nodes, {1, 1}));
  EXPECT_THROW(Vocabulary(nodes, {1}), std::invalid_argument);
  EXPECT_THROW(Vocabulary(nodes, {1, NAN}), std::invalid_argument);
  nodes[0].children = 5;
  EXPECT_THROW(Vocabulary(nodes, {1, 1}), std::invalid_argument);
  nodes[0].children = 2;
  nodes[0].first_child = 0;  // its own child: a descent without end
  EXPECT_THROW(Vocabulary(nodes, {1, 1}), std::invalid_argument);
}

TEST(Likeness, IsOneOfTheSameZeroOfOthersAndSymmetric) {
  const WordBag a{{1, 0.5}, {4, 0.5}}, b{{4, 0.25}, {7, 0.75}}, c{{2, 1.0}};
  EXPECT_DOUBLE_EQ(Likeness(a, a), 1.0);
  EXPECT_DOUBLE_EQ(Likeness(a, c), 0.0);
  EXPECT_DOUBLE_EQ(Likeness(a, b), 0.25);
  EXPECT_DOUBLE_EQ(Likeness(b, a), 0.25);
  EXPECT_DOUBLE_EQ(Likeness(a, {}), 0.0);
}

TEST(ShippedVocabulary, HasThousandsOfWordsThatDiffer) {
  const Vocabulary& words = Vocabulary::Shipped();
  EXPECT_GE(words.words(), 5000);
  EXPECT_LT(words.Bytes().size(), 4u << 20);
  Random random{6};
  std::vector<bool> seen(static_cast<std::size_t>(words.words()));
  for (int i = 0; i < 20000; ++i) {
    seen[static_cast<std::size_t>(words.Word(RandomBits(random)))] = true;
  }
  EXPECT_GT(std::count(seen.begin(), seen.end(), true), words.words() / 4);
}

}  // namespace
}  // namespace slam
