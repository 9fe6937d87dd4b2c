#include "slam/mapping/keyframe_planes.h"

#include <gmock/gmock.h>

#include <cmath>

#include "tests/support/map_surfaces.h"
#include "tests/support/slam_matchers.h"

namespace slam {
namespace {

/// A frame whose planes were decided like this, each with map plane 0 to 3.
Frame FrameOf(const std::vector<PlaneDecision>& decisions) {
  Frame frame;
  for (const PlaneDecision decision : decisions) {
    FramePlane plane;
    plane.pi_c = {-Eigen::Vector3d::UnitZ(), 1.5};
    plane.centroid_c = {0.1, 0.2, 1.5};
    plane.offset_sigma_m = 0.004, plane.bend_offset_sigma_m = 0.012;
    plane.angle_sigma_rad = 0.003, plane.bend_angle_sigma_rad = 0.004;
    PlaneMatch match;
    match.decision = decision;
    match.map_plane =
        decision == PlaneDecision::kUnmatched ? kNone : static_cast<int>(frame.planes.size());
    frame.planes.push_back(plane);
    frame.plane_matches.push_back(match);
  }
  return frame;
}

void Keep(const Frame& frame, Keyframe& keyframe) {
  KeepPlanes(frame, PlaneMapConfig{}, SupposedConfig{}, keyframe);
}

std::vector<int> MapPlanesOf(const Keyframe& keyframe) {
  std::vector<int> ids;
  for (const KeyframePlane& plane : keyframe.planes) ids.push_back(plane.map_plane);
  return ids;
}

TEST(KeyframePlanes, AreTrustedOnesThatShowALandmarkOrOfItsOwnFrameACandidate) {
  Frame frame = FrameOf({PlaneDecision::kMatched, PlaneDecision::kUnmatched,
                         PlaneDecision::kNew, PlaneDecision::kTrial, PlaneDecision::kMatched});
  frame.planes[4].bad = BadReason::kFar;
  Keyframe keyframe;
  Keep(frame, keyframe);
  EXPECT_THAT(MapPlanesOf(keyframe), ::testing::ElementsAre(0, 2, 3));
  Keyframe earlier;
  frame.index = 1;
  Keep(frame, earlier);
  EXPECT_THAT(MapPlanesOf(earlier), ::testing::ElementsAre(0, 2));
  Keyframe culled;
  culled.culled = true;
  Keep(frame, culled);
  EXPECT_TRUE(culled.planes.empty());
}

TEST(KeyframePlanes, AreWhatItsFramesHaveSeenFromTheirPlacesAndBetterKnownForIt) {
  const Plane pi_w{Eigen::Vector3d(0.1, -0.2, -1).normalized(), 1.5};
  Keyframe keyframe;
  keyframe.T_cw = Pose{ExpSo3({0.2, 0.1, -0.3}), {0.4, 0.1, -0.2}};
  double before_m = 1.0, before_rad = 1.0;
  for (int index = 0; index < 3; ++index) {
    Frame frame = FrameOf({PlaneDecision::kMatched});
    frame.index = index;
    frame.T_cw = Pose{ExpSo3({0.01 * index, 0, 0.02}), {0.05 * index, 0, 0}} * keyframe.T_cw;
    frame.planes[0].pi_c = Transform(frame.T_cw, pi_w);
    frame.planes[0].centroid_c = ProjectOnto(frame.planes[0].pi_c, {0.1 * index, 0, 1.5});
    Keep(frame, keyframe);
    ASSERT_EQ(keyframe.planes.size(), 1u);
    const KeyframePlane& kept = keyframe.planes.front();
    EXPECT_THAT(kept.pi_c, PlaneNear(Transform(keyframe.T_cw, pi_w), 1e-9, 1e-9));
    EXPECT_LT(kept.offset_sigma_m, before_m);
    EXPECT_LT(kept.angle_sigma_rad, before_rad);
    before_m = kept.offset_sigma_m, before_rad = kept.angle_sigma_rad;
  }
}

/// Two planes of a frame may show one landmark; a later frame's outline errs like the first one's.
TEST(KeyframePlanes, KeepEdgesAndCornersThatTheirOwnFrameSaw) {
  Frame frame = FrameOf({PlaneDecision::kMatched, PlaneDecision::kMatched});
  frame.plane_matches[1].map_plane = 0;
  for (FramePlane& plane : frame.planes) {
    plane.lines_c = {{{0.3, 0.2, 1.5}, Eigen::Vector3d::UnitY()}};
    const Eigen::Matrix3d covariance = 1e-6 * Eigen::Matrix3d::Identity();
    const Eigen::Vector3d unknown = Eigen::Vector3d::Constant(std::nan(""));
    plane.vertices_c = {{{0.3, 0.1, 1.5}, false, covariance},
                        {{0.3, 0.5, 1.5}, true, covariance},
                        {unknown, false, covariance}};
  }
  Keyframe keyframe;
  Keep(frame, keyframe);
  frame.index = 1;
  Keep(frame, keyframe);
  ASSERT_EQ(keyframe.planes.size(), 1u);
  const KeyframePlane& kept = keyframe.planes.front();
  ASSERT_EQ(kept.vertices_c.size(), 2u);
  EXPECT_EQ(kept.vertices_c[1].p_c, Eigen::Vector3d(0.3, 0.1, 1.5));
  ASSERT_EQ(kept.edges.size(), 2u);
  EXPECT_THAT(kept.edges[1].pi_c,
              PlaneNear(Plane{Eigen::Vector3d::UnitX(), -0.3}, 1e-12, 1e-12));
  EXPECT_EQ(kept.edges[1].offset_sigma_m, SupposedConfig{}.offset_sigma_m);
  EXPECT_EQ(kept.edges[1].angle_sigma_rad, SupposedConfig{}.angle_sigma_rad);
}

TEST(KeyframePlanes, ShowTheLandmarkThatTheirMapPlaneHasBecome) {
  Map map;
  AddLandmark(map, {});
  MapPlane merged;
  merged.status = LandmarkStatus::kMerged, merged.merged_into = 0;
  map.planes.Add(merged);
  map.planes.Add({});  // a candidate
  map.planes.Add({});  // one that fails its trial
  map.planes.EraseCandidates([](const MapPlane& plane) { return plane.id == 3; });
  const auto landmark = [&](int id) {
    KeyframePlane seen;
    seen.map_plane = id;
    return LandmarkOf(map, seen);
  };
  EXPECT_EQ(landmark(0), &map.planes.At(0));
  EXPECT_EQ(landmark(1), &map.planes.At(0));
  EXPECT_EQ(landmark(2), nullptr);
  EXPECT_EQ(landmark(3), nullptr);
  EXPECT_EQ(landmark(kNone), nullptr);
}

}  // namespace
}  // namespace slam
