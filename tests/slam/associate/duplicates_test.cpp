// Two surfaces of the map in one place: one that was found twice, or two of two objects?
#include <gtest/gtest.h>

#include <string>

#include "slam/associate/associate_planes.h"
#include "slam/mapping/plane_update.h"
#include "tests/support/map_surfaces.h"
#include "tests/support/plane_world.h"

namespace slam {
namespace {

/// A view of a board of a class (or none), and a map that holds the board twice.
struct HeldTwice {
  const Camera camera = SmallCamera();
  Frame frame;
  Map map;
  MapPlane board;

  explicit HeldTwice(const std::string& seen_class) {
    PlaneWorld world;
    world.Add({0, 0, 0}, {0.2, 0, 0}, {0, 0.15, 0}, seen_class);
    SeenWorld seen = See(world, LookAt({0, -0.8, 0.7}, {0, 0, 0}), camera, {}, Random{1});
    PlaneMapConfig one_view;
    one_view.trial_pixels = 480, one_view.trial_frames = 1;
    Map single;
    UpdatePlanes(seen.frame, single, camera, {}, one_view);
    board = *single.planes.begin();
    frame = std::move(seen.frame);
  }
  /// @returns the id of the board, as often seen of this class
  int Hold(const std::string& class_name, LandmarkStatus status) {
    MapPlane held = board;
    held.class_name = class_name;
    held.class_belief = {{class_name, 6.0}};
    held.status = status;
    return map.planes.Add(held).id;
  }
  PlaneMatch Decision() const { return AssociatePlanes(frame, map, camera, {}).matches.at(0); }
};

TEST(TwoLandmarksOfOnePlace, LeaveInDoubtWhichIsSeenUnlessTheyCanBeOneFoundTwice) {
  for (const bool of_one_class : {true, false}) {
    SCOPED_TRACE(of_one_class);
    HeldTwice held("");
    held.Hold("book", LandmarkStatus::kLandmark);
    held.Hold(of_one_class ? "book" : "laptop", LandmarkStatus::kLandmark);
    const PlaneMatch match = held.Decision();
    EXPECT_EQ(match.decision,
              of_one_class ? PlaneDecision::kMatched : PlaneDecision::kUnmatched);
    if (!of_one_class) {
      EXPECT_EQ(match.reason, MatchReason::kAmbiguous);
    }
  }
}

TEST(ACandidateInALandmarksPlace, TakesWhatShowsItsClassAndNotTheLandmarks) {
  HeldTwice held("book");
  held.Hold("laptop", LandmarkStatus::kLandmark);
  const int book = held.Hold("book", LandmarkStatus::kCandidate);
  const PlaneMatch match = held.Decision();
  EXPECT_EQ(match.decision, PlaneDecision::kTrial);
  EXPECT_EQ(match.map_plane, book);
}

TEST(ACandidateInALandmarksPlace, TakesNothingWhereBothAreOfOneClass) {
  HeldTwice held("book");
  const int landmark = held.Hold("book", LandmarkStatus::kLandmark);
  held.Hold("book", LandmarkStatus::kCandidate);
  const PlaneMatch match = held.Decision();
  EXPECT_EQ(match.decision, PlaneDecision::kMatched);
  EXPECT_EQ(match.map_plane, landmark);
}

}  // namespace
}  // namespace slam
