#include "slam/mapping/point_triangulation.h"

#include <gtest/gtest.h>

#include <cmath>

#include "slam/base/chi_square.h"
#include "slam/mapping/map_points.h"
#include "tests/support/point_world.h"

namespace slam {
namespace {

const Eigen::Vector3d kPoint_w(0.3, -0.2, 2.0);
const Pose kFirst{};
const Pose kSecond{ExpSo3({0.02, -0.05, 0.01}), {-0.2, 0.05, 0.0}};

TEST(Triangulate, MeetsThePointOfTwoExactRays) {
  const Camera camera;
  const auto p_w = Triangulate(camera.Project(kFirst * kPoint_w), kFirst,
                               camera.Project(kSecond * kPoint_w), kSecond, camera, 0.01);
  ASSERT_TRUE(p_w);
  EXPECT_LT((*p_w - kPoint_w).norm(), 1e-10);
}

TEST(Triangulate, RefusesRaysThatAreNearlyParallel) {
  const Camera camera;
  const Eigen::Vector3d far_w(10, 5, 500);
  EXPECT_FALSE(Triangulate(camera.Project(kFirst * far_w), kFirst,
                           camera.Project(kSecond * far_w), kSecond, camera, 0.01));
}

TEST(Triangulate, RefusesRaysThatMeetBehindTheCameras) {
  const Camera camera;
  const Eigen::Vector3d behind_w(0.3, -0.2, -2.0);  // Project mirrors it to the front
  EXPECT_FALSE(Triangulate(camera.Project(kFirst * behind_w), kFirst,
                           camera.Project(kSecond * behind_w), kSecond, camera, 0.01));
}

TEST(Triangulate, RefusesRaysOfWhichOneMeetsTheOtherBehindItsCamera) {
  const Camera camera;
  const Eigen::Vector3d p_w(0.1, 0.0, 1.0);
  // Beyond the point, looking away from it: the pixel is that of the line's other half.
  const Pose beyond_cw = Inverse(Pose{Eigen::Matrix3d::Identity(), {0.3, 0.0, 1.5}});
  EXPECT_FALSE(Triangulate(camera.Project(kFirst * p_w), kFirst,
                           camera.Project(beyond_cw * p_w), beyond_cw, camera, 0.01));
  EXPECT_FALSE(Triangulate(camera.Project(beyond_cw * p_w), beyond_cw,
                           camera.Project(kFirst * p_w), kFirst, camera, 0.01));
}

/// Two keyframes 0.4 m apart that both see one point, not yet in the map, each in a feature.
struct TwoViews {
  Camera camera;
  Map map;

  TwoViews() {
    Random random{3};
    const Descriptor descriptor = AnyDescriptor(random);
    for (const double x : {0.0, 0.4}) {
      Keyframe keyframe;
      keyframe.id = static_cast<int>(map.keyframes.size());
      keyframe.T_cw.t.x() = -x;
      keyframe.features = {
          FeatureOfPoint({0.2, 0.1, 2.0}, keyframe.T_cw, camera, descriptor, false)};
      keyframe.map_points = {kNone};
      map.keyframes.push_back(keyframe);
    }
    map.keyframes[0].covisible[1] = map.keyframes[1].covisible[0] = 1;
  }
  PointFeature& Feature(int keyframe) {
    return map.keyframes[static_cast<std::size_t>(keyframe)].features[0];
  }
  int Made() const {
    Map copy = map;
    return TriangulatePoints(copy, 0, camera, FeatureScale{}, {});
  }
};

TEST(TriangulatePoints, AllowTheSecondFeatureOffItsLineBySoManyPixelsOfItsOctave) {
  const double bound_px = std::sqrt(kChi2Of1At95);
  for (const int octave : {0, 3}) {
    const double at_octave_px = bound_px * std::pow(1.2, octave);
    TwoViews views;
    views.Feature(1).octave = octave;
    views.Feature(1).u_px.y() += 0.95 * at_octave_px;
    EXPECT_EQ(views.Made(), 1) << octave;
    views.Feature(1).u_px.y() += 0.1 * at_octave_px;
    EXPECT_EQ(views.Made(), 0) << octave;
  }
}

TEST(TriangulatePoints, RefuseAFeatureWithARivalOfTheSameLookOnItsLine) {
  for (const bool rival_first : {false, true}) {
    TwoViews views;
    std::vector<PointFeature>& features = views.map.keyframes[1].features;
    PointFeature rival = features[0];
    rival.u_px.x() -= 30;
    rival.descriptor[0] ^= 0x01;  // one bit behind the other
    features[0].descriptor[5] ^= 0x7F;
    rival.descriptor[5] ^= 0x7F;
    features.insert(rival_first ? features.begin() : features.end(), rival);
    views.map.keyframes[1].map_points = {kNone, kNone};
    EXPECT_EQ(views.Made(), 0) << rival_first;
    for (PointFeature& feature : features) {
      if (feature.u_px == rival.u_px) feature.descriptor[9] ^= 0xFF;  // looks unlike it now
    }
    EXPECT_EQ(views.Made(), 1) << rival_first;
  }
}

TEST(TriangulatePoints, RefuseADepthOfEitherViewThatIsNotThatOfTheRays) {
  for (const int view : {0, 1}) {
    for (const int octave : {0, 4}) {
      SCOPED_TRACE(testing::Message() << view << " " << octave);
      const double bound_px = std::sqrt(kChi2Of3At95) * std::pow(1.2, octave);
      TwoViews views;
      views.Feature(view).octave = octave;
      // As far off in disparity as the bound, from the true b f / 2 m.
      const auto with_error = [&](double px) {
        views.Feature(view).depth_m =
            FeatureScale{}.bf_px_m / (FeatureScale{}.Disparity_px(2.0) + px);
        return views.Made();
      };
      EXPECT_EQ(with_error(0.98 * bound_px), 1);
      EXPECT_EQ(with_error(1.02 * bound_px), 0);
      EXPECT_EQ(with_error(-0.98 * bound_px), 1);
    }
  }
}

TEST(TriangulatePoints, MakesPointsOfFeaturesWithoutDepthWhereTheyAre) {
  const PointWorld truth = MakePointWorld(3, 120, 1, 1000);
  PointWorld world = truth;
  for (const MapPoint& point : truth.map.points) {
    if (point.id % 2 == 0) CullPoint(world.map, point.id);
  }
  for (int k = 0; k < 3; ++k) UpdateCovisibility(world.map, k, {});
  const std::size_t before = world.map.points.size();
  const int made = TriangulatePoints(world.map, 2, world.camera, FeatureScale{}, {});
  EXPECT_EQ(world.map.points.size(), before + static_cast<std::size_t>(made));
  EXPECT_GE(made, 20);
  for (std::size_t i = before; i < world.map.points.size(); ++i) {
    const MapPoint& point = world.map.points[i];
    EXPECT_EQ(point.observations.size(), 2u);
    double nearest = 1e9;
    for (const MapPoint& true_point : truth.map.points) {
      nearest = std::min(nearest, (true_point.p_w - point.p_w).norm());
    }
    EXPECT_LT(nearest, 1e-6);
  }
}

}  // namespace
}  // namespace slam
