#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "sim/families/families.h"
#include "sim/motion/trajectory.h"
#include "slam/features/match_features.h"
#include "slam/features/point_features.h"
#include "slam/features/read_depths.h"
#include "slam/model/feature_scale.h"
#include "tests/support/live.h"

namespace {

/// A desk seen twice, as the Kinect sees it; and the depth as it is.
struct Views {
  slam::Camera camera;
  slam::Frame first, second;
  cv::Mat1f true_depth_m;  ///< of the first
  slam::Pose T_21;
};

Views LookTwice(std::uint64_t seed, int frames_apart) {
  const sim::Scene scene = sim::MakeScene("desk", seed);
  const auto path = sim::MakeTrajectory(scene, frames_apart + 1, 30, seed);
  sim::RigOptions rig;
  rig.sensor = sim::SensorKind::kKinect1Clean;
  rig.detector = sim::DetectorKind::kNone;
  sim::RigOptions exact = rig;
  exact.sensor = sim::SensorKind::kIdeal;
  const sim::Simulator simulator(scene, rig);
  const sim::Pose &one = path.front().T_wc, &two = path.back().T_wc;
  const double factor = rig.camera.depth_factor;
  Views views;
  views.camera = live::CameraOf(rig.camera);
  views.first = live::FrameOf(simulator.Simulate(0, one), 0, 0, factor);
  views.second = live::FrameOf(simulator.Simulate(frames_apart, two), 1, 1, factor);
  views.true_depth_m =
      live::FrameOf(sim::Simulator(scene, exact).Simulate(0, one), 0, 0, factor).depth_m;
  views.T_21 = live::PoseOf(two) * slam::Inverse(live::PoseOf(one));
  for (slam::Frame* frame : {&views.first, &views.second}) {
    frame->features = slam::ExtractPointFeatures(frame->gray, views.camera, {});
    slam::ReadDepths(frame->depth_m, views.camera, {}, {}, {}, frame->features);
  }
  return views;
}

/// Where what is at a pixel of the first view is in the second.
Eigen::Vector2d TrueFlow(const Views& views, const Eigen::Vector2d& u_px) {
  const double z_m = views.true_depth_m(static_cast<int>(std::lround(u_px.y())),
                                        static_cast<int>(std::lround(u_px.x())));
  return views.camera.Project(views.T_21 * views.camera.Backproject(u_px, z_m));
}

// Correspondences by descriptors alone, against where depth and poses say that they must be.
TEST(PointMatching, FindsTheTrueFlowBetweenTwoViewsOfADesk) {
  for (const auto& [frames_apart, least_pairs, least_share] :
       {std::tuple{5, 150, 0.97}, {30, 50, 0.9}}) {
    const Views views = LookTwice(11, frames_apart);
    const auto pairs =
        slam::MatchDescriptors(views.first.features, views.second.features, {}, {50, 0.75});
    int right = 0;
    double moved_px = 0;
    for (const slam::FeaturePair& pair : pairs) {
      const auto& f = views.first.features[static_cast<std::size_t>(pair.first)];
      const auto& g = views.second.features[static_cast<std::size_t>(pair.second)];
      const Eigen::Vector2d expected = TrueFlow(views, f.u_px);
      const double scale = slam::FeatureScale{}.Scale(std::max(f.octave, g.octave));
      right += (g.u_px - expected).norm() < 3.0 * scale;
      moved_px += (expected - f.u_px).norm();
    }
    const auto count = static_cast<double>(pairs.size());
    EXPECT_GE(count, least_pairs) << frames_apart;
    EXPECT_GE(right, least_share * count) << right << " of " << count << ", " << frames_apart;
    EXPECT_GE(moved_px, 5.0 * count) << "the views hardly differ";
  }
}

}  // namespace
