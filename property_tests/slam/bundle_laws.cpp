#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "property_tests/generators/poses.h"
#include "slam/mapping/local_bundle.h"
#include "tests/support/point_world.h"

namespace slam {
namespace {

/// Moves points, and all keyframes but the first, by up to so much.
void Disturb(Map& map, double max_m, double max_rad) {
  for (Keyframe& keyframe : map.keyframes) {
    if (keyframe.id > 0) keyframe.T_cw = AnyMotion(max_rad, max_m) * keyframe.T_cw;
  }
  const int seed = AnyInt(0, 1 << 20);
  Random random{static_cast<std::uint64_t>(seed)};
  for (MapPoint& point : map.points) {
    for (int i = 0; i < 3; ++i) point.p_w[i] += max_m * (2 * random.Uniform() - 1);
  }
}

PointWorld AnyWorld() {
  return MakePointWorld(AnyInt(2, 5), AnyInt(80, 160),
                        static_cast<std::uint64_t>(AnyInt(0, 1 << 20)), AnyInt(1, 3));
}

RC_GTEST_PROP(LocalBundleLaws, FindsTheTrueMapAgainFromADisturbedOne, ()) {
  const PointWorld truth = AnyWorld();
  Map map = truth.map;
  Disturb(map, 0.004, 0.003);
  LocalBundleConfig config;
  config.last_iterations = 30;
  const int newest = static_cast<int>(map.keyframes.size()) - 1;
  RC_ASSERT(AdjustLocalBundle(map, newest, truth.camera, FeatureScale{}, config).usable);
  for (const Keyframe& keyframe : map.keyframes) {
    const Pose& T_cw = truth.map.keyframes[static_cast<std::size_t>(keyframe.id)].T_cw;
    RC_ASSERT(RotationAngle(keyframe.T_cw, T_cw) < 1e-4);
    RC_ASSERT((keyframe.T_cw.t - T_cw.t).norm() < 1e-4);
  }
}

// The estimate may depend on where the world's origin lies by no more than the solver's
// round-off.
RC_GTEST_PROP(LocalBundleLaws, MovesTheMapTheSameWayWhereverTheWorldOriginLies, ()) {
  const PointWorld truth = AnyWorld();
  Map here = truth.map;
  Disturb(here, 0.004, 0.003);
  Map there = here;
  const Pose T_vw = AnyPose(2), T_wv = Inverse(T_vw);
  for (Keyframe& keyframe : there.keyframes) keyframe.T_cw = keyframe.T_cw * T_wv;
  for (MapPoint& point : there.points) point.p_w = T_vw * point.p_w;
  const int newest = static_cast<int>(here.keyframes.size()) - 1;
  LocalBundleConfig config;
  config.last_iterations = 30;
  AdjustLocalBundle(here, newest, truth.camera, FeatureScale{}, config);
  AdjustLocalBundle(there, newest, truth.camera, FeatureScale{}, config);
  for (std::size_t k = 0; k < here.keyframes.size(); ++k) {
    const Pose expected = here.keyframes[k].T_cw * T_wv;
    RC_ASSERT(RotationAngle(expected, there.keyframes[k].T_cw) < 1e-4);
    RC_ASSERT((expected.t - there.keyframes[k].T_cw.t).norm() < 3e-4);
  }
}

}  // namespace
}  // namespace slam
