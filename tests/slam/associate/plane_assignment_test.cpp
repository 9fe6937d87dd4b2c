#include "slam/associate/plane_assignment.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace slam {
namespace {

using ::testing::ElementsAre;

constexpr int kNothing = PlaneAssignment::kNothing, kAmbiguous = PlaneAssignment::kAmbiguous;
constexpr double kMargin = 4.0;

/// Planes of a frame of which each is a surface of its own.
PlaneRelations Apart(int frame_planes) {
  const auto n = static_cast<std::size_t>(frame_planes);
  return {PieceTable(n, std::vector<Pieces>(n, Pieces::kOfTwo)), {}};
}

void Relate(PlaneRelations& relations, std::size_t f, std::size_t g, Pieces pieces) {
  relations.pieces[f][g] = relations.pieces[g][f] = pieces;
}

/// The same whatever the order of the pairs.
std::vector<int> Assigned(std::vector<AdmissiblePair> pairs, const PlaneRelations& relations) {
  const int frame_planes = static_cast<int>(relations.pieces.size());
  const std::vector<int> out = AssignPlanes(frame_planes, pairs, relations, kMargin).map_plane;
  std::reverse(pairs.begin(), pairs.end());
  EXPECT_EQ(AssignPlanes(frame_planes, pairs, relations, kMargin).map_plane, out);
  return out;
}

TEST(PlaneAssignment, GivesEachItsLikeliestAndNothingWhereThereIsNoPair) {
  EXPECT_THAT(Assigned({{0, 10, 1.0}, {0, 11, 9.0}, {1, 11, 2.0}, {1, 10, 9.0}}, Apart(3)),
              ElementsAre(10, 11, kNothing));
}

// Which landmark the first shows is open, so that the second's is, too, though the first fits far better.
TEST(PlaneAssignment, LeavesNoLandmarkToAWorseFitWhileABetterOneIsInDoubt) {
  EXPECT_THAT(Assigned({{0, 10, 0.0}, {0, 11, 0.5}, {1, 10, 2 * kMargin}}, Apart(2)),
              ElementsAre(kAmbiguous, kAmbiguous));
  // At home elsewhere the first leaves it.
  EXPECT_THAT(Assigned({{0, 10, 1.0}, {0, 11, -kMargin}, {1, 10, 2 * kMargin}}, Apart(2)),
              ElementsAre(11, 10));
}

TEST(PlaneAssignment, IsInDoubtBetweenTwoLandmarksThatFitAlike) {
  EXPECT_THAT(Assigned({{0, 10, 1.0}, {0, 11, 1.0 + kMargin - 0.1}}, Apart(1)),
              ElementsAre(kAmbiguous));
  EXPECT_THAT(Assigned({{0, 10, 1.0}, {0, 11, 1.0 + kMargin + 0.1}}, Apart(1)),
              ElementsAre(10));
  // One found twice is no doubt, and a candidate makes none.
  PlaneRelations twice = Apart(1);
  twice.duplicates = {{10, 11}};
  EXPECT_THAT(Assigned({{0, 11, 1.0}, {0, 10, 2.0}}, twice), ElementsAre(11));
  EXPECT_THAT(Assigned({{0, 10, 1.0}, {0, 11, 2.0, true}}, Apart(1)), ElementsAre(10));
}

TEST(PlaneAssignment, IsInDoubtWhichOfTwoPlanesIsTheLandmark) {
  EXPECT_THAT(Assigned({{0, 10, 1.0}, {1, 10, 2.0}}, Apart(2)),
              ElementsAre(kAmbiguous, kAmbiguous));
  EXPECT_THAT(Assigned({{0, 10, 1.0}, {1, 10, 1.0 + kMargin + 0.1}}, Apart(2)),
              ElementsAre(10, kNothing));
}

TEST(PlaneAssignment, LetsPiecesOfOneSurfaceShareTheirLandmark) {
  PlaneRelations relations = Apart(2);
  Relate(relations, 0, 1, Pieces::kOfOne);
  EXPECT_THAT(Assigned({{0, 10, 1.0}, {1, 10, 2.0}}, relations), ElementsAre(10, 10));
  // Where that is unsure, both must have been seen as it before.
  Relate(relations, 0, 1, Pieces::kUnsure);
  EXPECT_THAT(Assigned({{0, 10, 1.0, false, true}, {1, 10, 2.0, false, true}}, relations),
              ElementsAre(10, 10));
  EXPECT_THAT(Assigned({{0, 10, 1.0, false, true}, {1, 10, 2.0}}, relations),
              ElementsAre(kAmbiguous, kAmbiguous));
}

TEST(PlaneAssignment, LetsAPieceInOnlyIfItMayBeOneWithAllOfThem) {
  PlaneRelations relations = Apart(3);
  Relate(relations, 0, 1, Pieces::kOfOne);
  Relate(relations, 0, 2, Pieces::kOfOne);  // but there is a step between 1 and 2
  const std::vector<AdmissiblePair> pairs{{0, 10, 1.0}, {1, 10, 2.0}, {2, 10, 2.1 + kMargin}};
  EXPECT_THAT(Assigned(pairs, relations), ElementsAre(10, 10, kNothing));
  Relate(relations, 1, 2, Pieces::kOfOne);
  EXPECT_THAT(Assigned(pairs, relations), ElementsAre(10, 10, 10));
}

TEST(PlaneAssignment, DoesNotCountACompetitorThatIsAtHomeElsewhere) {
  EXPECT_THAT(Assigned({{0, 10, 5.0}, {1, 10, 6.0}, {1, 11, 1.0}}, Apart(2)),
              ElementsAre(10, 11));
  EXPECT_THAT(Assigned({{0, 10, 1.0}, {1, 10, 2.0}, {1, 11, -3.0}}, Apart(2)),
              ElementsAre(10, 11));
}

TEST(PlaneAssignment, IsNotInDoubtForALandmarkThatIsAnotherPlanes) {
  // Plane 1 fits 10 better than 11, but 10 clearly is plane 0, and nobody else wants 11.
  EXPECT_THAT(Assigned({{0, 10, 0.0}, {1, 10, kMargin + 0.5}, {1, 11, kMargin + 2}}, Apart(2)),
              ElementsAre(10, 11));
}

TEST(PlaneAssignment,
     APlaneThatMayNotHaveTheLandmarkDisputesItOnlyWithThoseThatFitNearlyAsWell) {
  // Planes 0 and 2 are pieces of one surface, plane 1 is another one that fits 10 in between.
  PlaneRelations relations = Apart(3);
  Relate(relations, 0, 2, Pieces::kOfOne);
  const auto third = [&](double cost) {
    return Assigned({{0, 10, 0.0}, {1, 10, kMargin + 1}, {2, 10, cost}}, relations);
  };
  EXPECT_THAT(third(2 * kMargin + 0.9), ElementsAre(10, kNothing, kAmbiguous));
  EXPECT_THAT(third(2 * kMargin + 1.1), ElementsAre(10, kNothing, 10));
}

TEST(PlaneAssignment, IsInDoubtBetweenTwoPlanesOfWhichOneHasLostABetterPlace) {
  // Plane 1 fits 10 clearly better than 11, but 10 is plane 0: it has as much claim on 11 as plane 2.
  EXPECT_THAT(Assigned({{0, 10, 0.0}, {1, 10, 4.5}, {1, 11, 9.0}, {2, 11, 8.0}}, Apart(3)),
              ElementsAre(10, kAmbiguous, kAmbiguous));
}

}  // namespace
}  // namespace slam
