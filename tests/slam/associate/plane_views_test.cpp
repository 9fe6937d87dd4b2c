#include <gmock/gmock.h>

#include "slam/associate/association_config.h"
#include "slam/associate/plane_overlap.h"
#include "slam/associate/plane_samples.h"
#include "slam/associate/point_plane.h"
#include "slam/associate/projected_box.h"
#include "slam/base/index.h"
#include "tests/support/slam_matchers.h"

namespace slam {
namespace {

using ::testing::ElementsAre;

const Pose kView_cw{ExpSo3({0.2, -0.3, 0.5}), {0.1, 0.4, -0.2}};

/// One frame plane, two metres away and facing the camera, on the left half of the image.
Frame HalfAPlane(const Camera& camera) {
  Frame frame;
  frame.T_cw = kView_cw;
  frame.depth_m = cv::Mat1f(camera.height, camera.width, 2.0f);
  frame.plane_labels = cv::Mat1b(camera.height, camera.width, std::uint8_t{0});
  frame.plane_labels(cv::Rect(0, 0, camera.width / 2, camera.height)).setTo(1);
  FramePlane plane;
  plane.pi_c = {Eigen::Vector3d(0, 0, -1), 2.0};
  frame.planes = {plane};
  return frame;
}

PointFeature FeatureWithDepth(const Eigen::Vector2d& u_px, double depth_m) {
  PointFeature feature;
  feature.u_px = u_px;
  feature.depth_m = depth_m;
  return feature;
}

MapPoint PointSeenAt(int id, const Camera& camera, const Eigen::Vector2d& u_px, double z_m) {
  MapPoint point;
  point.id = id;
  point.p_w = Inverse(kView_cw) * camera.Backproject(u_px, z_m);
  return point;
}

TEST(OverlapOfAView, IsTheShareOfTheSmallerFootprintOfThreePointsAtLeast) {
  PlaneView view;
  view.expected = 100;
  view.landed = {20};
  view.cell_m2 = 0.01;
  FramePlane patch;
  patch.area_m2 = 0.25;  // 25 cells
  EXPECT_DOUBLE_EQ(Overlap(view, patch), 0.8);
  patch.area_m2 = 4.0;
  EXPECT_DOUBLE_EQ(Overlap(view, patch), 0.2);
  patch.area_m2 = 0.01;
  view.landed = {1};
  EXPECT_DOUBLE_EQ(Overlap(view, patch), 1.0 / 3.0);
}

// What stands in front of a desk takes nothing from its overlap.
TEST(ViewOfAMapPlane, ExpectsThePointsThatNothingNearerHides) {
  const Camera camera;
  Frame frame = HalfAPlane(camera);
  frame.depth_m(cv::Rect(0, 0, 150, camera.height)).setTo(1.5f);
  frame.depth_m(cv::Rect(250, 0, 20, camera.height)).setTo(0.0f);  // nothing measured
  MapPlane m;
  for (const double u : {50, 100, 200, 220, 260, 300, 400, 700})
    m.points_w.push_back(PointSeenAt(0, camera, {u, 200}, 2.0).p_w);
  m.area_m2 = 0.08;
  const PlaneView view = ViewMapPlane(m, frame, kView_cw, camera);
  EXPECT_EQ(view.expected, 4);  // at 200, 220, 300 and 400
  EXPECT_THAT(view.landed, ElementsAre(3));
  EXPECT_DOUBLE_EQ(view.cell_m2, 0.01);
}

TEST(FeaturesOnPlanes, AreThoseOnItsPixelsAndLieInTheWorld) {
  const Camera camera;
  Frame frame = HalfAPlane(camera);
  frame.features = {FeatureWithDepth({100, 200}, 2.0), FeatureWithDepth({500, 200}, 2.0),
                    FeatureWithDepth({50, 200}, 0.0)};
  const auto on_plane = FeaturesOnPlanes(frame, kView_cw, camera);
  ASSERT_EQ(on_plane.size(), 1u);
  ASSERT_EQ(on_plane[0].size(), 1u);
  EXPECT_THAT(on_plane[0][0], VectorNear(PointSeenAt(0, camera, {100, 200}, 2.0).p_w, 1e-12));
}

TEST(VisibleMapPoints, AreThoseMeasuredThatNothingNearerHidesAndThatWereNotCulled) {
  const Camera camera;
  Frame frame = HalfAPlane(camera);
  frame.depth_m(cv::Rect(250, 0, 20, camera.height)).setTo(0.0f);  // nothing measured
  Map map;
  map.points = {
      PointSeenAt(0, camera, {100, 200}, 2.0), PointSeenAt(1, camera, {200, 200}, 2.05),
      PointSeenAt(2, camera, {300, 200}, 2.2), PointSeenAt(3, camera, {400, 200}, 1.5),
      PointSeenAt(4, camera, {450, 200}, 2.0), PointSeenAt(5, camera, {-90, 200}, 2.0),
      PointSeenAt(6, camera, {260, 200}, 2.0)};
  map.points[4].culled = true;
  MapPlane m;
  m.map_points = {0, 1, 2, 3, 4, 5, 6};
  const auto visible = VisibleMapPoints(m, map, frame, kView_cw, camera);
  EXPECT_THAT(visible, ElementsAre(map.points[0].p_w, map.points[1].p_w, map.points[3].p_w));
}

TEST(PointsOnPlanes, LieOnBothSidesOfItNearEnough) {
  const Camera camera;
  const AssociationConfig config;
  Frame frame = HalfAPlane(camera);
  Map map;
  const double near_m = 0.9 * config.max_point_plane_m, far_m = 1.1 * config.max_point_plane_m;
  for (const double z_m : {2.0, 2.0 + near_m, 2.0 - near_m, 2.0 + far_m, 2.0 - far_m, 2.0}) {
    const int id = static_cast<int>(map.points.size());
    const Eigen::Vector2d u_px(50.0 + 10 * id, 200);
    map.points.push_back(PointSeenAt(id, camera, u_px, z_m));
    frame.features.push_back(FeatureWithDepth(u_px, z_m));
    frame.map_points.push_back(id);
  }
  map.points[5].culled = true;
  std::vector<int> on_it;
  for (const PointPlaneMatch& match :
       AssociatePointsToPlanes(frame, map, camera, config.max_point_plane_m)) {
    EXPECT_EQ(match.frame_plane, 0);
    on_it.push_back(frame.map_points[Index(match.feature)]);
  }
  EXPECT_THAT(on_it, ElementsAre(0, 1, 2));
}

TEST(PointsOnPlanes, LieOnTheNearestOfThoseInWhoseBoxesAHoleOfTheSegmentsIs) {
  const Camera camera;
  Frame frame = HalfAPlane(camera);
  frame.plane_labels.setTo(0);
  frame.detections.resize(1);
  frame.planes.resize(3, frame.planes[0]);
  for (int k = 0; k < 3; ++k) {
    FramePlane& plane = frame.planes[static_cast<std::size_t>(k)];
    plane.index = k;
    plane.pi_c.d = 2.0 + std::array{0.001, 0.0, 0.01}[static_cast<std::size_t>(k)];
    plane.box_px = frame.detections[0].box_px = {{0, 0}, {300, 300}};
    plane.detection = 0;
  }
  Map map;
  map.points = {PointSeenAt(0, camera, {100, 200}, 2.0),
                PointSeenAt(1, camera, {400, 200}, 2.0)};
  frame.features = {FeatureWithDepth({100, 200}, 2.0), FeatureWithDepth({400, 200}, 2.0)};
  frame.map_points = {0, 1};
  const auto matches =
      AssociatePointsToPlanes(frame, map, camera, AssociationConfig{}.max_point_plane_m);
  ASSERT_EQ(matches.size(), 1u);
  EXPECT_EQ(matches[0].frame_plane, 1);
}

TEST(PointsOnPlanes, GoByThePixelOfTheFeatureAndLieOnNoPlaneThatIsBad) {
  const Camera camera;
  Frame frame = HalfAPlane(camera);
  const double border_px = camera.width / 2;
  Map map;
  // Each feature is on the other side of the plane's border than its point is expected.
  for (const double side : {-2.0, 2.0}) {
    map.points.push_back(PointSeenAt(0, camera, {border_px - side, 200}, 2.0));
    frame.features.push_back(FeatureWithDepth({border_px + side, 200}, 2.0));
  }
  frame.map_points = {0, 1};
  auto matches = AssociatePointsToPlanes(frame, map, camera, 0.02);
  ASSERT_EQ(matches.size(), 1u);
  EXPECT_EQ(matches[0].feature, 0);
  frame.planes[0].bad = BadReason::kInliers;
  EXPECT_TRUE(AssociatePointsToPlanes(frame, map, camera, 0.02).empty());
}

TEST(PointsOnPlanes, LieInAHoleOnlyWhereBothBoxesHoldIt) {
  const Camera camera;
  Frame frame = HalfAPlane(camera);
  frame.plane_labels.setTo(0);
  Map map;
  map.points = {PointSeenAt(0, camera, {100, 200}, 2.0)};
  frame.features = {FeatureWithDepth({100, 200}, 2.0)};
  frame.map_points = {0};
  const Box holds{{0, 0}, {300, 300}}, beside{{150, 0}, {300, 300}};
  frame.detections.resize(1);
  FramePlane& plane = frame.planes[0];
  for (const bool of_plane : {false, true}) {
    for (const bool of_detection : {false, true}) {
      plane.detection = 0;
      plane.box_px = of_plane ? holds : beside;
      frame.detections[0].box_px = of_detection ? holds : beside;
      const auto matches = AssociatePointsToPlanes(frame, map, camera, 0.02);
      EXPECT_EQ(matches.size(), of_plane && of_detection ? 1u : 0u);
      plane.detection.reset();
      EXPECT_TRUE(AssociatePointsToPlanes(frame, map, camera, 0.02).empty());
    }
  }
}

/// A book's corners that fall on these ideal pixels from kView_cw, two metres away.
MapPlane BookAt(const Camera& camera, const Box& box_px) {
  MapPlane m;
  m.class_name = "book";
  for (const Eigen::Vector2d& u_px :
       {box_px.min, Eigen::Vector2d(box_px.max.x(), box_px.min.y()), box_px.max,
        Eigen::Vector2d(box_px.min.x(), box_px.max.y())}) {
    m.vertices_w.push_back(Inverse(kView_cw) * camera.Backproject(u_px, 2.0));
  }
  return m;
}

TEST(BoxesOfMapPlanes, AreThoseOfTheRecordedImage) {
  const Camera camera = TumCamera("tum1");
  const Box ideal{{60, 50}, {200, 150}};
  const Box box_px = ProjectedBox(BookAt(camera, ideal), kView_cw, camera);
  Box expected;
  for (const Eigen::Vector2d& u_px :
       {ideal.min, ideal.max, Eigen::Vector2d(60, 150), Eigen::Vector2d(200, 50)}) {
    expected.Include(camera.ProjectDistorted(camera.Backproject(u_px, 1.0)));
  }
  EXPECT_THAT(box_px.min, VectorNear(expected.min, 1e-9));
  EXPECT_THAT(box_px.max, VectorNear(expected.max, 1e-9));
  EXPECT_GT((box_px.min - ideal.min).norm(), 1.0);  // the lens tells
}

TEST(BoxesOfMapPlanes, EndWhereTheImageDoes) {
  const Camera camera;
  const Box whole{{-60, 50}, {700, 500}};
  const Box box_px = ProjectedBox(BookAt(camera, whole), kView_cw, camera);
  EXPECT_THAT(box_px.min, VectorNear(Eigen::Vector2d(0, 50), 1e-9));
  EXPECT_EQ(box_px.max, camera.ImageBox().max);
}

TEST(BoxesOfMapPlanes, AreThoseOfTheCloudWhereAPartIsOutOfReach) {
  // A corner to the left of the picture comes first: where others cannot be projected it is not
  // counted, or the box would reach the picture's border.
  const Camera camera;
  const auto at = [&](const Eigen::Vector2d& u_px, double z_m) {
    return Eigen::Vector3d(Inverse(kView_cw) * camera.Backproject(u_px, z_m));
  };
  for (const bool has_corners : {true, false}) {  // else a hull
    for (const double z_m : {-0.5, 2.0}) {        // behind the camera, or far to the right
      MapPlane m;
      m.points_w = {at({120, 90}, 2.0), at({400, 310}, 1.5), at({250, 200}, 1.8)};
      m.points_w.push_back(at({2000, 200}, 1.5));
      m.points_w.push_back(at({200, 200}, -1.0));
      auto& outline_w = has_corners ? m.vertices_w : m.hull_w;
      outline_w = {at({-150, 40}, 2.0), at({300, 460}, 2.0), at({600, 400}, 2.0),
                   at({2000, 200}, z_m)};
      const Box box_px = ProjectedBox(m, kView_cw, camera);
      EXPECT_THAT(box_px.min, VectorNear(Eigen::Vector2d(120, 90), 1e-9)) << z_m;
      EXPECT_THAT(box_px.max, VectorNear(Eigen::Vector2d(400, 310), 1e-9)) << z_m;
      // None of the cloud in the picture: nothing of it is there.
      m.points_w.erase(m.points_w.begin(), m.points_w.begin() + 3);
      EXPECT_TRUE(ProjectedBox(m, kView_cw, camera).empty()) << z_m;
    }
  }
}

}  // namespace
}  // namespace slam
