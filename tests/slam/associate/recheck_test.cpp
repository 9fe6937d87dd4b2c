#include "slam/associate/recheck.h"

#include <gtest/gtest.h>

#include <cmath>

#include "slam/associate/plane_comparison.h"
#include "tests/support/map_surfaces.h"

namespace slam {
namespace {

/// A camera that looks down on a desk, and on what lies `steps_m` over it, side by side in the image;
/// each is matched with the landmark at its height and place.
struct DeskInSight {
  Frame frame;
  Map map;
  Camera camera;
  AssociationConfig config;

  explicit DeskInSight(const std::vector<double>& steps_m) {
    frame.depth_m.create(camera.height, camera.width);
    frame.plane_labels.create(camera.height, camera.width);
    frame.plane_labels = 0;
    const int strip_px = camera.width / static_cast<int>(steps_m.size());
    for (const double step_m : steps_m) {
      const int index = static_cast<int>(frame.planes.size());
      const cv::Rect strip(index * strip_px, 0, strip_px, camera.height);
      const double z_m = 1.0 - step_m;
      frame.depth_m(strip) = static_cast<float>(z_m);
      frame.plane_labels(strip) = static_cast<std::uint8_t>(index + 1);
      FramePlane plane;
      plane.index = index;
      plane.pi_c = {-Eigen::Vector3d::UnitZ(), z_m};
      plane.centroid_c = PointAt(strip.x + strip_px / 2, camera.height / 2, z_m);
      plane.area_m2 = strip.area() * z_m * z_m / (camera.fx * camera.fy);
      plane.offset_sigma_m = 0.0005, plane.angle_sigma_rad = 0.002;
      MapPlane landmark;
      landmark.pi_w = plane.pi_c;
      landmark.centroid_w = plane.centroid_c;
      landmark.area_m2 = plane.area_m2;
      for (int y = 8; y < camera.height; y += 16) {
        for (int x = 8; x < strip_px; x += 16) {
          landmark.points_w.push_back(PointAt(strip.x + x, y, z_m));
        }
      }
      AddLandmark(map, landmark);
      frame.plane_matches.push_back({PlaneDecision::kMatched, index, MatchReason::kOverlap});
      frame.planes.push_back(plane);
    }
    frame.pose_covariance = 1e-6 * Matrix6d::Identity();
  }
  Eigen::Vector3d PointAt(int x_px, int y_px, double z_m) const {
    return z_m *
           Eigen::Vector3d((x_px - camera.cx) / camera.fx, (y_px - camera.cy) / camera.fy, 1.0);
  }
  /// Has the map believe that what lies so many strips beside is a part of the first landmark, too.
  void GrowFirst(int other) {
    MapPlane& first = map.planes.At(0);
    const MapPlane& beside = map.planes.At(other);
    for (const Eigen::Vector3d& p_w : beside.points_w) first.points_w.push_back(p_w);
    first.area_m2 += beside.area_m2;
  }
  int TakeBack() { return TakeBackContradicted(frame, map, camera, config); }
};

TEST(Recheck, TakesBackTheMatchThatThePoseContradictsAndNoOther) {
  DeskInSight desk({0.0, 0.03, 0.06});
  EXPECT_EQ(desk.TakeBack(), 0);
  desk.GrowFirst(1);
  desk.frame.plane_matches[1].map_plane = 0;
  EXPECT_EQ(desk.TakeBack(), 1);
  EXPECT_EQ(desk.frame.plane_matches[0].map_plane, 0);
  EXPECT_EQ(desk.frame.plane_matches[1].decision, PlaneDecision::kUnmatched);
  EXPECT_EQ(desk.frame.plane_matches[1].map_plane, kNone);
  EXPECT_EQ(desk.frame.plane_matches[1].reason, MatchReason::kAmbiguous);
  EXPECT_EQ(desk.frame.plane_matches[2].map_plane, 2);
}

TEST(Recheck, TakesBackTheMatchWithALandmarkThatIsSeenElsewhere) {
  // As high as each other: by their parameters any of the three may be any other.
  DeskInSight desk({0.02, 0.02, 0.02});
  desk.frame.plane_matches[1].map_plane = 2;
  EXPECT_EQ(desk.TakeBack(), 1);
  EXPECT_EQ(desk.frame.plane_matches[0].map_plane, 0);
  EXPECT_EQ(desk.frame.plane_matches[1].map_plane, kNone);
  EXPECT_EQ(desk.frame.plane_matches[2].map_plane, 2);
  // One that is known to be there as well may show in two segments.
  DeskInSight whole({0.02, 0.02});
  whole.GrowFirst(1);
  whole.frame.plane_matches[1].map_plane = 0;
  EXPECT_EQ(whole.TakeBack(), 0);
}

TEST(Recheck, TellsWhereALandmarkIsByTheOptimisedPose) {
  // The camera has gone by a strip since: what the map has at the second is seen at the first.
  DeskInSight desk({0.0, 0.0});
  const Eigen::Vector3d strip_m =
      desk.frame.planes[1].centroid_c - desk.frame.planes[0].centroid_c;
  desk.frame.plane_matches[0].map_plane = 1;
  desk.frame.plane_matches[1] = {};
  EXPECT_EQ(desk.TakeBack(), 1);
  desk.frame.T_cw.t = -strip_m;
  desk.frame.plane_matches[0] = {PlaneDecision::kMatched, 1, MatchReason::kOverlap};
  EXPECT_EQ(desk.TakeBack(), 0);
}

TEST(Recheck, LeavesWhatThePoseOrTheBendMayExplain) {
  for (const bool by_bend : {false, true}) {
    DeskInSight desk({0.0, 0.03});
    desk.GrowFirst(1);
    desk.frame.plane_matches[1].map_plane = 0;
    if (by_bend) {
      desk.frame.bend_ratio = 0.02;  // two centimetres at a metre
    } else {
      desk.frame.pose_covariance = 4e-4 * Matrix6d::Identity();
    }
    EXPECT_EQ(desk.TakeBack(), 0) << by_bend;
  }
}

TEST(Recheck, TakesBackWhatOneSurfaceDoesNotExplainThoughItNeedNotBeTwo) {
  int in_between = 0;
  for (double step_m = 0.0; step_m < 0.03; step_m += 0.0005) {
    DeskInSight desk({0.0, step_m});
    desk.GrowFirst(1);
    desk.frame.plane_matches[1].map_plane = 0;
    const UncertainPose pose{desk.frame.T_cw, *desk.frame.pose_covariance};
    const double chi2 =
        ComparePlanes(desk.frame.planes[1], desk.map.planes.At(0), pose, desk.config).chi2;
    if (std::abs(chi2 - desk.config.max_chi2) < 1.0) continue;  // the pose's own errors differ
    in_between += chi2 > desk.config.max_chi2 && chi2 < desk.config.new_chi2;
    EXPECT_EQ(desk.TakeBack(), chi2 > desk.config.max_chi2 ? 1 : 0) << step_m;
  }
  EXPECT_GT(in_between, 0);
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
