#include "slam/features/match_features.h"

#include <gmock/gmock.h>

#include <bitset>
#include <cmath>
#include <limits>

#include "slam/base/index.h"
#include "slam/base/random.h"
#include "tests/support/point_world.h"

namespace slam {
namespace {

PointFeature FeatureAt(double u, double v, const Descriptor& descriptor, int octave = 0,
                       float angle_deg = 0) {
  PointFeature feature;
  feature.u_px = {u, v};
  feature.descriptor = descriptor;
  feature.octave = octave;
  feature.angle_deg = angle_deg;
  return feature;
}

Descriptor Flip(Descriptor descriptor, int bits) {
  for (int i = 0; i < bits; ++i) {
    descriptor[static_cast<std::size_t>(i / 8)] ^= static_cast<std::uint8_t>(1 << (i % 8));
  }
  return descriptor;
}

PointQuery QueryAt(double u, double v, const Descriptor& descriptor, int point) {
  PointQuery query;
  query.point = point;
  query.u_px = {u, v};
  query.descriptor = descriptor;
  return query;
}

TEST(DescriptorDistance, CountsTheDifferingBits) {
  Random random{1};
  const Descriptor zeros{}, some = AnyDescriptor(random);
  Descriptor ones;
  ones.fill(255);
  EXPECT_EQ(DescriptorDistance(zeros, zeros), 0);
  EXPECT_EQ(DescriptorDistance(zeros, ones), 256);
  for (const int bits : {1, 8, 100, 255}) {
    EXPECT_EQ(DescriptorDistance(some, Flip(some, bits)), bits);
  }
}

/// Whether the first of the features has a double within 30 pixels that differs by 50 bits at most.
bool FirstHasDouble(const std::vector<PointFeature>& features) {
  return HasDouble(features[0], features, FeatureGrid(features, Camera{}), FeatureScale{}, 30,
                   50);
}

TEST(HasDouble, IsAnotherCornerNearbyThatLooksAlike) {
  Random random{7};
  const Descriptor d = AnyDescriptor(random);
  const auto first_and = [&](const PointFeature& other) {
    return FirstHasDouble({FeatureAt(200, 200, d), other});
  };
  EXPECT_TRUE(first_and(FeatureAt(206, 200, d)));
  EXPECT_TRUE(first_and(FeatureAt(200, 171, d)));
  EXPECT_FALSE(first_and(FeatureAt(200, 169, d))) << "out of reach";
  EXPECT_FALSE(first_and(FeatureAt(202, 198, d))) << "the same corner";
  EXPECT_TRUE(first_and(FeatureAt(206, 200, Flip(d, 50))));
  EXPECT_FALSE(first_and(FeatureAt(206, 200, Flip(d, 51)))) << "looks otherwise";
  EXPECT_TRUE(first_and(FeatureAt(206, 200, d, 1)));
  EXPECT_FALSE(first_and(FeatureAt(206, 200, d, 2))) << "of another size";
  EXPECT_FALSE(FirstHasDouble({FeatureAt(200, 200, d)})) << "itself";
}

TEST(HasDouble, ReachesFartherWhereCornersAreLarge) {
  Random random{8};
  const Descriptor d = AnyDescriptor(random);
  const double scale = FeatureScale{}.Scale(4);
  const auto at_octave_4 = [&](double away_px) {
    return FirstHasDouble({FeatureAt(300, 200, d, 4), FeatureAt(300 + away_px, 200, d, 3)});
  };
  EXPECT_FALSE(at_octave_4(2.9 * scale));
  EXPECT_TRUE(at_octave_4(3.1 * scale));
  EXPECT_TRUE(at_octave_4(29.9 * scale));
  EXPECT_FALSE(at_octave_4(30.1 * scale));
}

TEST(MatchQueries, TakesTheNearestDescriptorNearThePrediction) {
  Random random{2};
  const Descriptor d = AnyDescriptor(random), other = AnyDescriptor(random);
  const std::vector<PointFeature> features{FeatureAt(100, 100, other), FeatureAt(103, 98, d),
                                           FeatureAt(150, 100, d)};
  const FeatureGrid grid(features, Camera{});
  EXPECT_THAT(MatchQueries({QueryAt(101, 100, d, 5)}, features, grid, {}, {}),
              testing::ElementsAre(kNone, 0, kNone));
}

TEST(MatchQueries, GivesAFeatureToTheBetterOfTwoQueries) {
  Random random{3};
  const Descriptor d = AnyDescriptor(random);
  const std::vector<PointFeature> features{FeatureAt(100, 100, d)};
  const FeatureGrid grid(features, Camera{});
  const std::vector<PointQuery> queries{QueryAt(100, 100, Flip(d, 20), 1),
                                        QueryAt(100, 100, Flip(d, 5), 2),
                                        QueryAt(100, 100, Flip(d, 5), 3)};
  EXPECT_THAT(MatchQueries(queries, features, grid, {}, {}), testing::ElementsAre(1));
}

TEST(MatchQueries, RefusesADescriptorTooFarAwayAndATakenFeature) {
  Random random{4};
  const Descriptor d = AnyDescriptor(random);
  const std::vector<PointFeature> features{FeatureAt(100, 100, d)};
  const FeatureGrid grid(features, Camera{});
  EXPECT_THAT(MatchQueries({QueryAt(100, 100, Flip(d, 101), 1)}, features, grid, {}, {}),
              testing::ElementsAre(kNone));
  EXPECT_THAT(MatchQueries({QueryAt(100, 100, d, 1)}, features, grid, {true}, {}),
              testing::ElementsAre(kNone));
}

TEST(MatchQueries, RefusesAnAmbiguousPairOfFeatures) {
  Random random{5};
  const Descriptor d = AnyDescriptor(random);
  const std::vector<PointFeature> features{FeatureAt(100, 100, Flip(d, 30)),
                                           FeatureAt(102, 100, Flip(d, 31))};
  const FeatureGrid grid(features, Camera{});
  EXPECT_THAT(MatchQueries({QueryAt(101, 100, d, 1)}, features, grid, {}, {}),
              testing::ElementsAre(kNone, kNone));
}

TEST(MatchQueries, RefusesAnAmbiguousPairWhateverItsOrderButOnlyInOneOctave) {
  Random random{5};
  const Descriptor d = AnyDescriptor(random);
  const std::vector<PointFeature> worse_first{FeatureAt(100, 100, Flip(d, 31)),
                                              FeatureAt(102, 100, Flip(d, 30))};
  EXPECT_THAT(MatchQueries({QueryAt(101, 100, d, 1)}, worse_first,
                           FeatureGrid(worse_first, Camera{}), {}, {}),
              testing::ElementsAre(kNone, kNone));
  const std::vector<PointFeature> two_octaves{FeatureAt(100, 100, Flip(d, 31), 1),
                                              FeatureAt(102, 100, Flip(d, 30))};
  EXPECT_THAT(MatchQueries({QueryAt(101, 100, d, 1)}, two_octaves,
                           FeatureGrid(two_octaves, Camera{}), {}, {}),
              testing::ElementsAre(kNone, 0));
}

/// Features that look like the queries or features before them, turned by so much; one is turned
/// elsewhere.
struct Turned {
  static constexpr int kCount = 20, kOdd = 7;
  std::vector<PointFeature> before, now;
  std::vector<PointQuery> queries;

  Turned() {
    Random random{11};
    for (int i = 0; i < kCount; ++i) {
      const Descriptor d = AnyDescriptor(random);
      const double u = 30.0 + 25 * i, angle = 360 * random.Uniform();
      const double turned = angle + (i == kOdd ? 200 : 40);
      before.push_back(FeatureAt(u, 90, d, 0, static_cast<float>(angle)));
      now.push_back(FeatureAt(u, 90, Flip(d, 5), 0,
                              static_cast<float>(turned - 360 * std::floor(turned / 360))));
      queries.push_back(QueryAt(u, 90, d, i));
      queries.back().angle_deg = before.back().angle_deg;
    }
  }
};

TEST(MatchQueries, DropsTheOneThatTurnsOtherwiseThanTheImageUnlessItsTurnIsNotKnown) {
  Turned turned;
  const FeatureGrid grid(turned.now, Camera{});
  for (const bool known : {true, false}) {
    if (!known) turned.queries[Turned::kOdd].angle_deg = -1.0f;
    const auto matches = MatchQueries(turned.queries, turned.now, grid, {}, {});
    for (int i = 0; i < Turned::kCount; ++i)
      EXPECT_EQ(matches[Index(i)], i == Turned::kOdd && known ? kNone : i) << known;
  }
}

TEST(MatchDescriptors, DropsTheOneThatTurnsOtherwiseThanTheImage) {
  const Turned turned;
  const auto pairs = MatchDescriptors(turned.before, turned.now, {}, {});
  EXPECT_EQ(pairs.size(), static_cast<std::size_t>(Turned::kCount - 1));
  for (const FeaturePair& pair : pairs) {
    EXPECT_EQ(pair.first, pair.second);
    EXPECT_NE(pair.first, Turned::kOdd);
  }
}

TEST(MatchQueries, IsNotUpsetByAPositionThatIsNotFinite) {
  const std::vector<PointFeature> features{FeatureAt(100, 100, {})};
  const FeatureGrid grid(features, Camera{});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(MatchQueries({QueryAt(nan, 100, {}, 1)}, features, grid, {}, {}),
              testing::ElementsAre(kNone));
}

TEST(MatchDescriptors, PairsEachFeatureWithItsMutualNearest) {
  Random random{7};
  std::vector<PointFeature> first, second;
  for (int i = 0; i < 40; ++i) {
    const Descriptor d = AnyDescriptor(random);
    first.push_back(FeatureAt(i, 0, d));
    second.insert(second.begin(), FeatureAt(0, i, Flip(d, 10)));
  }
  const auto pairs = MatchDescriptors(first, second, {}, {50, 0.8});
  ASSERT_EQ(pairs.size(), 40u);
  for (const FeaturePair& pair : pairs) EXPECT_EQ(pair.second, 39 - pair.first);
}

TEST(MatchDescriptors, GivesAFeatureToTheOneOfTwoThatItIsNearestTo) {
  Random random{9};
  const Descriptor d = AnyDescriptor(random);
  const std::vector<PointFeature> far_first{FeatureAt(0, 0, Flip(d, 20)),
                                            FeatureAt(9, 0, Flip(d, 5))};
  const std::vector<PointFeature> one{FeatureAt(0, 9, d)};
  const auto pairs = MatchDescriptors(far_first, one, {}, {50, 0.8});
  ASSERT_EQ(pairs.size(), 1u);
  EXPECT_EQ(pairs[0].first, 1);
  EXPECT_EQ(pairs[0].second, 0);
}

TEST(MatchDescriptors, LeavesOutThoseThatTakeNoPart) {
  Random random{8};
  const Descriptor d = AnyDescriptor(random), e = AnyDescriptor(random);
  const std::vector<PointFeature> features{FeatureAt(0, 0, d), FeatureAt(5, 5, e)};
  const auto pairs = MatchDescriptors(features, features, {false, true}, {50, 0.8});
  ASSERT_EQ(pairs.size(), 1u);
  EXPECT_EQ(pairs[0].first, 1);
  EXPECT_EQ(pairs[0].second, 1);
}

TEST(ConsistentTurns, KnowAFullTurnForNone) {
  // Around none from both sides, and three smaller turns of which one falls out.
  std::vector<double> turns_deg;
  for (int i = 0; i < 4; ++i) {
    for (const double turn : {358.0, 2.0, -3.0}) turns_deg.push_back(turn);
  }
  for (const double turn : {90.0, 90.0, 150.0, 150.0}) turns_deg.push_back(turn);
  turns_deg.push_back(210.0);
  std::vector<bool> expected(turns_deg.size(), true);
  expected.back() = false;
  EXPECT_EQ(ConsistentTurns(turns_deg), expected);
}

TEST(ConsistentTurns, KeepsTheMainTurnAndDropsTheOthers) {
  std::vector<double> turns_deg(40, 30.0);
  turns_deg.push_back(200.0);
  turns_deg.push_back(std::numeric_limits<double>::quiet_NaN());
  turns_deg.push_back(30.0 - 360.0);
  const auto kept = ConsistentTurns(turns_deg);
  EXPECT_TRUE(kept[0]);
  EXPECT_FALSE(kept[40]);
  EXPECT_TRUE(kept[41]);
  EXPECT_TRUE(kept[42]);
}

}  // namespace
}  // namespace slam
