#include "slam/mapping/bundle/bundle_window.h"

#include <gmock/gmock.h>

#include <cmath>

#include "tests/support/point_world.h"
#include "tests/support/slam_matchers.h"

namespace slam {
namespace {

using ::testing::ElementsAre;

constexpr double kOff_px = 2.6;  // its square lies between the two chi-square bounds

/// Keyframe 0 tied to 1 alone; 2 and 3, outside, see some of their points: 3 more than 2.
Map TiedPair() {
  Map map;
  map.keyframes.resize(4);
  for (int k = 0; k < 4; ++k) {
    Keyframe& keyframe = map.keyframes[static_cast<std::size_t>(k)];
    keyframe.id = k;
    keyframe.features.resize(6);
    for (PointFeature& feature : keyframe.features) feature.depth_m = 1.0;
    keyframe.map_points.assign(6, kNone);
  }
  for (int f = 0; f < 6; ++f) {
    const int id = AddPoint(map, {0, 0, 1}, 0, f, {});
    AddObservation(map, id, 1, f);
    if (f < 2) AddObservation(map, id, 2, f);
    if (f < 4) AddObservation(map, id, 3, f);
  }
  map.keyframes[0].covisible = {{1, 6}};
  map.keyframes[1].covisible = {{0, 6}};
  return map;
}

TEST(BundleWindow, IsHeldByTheFirstKeyframeAndThoseThatSeeMostOfItsPoints) {
  LocalBundleConfig config;
  config.max_fixed_keyframes = 1;
  const BundleWindow window = LocalWindow(TiedPair(), 1, Camera{}, FeatureScale{}, config);
  EXPECT_EQ(window.free_count, 1u);
  EXPECT_THAT(window.keyframes, ElementsAre(1, 3, 0));
}

TEST(BundleWindow, OfAllKeyframesIsHeldByThoseThatPlanesHold) {
  PointWorld world = MakePointWorld(5, 80, 3);
  world.map.keyframes[2].by_points = false;
  const BundleWindow window = FullWindow(world.map, world.camera, FeatureScale{}, {});
  EXPECT_EQ(window.free_count, 3u);
  EXPECT_THAT(window.keyframes, ElementsAre(1, 3, 4, 0, 2));
}

TEST(BundleWindow, OfAllKeyframesLeavesOutTheCulledAndIsEmptyWhereThereAreNone) {
  PointWorld world = MakePointWorld(5, 80, 3);
  world.map.keyframes[2].culled = true;
  const BundleWindow window = FullWindow(world.map, world.camera, FeatureScale{}, {});
  EXPECT_EQ(window.free_count, 3u);
  EXPECT_THAT(window.keyframes, ElementsAre(1, 3, 4, 0));
  const BundleWindow none = FullWindow(Map{}, world.camera, FeatureScale{}, {});
  EXPECT_THAT(none.keyframes, testing::IsEmpty());
}

/// The report on a map of which one observation is off by so much, nothing moved.
LocalBundleReport ReportOnOneOff(bool stereo, double off_px, int octave) {
  PointWorld world = MakePointWorld(4, 80, 3, stereo ? 1 : 1000);
  PointFeature& feature = world.map.keyframes[2].features[3];
  feature.octave = octave;
  feature.u_px.y() += off_px;
  LocalBundleConfig config;
  config.first_iterations = config.last_iterations = 0;
  BundleWindow window = FullWindow(world.map, world.camera, FeatureScale{}, config);
  return SolveWindow(window, config);
}

TEST(BundleWindow, TakesObservationsForOutliersByTheChiSquareOfTheirKindAndOctave) {
  EXPECT_EQ(ReportOnOneOff(false, kOff_px, 0).outliers, 1);
  EXPECT_EQ(ReportOnOneOff(true, kOff_px, 0).outliers, 0);
  for (const int octave : {0, 3}) {
    const double bound_px = std::sqrt(7.815) * std::pow(1.2, octave);
    EXPECT_EQ(ReportOnOneOff(true, 0.98 * bound_px, octave).outliers, 0) << octave;
    EXPECT_EQ(ReportOnOneOff(true, 1.02 * bound_px, octave).outliers, 1) << octave;
  }
}

TEST(BundleWindow, CountsAnOutlierByHubersLossInTheFirstRound) {
  const double e = 10.0;
  EXPECT_NEAR(ReportOnOneOff(true, e, 0).initial_cost, std::sqrt(7.815) * e - 7.815 / 2, 1e-6);
  EXPECT_NEAR(ReportOnOneOff(false, e, 0).initial_cost, std::sqrt(5.991) * e - 5.991 / 2, 1e-6);
}

TEST(BundleWindow, CarriesWhatCameMeanwhileAlongWithItsNewestKeyframe) {
  PointWorld world = MakePointWorld(4, 80, 3);
  BundleWindow window = LocalWindow(world.map, 3, world.camera, FeatureScale{}, {});
  const auto newest =
      static_cast<std::size_t>(std::find(window.keyframes.begin(), window.keyframes.end(), 3) -
                               window.keyframes.begin());
  ASSERT_LT(newest, window.free_count);
  // A keyframe and a point that come while the window is solved.
  Keyframe late = world.map.keyframes[3];
  const Pose T_43{ExpSo3({0.2, 0.1, -0.3}), {0.1, 0.2, -0.1}};
  late.id = 4, late.T_cw = T_43 * late.T_cw;
  late.map_points.assign(late.features.size(), kNone);
  world.map.keyframes.push_back(late);
  const Eigen::Vector3d p_w(0.3, 0.5, 1.5);
  const Eigen::Vector3d p_3 = world.map.keyframes[3].T_cw * p_w;
  AddPoint(world.map, p_w, 4, 0, {});
  // The solution turns and moves keyframe 3.
  const Pose solved_cw =
      Pose{ExpSo3({-0.1, 0.3, 0.2}), {0.4, 0.0, 0.2}} * world.map.keyframes[3].T_cw;
  window.poses[newest] = BlockOf(solved_cw);
  MergeWindow(window, {}, world.map);
  EXPECT_THAT(world.map.keyframes[3].T_cw, PoseNear(solved_cw, 1e-9, 1e-9));
  EXPECT_THAT(world.map.keyframes[4].T_cw, PoseNear(T_43 * solved_cw, 1e-9, 1e-9));
  EXPECT_THAT(Eigen::Vector3d(solved_cw * world.map.points.back().p_w), VectorNear(p_3, 1e-9));
}

TEST(BundleWindow, TellsItsPointsWhereTheyAreSeenFromAfterwards) {
  PointWorld world = MakePointWorld(4, 80, 3);
  BundleWindow window = LocalWindow(world.map, 3, world.camera, FeatureScale{}, {});
  for (auto& position : window.positions) position[0] += 0.2;
  MergeWindow(window, {}, world.map);
  Map again = world.map;
  ASSERT_FALSE(window.points.empty());
  for (const int id : window.points) {
    UpdatePoint(again, id, {});
    EXPECT_EQ(again.points[static_cast<std::size_t>(id)].view_w,
              world.map.points[static_cast<std::size_t>(id)].view_w);
  }
}

}  // namespace
}  // namespace slam
