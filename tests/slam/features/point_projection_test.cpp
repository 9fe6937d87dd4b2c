#include "slam/features/point_projection.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

namespace slam {
namespace {

/// A camera that stands beside the world's origin and is turned against it.
const Pose kTurned_cw{ExpSo3({0.3, -0.8, 0.5}), {0.4, -0.2, 0.7}};

/// A point 3 m down the ray of a pixel that was last seen along a view 20 degrees away.
MapPoint PointOnRay(const Camera& camera, const Eigen::Vector2d& u_px, double view_off_rad) {
  const Eigen::Vector3d p_c = 3.0 * camera.Backproject(u_px, 1.0).normalized();
  const Eigen::Vector3d axis = p_c.cross(Eigen::Vector3d::UnitY()).normalized();
  MapPoint point;
  point.id = 7;
  point.p_w = Inverse(kTurned_cw) * p_c;
  point.view_w = kTurned_cw.R.transpose() * (ExpSo3(view_off_rad * axis) * p_c / 3.0);
  point.max_distance_m = 3.0 * 1.2 * 1.2;  // octave 2 from 3 m
  point.min_distance_m = 1.0;
  return point;
}

TEST(QueryOfAPoint, SaysWhereInWhichOctavesAndHowFarAroundToLook) {
  const Camera camera;
  const Eigen::Vector2d u_px(500, 90);
  PointProjectionConfig config;
  const MapPoint aside = PointOnRay(camera, u_px, 0.35);
  const PointQuery query = QueryOf(aside, kTurned_cw, camera, FeatureScale{}, 3.0, config);
  ASSERT_EQ(query.point, 7);
  EXPECT_LT((query.u_px - u_px).norm(), 1e-9);
  EXPECT_EQ(query.min_octave, 1);
  EXPECT_EQ(query.max_octave, 3);
  EXPECT_NEAR(query.radius_px, config.radius_px * 3.0 * 1.44, 1e-9);

  const PointQuery straight =
      QueryOf(PointOnRay(camera, u_px, 0.01), kTurned_cw, camera, FeatureScale{}, 3.0, config);
  EXPECT_NEAR(straight.radius_px, config.straight_radius_px * 3.0 * 1.44, 1e-9);
}

TEST(QueryOfAPoint, IsNoneOutOfTheRangeOfItsScalesByMoreThanTheMargin) {
  const Camera camera;
  const auto found = [&](double min_m, double max_m) {
    MapPoint point = PointOnRay(camera, {200, 300}, 0.1);
    point.min_distance_m = min_m, point.max_distance_m = max_m;
    return QueryOf(point, kTurned_cw, camera, FeatureScale{}, 1.0, {}).point != kNone;
  };
  EXPECT_TRUE(found(3.0 * 1.19, 20.0));  // nearer than its nearest, within the margin
  EXPECT_FALSE(found(3.0 * 1.21, 20.0));
  EXPECT_TRUE(found(1.0, 3.0 / 1.19));
  EXPECT_FALSE(found(1.0, 3.0 / 1.21));
}

TEST(QueryOfAPoint, IsNoneFromBeyondSixtyDegreesOfItsMeanViewAndBehindTheCamera) {
  const Camera camera;
  const auto found = [&](double off_rad) {
    const MapPoint point = PointOnRay(camera, {400, 200}, off_rad);
    return QueryOf(point, kTurned_cw, camera, FeatureScale{}, 1.0, {}).point != kNone;
  };
  EXPECT_TRUE(found(M_PI / 3 - 0.01));
  EXPECT_FALSE(found(M_PI / 3 + 0.01));
  MapPoint behind = PointOnRay(camera, {400, 200}, 0.0);
  behind.p_w = Inverse(kTurned_cw) * Eigen::Vector3d(0, 0, -3);
  EXPECT_EQ(QueryOf(behind, kTurned_cw, camera, FeatureScale{}, 1.0, {}).point, kNone);
}

TEST(QueryOfAPoint, IsThereForAllThatTheRecordedImageShows) {
  Camera barrel;
  barrel.k1 = -0.2, barrel.k2 = 0.04;
  // Where the lens is undone, what is near the border lies beyond it.
  const auto found = [&](double ideal_u_px) {
    return QueryOf(PointOnRay(barrel, {ideal_u_px, 240}, 0.1), kTurned_cw, barrel,
                   FeatureScale{}, 1.0, {})
               .point != kNone;
  };
  EXPECT_LT(barrel.ProjectDistorted(barrel.Backproject({655, 240}, 1.0)).x(), 631);
  EXPECT_TRUE(found(655));
  EXPECT_FALSE(found(690));
  EXPECT_FALSE(found(2000));
}

// Its errors are two, or three with that of the depth: bounds that chance passes once in twenty.
TEST(AFeature, AgreesWithAPointByTheErrorsThatItHas) {
  const double by_pixel = -2 * std::log(0.05), by_depth_too = 7.815;
  const Camera camera;
  const FeatureScale scale;
  const Eigen::Vector3d p_c(0.3, -0.2, 2.0);
  for (const int octave : {0, 3}) {
    SCOPED_TRACE(octave);
    /// @param off2, disparity2  squared errors in the image and of the disparity, in variances
    const auto agrees = [&](double off2, std::optional<double> disparity2) {
      const double sigma_px = std::pow(scale.factor, octave);
      PointFeature feature;
      feature.octave = octave;
      feature.u_px =
          camera.Project(p_c) + std::sqrt(off2) * sigma_px * Eigen::Vector2d(0.6, -0.8);
      feature.depth_m = 0.0;
      if (disparity2) {
        const double there_px = scale.bf_px_m / p_c.z();
        feature.depth_m = scale.bf_px_m / (there_px + std::sqrt(*disparity2) * sigma_px);
      }
      return AgreesWith(feature, p_c, camera, scale);
    };
    EXPECT_TRUE(agrees(0.98 * by_pixel, std::nullopt));
    EXPECT_FALSE(agrees(1.02 * by_pixel, std::nullopt));
    EXPECT_TRUE(agrees(0.98 * by_depth_too, 0.0));
    EXPECT_FALSE(agrees(1.02 * by_depth_too, 0.0));
    EXPECT_TRUE(agrees(0.5 * by_depth_too, 0.48 * by_depth_too));
    EXPECT_FALSE(agrees(0.5 * by_depth_too, 0.52 * by_depth_too));
  }
}

}  // namespace
}  // namespace slam
