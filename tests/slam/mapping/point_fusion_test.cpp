#include "slam/mapping/point_fusion.h"

#include <gtest/gtest.h>

#include <cmath>

#include "slam/base/chi_square.h"
#include "slam/mapping/map_points.h"
#include "slam/model/map_queries.h"
#include "tests/support/point_world.h"

namespace slam {
namespace {

/// Splits a point in two: keyframe 2 gets a copy of its own, a little off.
int SplitOff(Map& map, int point) {
  MapPoint& p = map.points[static_cast<std::size_t>(point)];
  const int feature = p.observations.at(2);
  p.observations.erase(2);
  map.keyframes[2].map_points[static_cast<std::size_t>(feature)] = kNone;
  return AddPoint(map, p.p_w + Eigen::Vector3d(0.001, 0, 0), 2, feature, {});
}

TEST(PointFusion, MakesOneOfTwoCopiesAndKeepsTheBetterSeenOne) {
  PointWorld world = MakePointWorld(3, 100, 1);
  const int original = PointAt(world.map, 2, 0);
  const int copy = SplitOff(world.map, original);
  EXPECT_GE(FusePoints(world.map, 2, world.camera, FeatureScale{}, {}), 1);
  EXPECT_EQ(CurrentPoint(world.map, copy), original);
  const MapPoint& kept = world.map.points[static_cast<std::size_t>(original)];
  EXPECT_EQ(kept.observations.size(), 3u);
  Map again = world.map;  // its mean view is that of all three
  UpdatePoint(again, original, {});
  EXPECT_EQ(kept.view_w, again.points[static_cast<std::size_t>(original)].view_w);
}

/// A point that the first keyframe sees, and a feature of the second that falls near it. The
/// world is turned by 2 rad against both cameras.
struct NearMiss {
  Camera camera;
  Map map;
  double distance_m = 0.0;

  NearMiss(int octave, bool with_depth) {
    const Pose T_gw{ExpSo3({0, 2, 0}), {0.5, -0.3, 0.2}};
    const Eigen::Vector3d p_w = Inverse(T_gw) * Eigen::Vector3d(0.2, 0.1, 2.0);
    Random random{3};
    const Descriptor descriptor = AnyDescriptor(random);
    for (const double x : {0.0, 0.2}) {
      Keyframe keyframe;
      keyframe.id = static_cast<int>(map.keyframes.size());
      keyframe.T_cw = Pose{Eigen::Matrix3d::Identity(), {-x, 0, 0}} * T_gw;
      keyframe.features = {FeatureOfPoint(p_w, keyframe.T_cw, camera, descriptor, with_depth)};
      keyframe.features[0].octave = octave;
      keyframe.map_points = {kNone};
      map.keyframes.push_back(keyframe);
    }
    map.keyframes[0].covisible[1] = map.keyframes[1].covisible[0] = 1;
    AddPoint(map, p_w, 0, 0, {});
    distance_m = (map.keyframes[1].T_cw * p_w).norm();
  }
  bool Fuses() const {
    Map copy = map;
    FusePoints(copy, 0, camera, FeatureScale{}, {});
    return copy.points[0].observations.count(1) != 0;
  }
  bool FusesWithError(double error_px) {
    PointFeature& feature = map.keyframes[1].features[0];
    feature.u_px.y() += error_px;
    const bool fuses = Fuses();
    feature.u_px.y() -= error_px;
    return fuses;
  }
};

TEST(PointFusion, AllowsAPointOffItsFeatureByTheChiSquareOfItsKindAndOctave) {
  for (const int octave : {0, 3}) {
    for (const bool with_depth : {false, true}) {
      NearMiss miss(octave, with_depth);
      const double bound_px =
          std::sqrt(with_depth ? kChi2Of3At95 : kChi2Of2At95) * std::pow(1.2, octave);
      EXPECT_TRUE(miss.FusesWithError(0.98 * bound_px)) << octave << " " << with_depth;
      EXPECT_FALSE(miss.FusesWithError(1.02 * bound_px)) << octave << " " << with_depth;
    }
  }
}

TEST(PointFusion, AllowsAFifthBeyondTheRangeOfDistancesOfAPoint) {
  NearMiss miss(0, true);
  MapPoint& point = miss.map.points[0];
  for (const double factor : {1.19, 1.21}) {
    point.max_distance_m = 100.0, point.min_distance_m = factor * miss.distance_m;
    for (PointFeature& feature : miss.map.keyframes[1].features) {
      feature.octave = FeatureScale{}.PredictOctave(miss.distance_m, 100.0);
    }
    EXPECT_EQ(miss.Fuses(), factor < 1.2) << "too near";
    point.max_distance_m = miss.distance_m / factor, point.min_distance_m = 0.1;
    miss.map.keyframes[1].features[0].octave = 0;
    EXPECT_EQ(miss.Fuses(), factor < 1.2) << "too far";
  }
}

TEST(PointFusion, GivesAPointTheFeatureThatMatchingHadMissed) {
  PointWorld world = MakePointWorld(3, 100, 2);
  const int point = PointAt(world.map, 2, 0);
  RemoveObservation(world.map, point, 2);
  ASSERT_FALSE(world.map.points[static_cast<std::size_t>(point)].culled);
  FusePoints(world.map, 2, world.camera, FeatureScale{}, {});
  EXPECT_TRUE(world.map.points[static_cast<std::size_t>(point)].observations.count(2));
}

TEST(PointFusion, GivesAPointOfTwoFeaturesThatItIsLikeTheOneThatItIsMoreLike) {
  for (const bool likest_first : {false, true}) {
    NearMiss miss(0, false);
    Keyframe& second = miss.map.keyframes[1];
    PointFeature rival = second.features[0];
    rival.descriptor[3] ^= 0x3F;  // six bits
    second.features.insert(likest_first ? second.features.end() : second.features.begin(),
                           rival);
    second.map_points = {kNone, kNone};
    FusePoints(miss.map, 0, miss.camera, FeatureScale{}, {});
    const std::vector<int> expected =
        likest_first ? std::vector<int>{0, kNone} : std::vector<int>{kNone, 0};
    EXPECT_EQ(miss.map.keyframes[1].map_points, expected);
  }
}

TEST(PointFusion, LeavesPointsApartThatLookDifferent) {
  PointWorld world = MakePointWorld(3, 100, 3);
  const int original = PointAt(world.map, 2, 0);
  const int copy = SplitOff(world.map, original);
  const int feature = world.map.points[static_cast<std::size_t>(copy)].observations.at(2);
  auto& descriptor =
      world.map.keyframes[2].features[static_cast<std::size_t>(feature)].descriptor;
  for (auto& byte : descriptor) byte = static_cast<std::uint8_t>(byte ^ 0x33);
  UpdatePoint(world.map, copy, {});
  FusePoints(world.map, 2, world.camera, FeatureScale{}, {});
  EXPECT_EQ(CurrentPoint(world.map, copy), copy);
  EXPECT_EQ(CurrentPoint(world.map, original), original);
}

}  // namespace
}  // namespace slam
