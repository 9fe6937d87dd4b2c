#include "slam/places/place_search.h"

#include <gmock/gmock.h>

#include <algorithm>

#include "tests/support/point_world.h"
#include "tests/support/slam_matchers.h"

namespace slam {
namespace {

const Pose kMoved_cw{ExpSo3({0.05, 0.2, 0.1}), {0.15, -0.1, 0.05}};

/// The keyframe's points from a third of a metre beside: `right` of them where they are, the
/// others each with the look of another one.
Frame Mistaken(const PointWorld& world, int right, std::uint64_t seed) {
  Random random{seed};
  const Keyframe& keyframe = world.map.keyframes[0];
  const int all = static_cast<int>(keyframe.features.size());
  Frame frame;
  for (int f = 0; f < all; ++f) {
    const int looks_like = f < right ? f : right + (f - right + 7) % (all - right);
    const int point = keyframe.map_points[static_cast<std::size_t>(f)];
    PointFeature feature = FeatureOfPoint(
        world.map.points[static_cast<std::size_t>(point)].p_w, kMoved_cw, world.camera,
        keyframe.features[static_cast<std::size_t>(looks_like)].descriptor, true);
    feature.u_px += Eigen::Vector2d(random.Uniform() - 0.5, random.Uniform() - 0.5);
    frame.features.push_back(feature);
  }
  return frame;
}

std::optional<PlacePose> Find(const PointWorld& world, const Frame& frame,
                              const PlaceSearchConfig& config = {}) {
  PointSearchConfig search;
  search.place = config;
  return FindPose(world.map.keyframes[0], frame, world.map, world.camera, FeatureScale{},
                  search);
}

TEST(PlaceSearch, FindsThePoseThatAFifthOfTheMatchesAgreeOn) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const PointWorld world = MakePointWorld(1, 90, seed);
    const int all = static_cast<int>(world.map.keyframes[0].features.size());
    const int right = std::max(12, all / 5);
    const auto found = Find(world, Mistaken(world, right, seed));
    ASSERT_TRUE(found) << right << " of " << all << ", seed " << seed;
    EXPECT_THAT(found->T_cw, PoseNear(kMoved_cw, 0.005, 0.01)) << "seed " << seed;
    EXPECT_GE(found->inliers, right - 2) << "seed " << seed;
    for (int f = right; f < all; ++f) {
      EXPECT_EQ(found->map_points[static_cast<std::size_t>(f)], kNone) << "a wrong match";
    }
  }
}

TEST(PlaceSearch, NamesTheMapPointsOfTheMatchesThatAgreeAlsoAfterWrongOnes) {
  const PointWorld world = MakePointWorld(1, 90, 4);
  const Keyframe& keyframe = world.map.keyframes[0];
  const int all = static_cast<int>(keyframe.features.size()), right = all / 2;
  Frame frame = Mistaken(world, right, 4);
  std::reverse(frame.features.begin(), frame.features.end());  // the wrong ones come first
  const auto found = Find(world, frame);
  ASSERT_TRUE(found);
  int named = 0;
  for (int f = 0; f < all; ++f) {
    const int point = found->map_points[static_cast<std::size_t>(all - 1 - f)];
    if (point == kNone) continue;
    EXPECT_EQ(point, keyframe.map_points[static_cast<std::size_t>(f)]) << f;
    ++named;
  }
  EXPECT_GE(named, right - 2);
}

TEST(PlaceSearch, FindsNothingWhereEveryMatchIsWrong) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const PointWorld world = MakePointWorld(1, 90, seed);
    EXPECT_FALSE(Find(world, Mistaken(world, 0, seed))) << "seed " << seed;
  }
}

// A blurred or a near view shows the place in coarse octaves, whose pixels are larger.
TEST(PlaceSearch, AsksOfCoarseFeaturesNoMoreThanTheirOctaveTells) {
  constexpr double kOff_px = 1.5;  // of the octave's own
  for (const int octave : {0, 4, 7}) {
    const PointWorld world = MakePointWorld(1, 90, 5);
    const int all = static_cast<int>(world.map.keyframes[0].features.size());
    Frame frame = Mistaken(world, all, 5);
    Random random{9};
    for (PointFeature& feature : frame.features) {
      feature.octave = octave;
      feature.u_px += FeatureScale{}.Scale(octave) * 2 * kOff_px *
                      Eigen::Vector2d(random.Uniform() - 0.5, random.Uniform() - 0.5);
    }
    const auto found = Find(world, frame);
    ASSERT_TRUE(found) << octave;
    EXPECT_GE(found->inliers, 0.9 * all) << octave;
  }
}

// Two answers are one place by where the camera is and looks, wherever the world begins.
TEST(SamePose, GoesByTheCamerasPlaceFarFromTheWorldsOrigin) {
  const PlaceSearchConfig config;
  const auto at = [](double x_m, double turn_rad) {
    return Inverse(Pose{ExpSo3({0, turn_rad, 0}), {x_m, 20.0, 0}});
  };
  EXPECT_TRUE(SamePose(at(30, 0), at(30 + 0.9 * config.same_pose_m, 0.05), config));
  EXPECT_FALSE(SamePose(at(30, 0), at(30 + 1.1 * config.same_pose_m, 0.05), config));
  EXPECT_TRUE(SamePose(at(30, 0.3), at(30, 0.3 + 0.9 * config.same_pose_rad), config));
  EXPECT_FALSE(SamePose(at(30, 0.3), at(30, 0.3 + 1.1 * config.same_pose_rad), config));
}

TEST(PlaceSearch, NeedsNoDepth) {
  const PointWorld world = MakePointWorld(1, 90, 3);
  const int all = static_cast<int>(world.map.keyframes[0].features.size());
  Frame frame = Mistaken(world, all - all / 4, 3);
  for (PointFeature& feature : frame.features) feature.depth_m = 0;
  const auto found = Find(world, frame);
  ASSERT_TRUE(found);
  EXPECT_THAT(found->T_cw, PoseNear(kMoved_cw, 0.005, 0.02));
}

}  // namespace
}  // namespace slam
