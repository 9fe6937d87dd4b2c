#include "slam/tracking/last_frame.h"

#include <gmock/gmock.h>

#include "slam/base/index.h"
#include "tests/support/slam_matchers.h"

namespace slam {
namespace {

const Pose kReference_cw{ExpSo3({0.2, -0.4, 0.3}), {0.5, 0.1, -0.3}};
const Pose kStep_cr{ExpSo3({-0.1, 0.15, 0.05}), {0.2, -0.1, 0.4}};

PointFeature FeatureAtDepth(double u_px, double depth_m, int octave = 0) {
  PointFeature feature;
  feature.u_px = {u_px, 150.0};
  feature.depth_m = depth_m;
  feature.octave = octave;
  feature.angle_deg = 77.0f;
  feature.descriptor[3] = 0x5A;
  return feature;
}

/// One keyframe, turned; the last frame has points at 1, 3, 2 and 5 m, all unmatched.
struct Remembered {
  Camera camera;
  Map map;
  LastFrame last;

  Remembered() {
    map.keyframes.resize(1);
    map.keyframes[0].T_cw = kReference_cw;
    last.features = {FeatureAtDepth(250, 1.0, 3), FeatureAtDepth(200, 3.0),
                     FeatureAtDepth(300, 2.0), FeatureAtDepth(400, 5.0)};
    last.map_points.assign(4, kNone);
    last.reference = 0;
    last.T_cr = kStep_cr;
  }
  std::vector<SeenPoint> Seen(double close_m, int most) const {
    return SeenPoints(last, map, camera, close_m, most);
  }
};

TEST(LastFrame, FollowsItsKeyframeAlsoWhenThatWasCulled) {
  Remembered r;
  EXPECT_THAT(LastPose(r.last, r.map), PoseNear(kStep_cr * kReference_cw, 1e-12, 1e-12));
  const Pose T_cp{ExpSo3({0.3, 0.1, 0.2}), {0.1, 0.2, 0.3}};
  Keyframe parent;
  parent.id = 1;
  parent.T_cw = Pose{ExpSo3({0.1, 0.7, -0.2}), {1.0, 0.0, 2.0}};
  r.map.keyframes.push_back(parent);
  r.map.keyframes[0].culled = true;
  r.map.keyframes[0].parent = 1;
  r.map.keyframes[0].T_cp = T_cp;
  EXPECT_THAT(LastPose(r.last, r.map), PoseNear(kStep_cr * T_cp * parent.T_cw, 1e-12, 1e-12));
}

TEST(LastFrame, KnowsItsNearestUnmatchedFeaturesWhereTheirDepthSays) {
  const Remembered r;
  const auto seen = r.Seen(4.0, 2);
  ASSERT_EQ(seen.size(), 2u);  // 5 m is too far, 3 m one too many
  EXPECT_EQ(seen[0].feature, 0);
  EXPECT_EQ(seen[1].feature, 2);
  const Pose T_wl = Inverse(kStep_cr * kReference_cw);
  EXPECT_THAT(seen[1].p_w,
              VectorNear(Eigen::Vector3d(T_wl * r.camera.Backproject({300, 150}, 2.0)), 1e-12));
  EXPECT_EQ(r.Seen(5.0, 100).size(), 4u);
}

TEST(LastFrame, LooksForItsPointsAroundWhereAPredictionPutsThem) {
  const Remembered r;
  const auto seen = r.Seen(1.5, 100);
  ASSERT_EQ(seen.size(), 1u);
  const Pose ahead_cw = Pose{Eigen::Matrix3d::Identity(), {0, 0, -0.5}} * kStep_cr *
                        kReference_cw;  // half way to the point
  const auto queries = QueriesOf(seen, r.last, ahead_cw, r.camera, FeatureScale{}, 7.0);
  ASSERT_EQ(queries.size(), 1u);
  const Eigen::Vector3d p_c =
      r.camera.Backproject({250, 150}, 1.0) - Eigen::Vector3d(0, 0, 0.5);
  const Eigen::Vector2d u_px = r.camera.Project(p_c);
  EXPECT_LT((queries[0].u_px - u_px).norm(), 1e-9);
  EXPECT_NEAR(queries[0].radius_px, 7.0 * 1.2 * 1.2 * 1.2, 1e-9);
  EXPECT_EQ(queries[0].min_octave, 2);
  EXPECT_EQ(queries[0].max_octave, 4);
  const PointFeature& feature = r.last.features[Index(seen[0].feature)];
  EXPECT_EQ(queries[0].angle_deg, feature.angle_deg);
  EXPECT_EQ(queries[0].descriptor, feature.descriptor);
}

TEST(LastFrame, LooksForWhatTheRecordedImageShowsThroughABarrelLens) {
  Remembered r;
  r.camera.k1 = -0.2, r.camera.k2 = 0.04;
  for (const double ideal_u_px : {655.0, 690.0}) {
    r.last.features = {FeatureAtDepth(ideal_u_px, 1.0)};
    r.last.map_points = {kNone};
    const auto seen = r.Seen(1.5, 100);
    ASSERT_EQ(seen.size(), 1u);
    EXPECT_EQ(
        QueriesOf(seen, r.last, kStep_cr * kReference_cw, r.camera, FeatureScale{}, 7.0).size(),
        ideal_u_px < 660 ? 1u : 0u);
  }
}

}  // namespace
}  // namespace slam
