#include "slam/associate/recheck.h"

#include <gtest/gtest.h>

#include "tests/support/map_surfaces.h"

namespace slam {
namespace {

/// A camera that looks down on a desk, and on what lies `steps_m` over it; each is matched with the
/// landmark at its height.
struct DeskInSight {
  Frame frame;
  Map map;
  AssociationConfig config;

  explicit DeskInSight(const std::vector<double>& steps_m) {
    for (const double step_m : steps_m) {
      FramePlane plane;
      plane.pi_c = {-Eigen::Vector3d::UnitZ(), 1.0 - step_m};
      plane.centroid_c = {0.1, 0.0, 1.0 - step_m};
      plane.offset_sigma_m = 0.0005, plane.angle_sigma_rad = 0.002;
      MapPlane landmark;
      landmark.pi_w = plane.pi_c;
      landmark.centroid_w = plane.centroid_c;
      AddLandmark(map, landmark);
      frame.plane_matches.push_back({PlaneDecision::kMatched,
                                     static_cast<int>(frame.planes.size()),
                                     MatchReason::kOverlap});
      frame.planes.push_back(plane);
    }
    frame.pose_covariance = 1e-6 * Matrix6d::Identity();
  }
  int TakeBack() { return TakeBackContradicted(frame, map, config); }
};

TEST(Recheck, TakesBackTheMatchThatThePoseContradictsAndNoOther) {
  DeskInSight desk({0.0, 0.03, 0.06});
  EXPECT_EQ(desk.TakeBack(), 0);
  desk.frame.plane_matches[1].map_plane = 0;
  EXPECT_EQ(desk.TakeBack(), 1);
  EXPECT_EQ(desk.frame.plane_matches[0].map_plane, 0);
  EXPECT_EQ(desk.frame.plane_matches[1].decision, PlaneDecision::kUnmatched);
  EXPECT_EQ(desk.frame.plane_matches[1].map_plane, kNone);
  EXPECT_EQ(desk.frame.plane_matches[1].reason, MatchReason::kAmbiguous);
  EXPECT_EQ(desk.frame.plane_matches[2].map_plane, 2);
}

TEST(Recheck, LeavesWhatThePoseOrTheBendMayExplain) {
  for (const bool by_bend : {false, true}) {
    DeskInSight desk({0.0, 0.03});
    desk.frame.plane_matches[1].map_plane = 0;
    if (by_bend) {
      desk.frame.bend_ratio = 0.02;  // two centimetres at a metre
    } else {
      desk.frame.pose_covariance = 4e-4 * Matrix6d::Identity();
    }
    EXPECT_EQ(desk.TakeBack(), 0) << by_bend;
  }
}

TEST(Recheck, AsksForMatchesWithLandmarksAlone) {
  DeskInSight desk({0.0, 0.03});
  desk.frame.plane_matches[1] = {PlaneDecision::kTrial, 0, MatchReason::kNothing};
  EXPECT_EQ(desk.TakeBack(), 0);
  desk.frame.plane_matches[1].decision = PlaneDecision::kMatched;
  desk.config.recheck = false;
  EXPECT_EQ(desk.TakeBack(), 0);
  desk.config.recheck = true;
  desk.config.rule = AssociationRule::kParameters;
  EXPECT_EQ(desk.TakeBack(), 0) << "the paper's rule knows of no uncertainty";
}

}  // namespace
}  // namespace slam
