#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <bitset>

#include "property_tests/generators/poses.h"
#include "slam/features/match_features.h"
#include "slam/features/point_spread.h"
#include "slam/mapping/point_triangulation.h"
#include "slam/tracking/motion_model.h"

namespace slam {
namespace {

Descriptor AnyBits() {
  Descriptor descriptor;
  for (auto& byte : descriptor) byte = static_cast<std::uint8_t>(AnyInt(0, 255));
  return descriptor;
}

std::vector<PointFeature> AnyFeatures(int count, const Camera& camera) {
  std::vector<PointFeature> features(static_cast<std::size_t>(count));
  for (PointFeature& feature : features) {  // undistorted, so some lie outside the image
    feature.u_px = {AnyReal(-30, camera.width + 30.0), AnyReal(-30, camera.height + 30.0)};
    feature.octave = AnyInt(0, 7);
  }
  return features;
}

RC_GTEST_PROP(DescriptorDistanceLaws, IsAMetricThatCountsBits, ()) {
  const Descriptor a = AnyBits(), b = AnyBits(), c = AnyBits();
  int bits = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    bits += static_cast<int>(std::bitset<8>(static_cast<unsigned>(a[i] ^ b[i])).count());
  }
  RC_ASSERT(DescriptorDistance(a, b) == bits);
  RC_ASSERT(DescriptorDistance(b, a) == bits);
  RC_ASSERT(DescriptorDistance(a, a) == 0);
  RC_ASSERT(DescriptorDistance(a, c) <= bits + DescriptorDistance(b, c));
}

RC_GTEST_PROP(FeatureGridLaws, FindsWhatLookingAtEveryFeatureFinds, ()) {
  Camera camera;
  camera.width = AnyInt(64, 640);
  camera.height = AnyInt(48, 480);
  const auto features = AnyFeatures(AnyInt(0, 80), camera);
  const FeatureGrid grid(features, camera);
  const Eigen::Vector2d u_px(AnyReal(-50, camera.width + 50.0),
                             AnyReal(-50, camera.height + 50.0));
  const double radius_px = AnyReal(0, 100);
  const int low = AnyInt(0, 7), high = AnyInt(low, 7);
  std::vector<int> expected;
  for (int i = 0; i < static_cast<int>(features.size()); ++i) {
    const PointFeature& f = features[static_cast<std::size_t>(i)];
    const Eigen::Vector2d away = (f.u_px - u_px).cwiseAbs();
    if (away.maxCoeff() <= radius_px && f.octave >= low && f.octave <= high) {
      expected.push_back(i);
    }
  }
  std::vector<int> found = grid.Near(u_px, radius_px, low, high);
  std::sort(found.begin(), found.end());
  RC_ASSERT(found == expected);
}

RC_GTEST_PROP(PointSpreadLaws, GivesDistinctCandidatesAndNoMoreThanTwoTooMany, ()) {
  const int width = AnyInt(20, 600), height = AnyInt(20, 600);
  std::vector<cv::KeyPoint> candidates(static_cast<std::size_t>(AnyInt(0, 300)));
  for (int i = 0; i < static_cast<int>(candidates.size()); ++i) {
    cv::KeyPoint& point = candidates[static_cast<std::size_t>(i)];
    point.pt = {static_cast<float>(AnyInt(0, width - 1)),
                static_cast<float>(AnyInt(0, height - 1))};
    point.response = static_cast<float>(AnyInt(1, 200));
    point.class_id = i;
  }
  const int count = AnyInt(1, 200);
  const auto kept = SpreadEvenly(candidates, {0, 0, width, height}, count);
  // A wide area starts with several cells side by side, which may be more than wanted.
  const int first_cells = std::max(1, cvRound(static_cast<double>(width) / height));
  RC_ASSERT(static_cast<int>(kept.size()) <= std::max(count + 2, first_cells));
  RC_ASSERT(kept.empty() == candidates.empty());
  for (std::size_t i = 1; i < kept.size(); ++i) {
    RC_ASSERT(kept[i - 1].class_id < kept[i].class_id);
  }
}

RC_GTEST_PROP(TriangulationLaws, MeetsEveryPointThatBothCamerasSeeWithParallax, ()) {
  const Camera camera;
  const Eigen::Vector3d p_w(AnyReal(-0.5, 0.5), AnyReal(-0.4, 0.4), AnyReal(1.0, 4.0));
  const Pose T_1w = AnyMotion(0.2, 0.1), T_2w = AnyMotion(0.2, 0.3);
  constexpr double kMinParallax_rad = 0.02;
  const auto met = Triangulate(camera.Project(T_1w * p_w), T_1w, camera.Project(T_2w * p_w),
                               T_2w, camera, kMinParallax_rad);
  const Eigen::Vector3d a = Inverse(T_1w).t - p_w, b = Inverse(T_2w).t - p_w;
  const double parallax_rad = std::atan2(a.cross(b).norm(), a.dot(b));
  if (parallax_rad > 1.01 * kMinParallax_rad) RC_ASSERT(met.has_value());
  if (parallax_rad < 0.99 * kMinParallax_rad) RC_ASSERT(!met.has_value());
  // Round-off of 1e-13 px, divided by the square of the parallax.
  if (met) RC_ASSERT((*met - p_w).norm() < 1e-9);
}

RC_GTEST_PROP(MotionModelLaws, PredictsTheSameWhereverTheWorldOriginLies, ()) {
  const Pose T_0w = AnyPose(3), step = AnyMotion(0.3, 0.3), T_wv = AnyPose(3);
  MotionModel here, there;
  here.Observe(0, T_0w);
  here.Observe(1, step * T_0w);
  there.Observe(0, T_0w * T_wv);
  there.Observe(1, step * T_0w * T_wv);
  const Pose expected = *here.Predict(2) * T_wv, found = *there.Predict(2);
  RC_ASSERT(RotationAngle(expected, found) < 1e-10);
  RC_ASSERT((expected.t - found.t).norm() < 1e-10);
}

}  // namespace
}  // namespace slam
