#include "slam/pose/point_constraints.h"

#include <gmock/gmock.h>

#include <algorithm>

#include "slam/pose/solve.h"
#include "tests/support/slam_matchers.h"

namespace slam {
namespace {

using ::testing::ElementsAre;

TEST(PointConstraints, AreOfTheMatchedFeaturesAndOutliersLoseTheirOwnMatch) {
  Map map;
  map.points.resize(3);
  for (int id = 0; id < 3; ++id) {
    map.points[static_cast<std::size_t>(id)].id = id;
    map.points[static_cast<std::size_t>(id)].p_w = {0.1 * id, 0, 2};
  }
  Frame frame;
  frame.features.resize(5);
  frame.map_points = {2, kNone, kNone, 0, 1};
  const FramePoints points = PointConstraints(frame, map, FeatureScale{});
  EXPECT_THAT(points.features, ElementsAre(0, 3, 4));
  EXPECT_EQ(points.constraints[0].p_w, map.points[2].p_w);
  DropOutliers(frame, points, {false, true, false});
  EXPECT_THAT(frame.map_points, ElementsAre(kNone, kNone, kNone, 0, kNone));
}

/// Points of a map as a turned camera sees them, which is taken to be a little beside.
struct SeenPoints {
  const Pose truth{ExpSo3({0.3, -0.2, 0.1}), {0.4, -0.3, 0.2}};
  const Camera camera;
  Map map;
  Frame frame;

  explicit SeenPoints(int count) {
    for (int i = 0; i < count; ++i) {
      const Eigen::Vector3d x_c(0.3 * (i % 4) - 0.5, 0.25 * (i % 3) - 0.3, 1.5 + 0.1 * (i % 7));
      MapPoint point;
      point.id = i;
      point.p_w = Inverse(truth) * x_c;
      map.points.push_back(point);
      PointFeature& feature = frame.features.emplace_back();
      feature.u_px = camera.Project(x_c);
      feature.depth_m = x_c.z(), feature.depth_sigma_m = 0.01;
      frame.map_points.push_back(i);
    }
    frame.T_cw = Exp((Vector6d() << 0.01, -0.01, 0.01, 0.01, 0.02, -0.01).finished()) * truth;
  }
};

TEST(OptimiseByPoints, TellsTheFrameItsPoseAndWhatThatIsWorthAndDropsWhatIsOff) {
  SeenPoints seen(24);
  seen.frame.features[7].u_px.x() += 30;
  // What an earlier pose was worth.
  seen.frame.evidence.of_pose = Matrix6d::Identity();
  seen.frame.pose_covariance = Matrix6d::Identity();
  EXPECT_EQ(OptimiseByPoints(seen.frame, seen.map, seen.camera, {}, {}), 23);
  EXPECT_THAT(seen.frame.T_cw, PoseNear(seen.truth, 1e-6, 1e-6));
  EXPECT_EQ(seen.frame.map_points[7], kNone);
  EXPECT_EQ(std::count(seen.frame.map_points.begin(), seen.frame.map_points.end(), kNone), 1);
  // Nothing else told: the covariance is the inverse of what was measured.
  ASSERT_GT(seen.frame.evidence.of_pose(0, 0), 1e3);
  EXPECT_TRUE((seen.frame.evidence.of_pose * *seen.frame.pose_covariance).isIdentity(1e-6));
}

TEST(OptimiseByPoints, OfTwoPointsIsHeldByThePredictionAloneAndElseChangesNothing) {
  SeenPoints seen(2);
  const Pose before = seen.frame.T_cw;
  EXPECT_EQ(OptimiseByPoints(seen.frame, seen.map, seen.camera, {}, {}), 0);
  EXPECT_EQ(seen.frame.T_cw.t, before.t);
  EXPECT_EQ(seen.frame.T_cw.R, before.R);
  EXPECT_FALSE(seen.frame.pose_covariance);
  seen.frame.prediction = UncertainPose{seen.truth, IsotropicCovariance(0.01, 0.01)};
  EXPECT_EQ(OptimiseByPoints(seen.frame, seen.map, seen.camera, {}, {}), 2);
  EXPECT_THAT(seen.frame.T_cw, PoseNear(seen.truth, 1e-6, 1e-6));
  // The turn about their line is known as it was predicted; the prediction is no evidence.
  EXPECT_TRUE(seen.frame.pose_covariance);
  EXPECT_EQ(Nullity(seen.frame.evidence.of_pose), 1);
}

// So a depth camera that errs is told from one whose pixels do.
TEST(PoseByPixels, AsksNoDepth) {
  SeenPoints seen(24);
  for (PointFeature& feature : seen.frame.features) feature.depth_m *= 1.03;
  const auto by_pixels = PoseByPixels(seen.frame, seen.map, seen.camera, {});
  ASSERT_TRUE(by_pixels);
  EXPECT_THAT(*by_pixels, PoseNear(seen.truth, 1e-6, 1e-6));
  const SeenPoints two(2);
  EXPECT_FALSE(PoseByPixels(two.frame, two.map, two.camera, {}));
}

}  // namespace
}  // namespace slam
