#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <vector>

#include "sim/families/families.h"
#include "sim/motion/trajectory.h"
#include "slam/run/tracker.h"
#include "tests/support/live.h"

namespace {

/// How a simulated desk's boxes were carried over the frames in which nobody asked for them.
struct Carried {
  int true_boxes = 0;
  int found = 0;       ///< carried with IoU of 0.5 or more, in the right class
  double sum_iou = 0;  ///< of those
  int invented = 0;    ///< carried, and 0.5 of no true box of the class
};

double BestIou(const slam::Detection& box, const std::vector<slam::Detection>& others) {
  double best = 0;
  for (const slam::Detection& other : others) {
    if (other.class_name == box.class_name) {
      best = std::max(best, slam::Iou(other.box_px, box.box_px));
    }
  }
  return best;
}

/// A camera in a hand moves about a desk of which a perfect detector is asked in every Nth frame.
void CarryOverDesk(std::uint64_t seed, int every, Carried& carried) {
  constexpr int kDetectedFrames = 60;
  const sim::Scene scene = sim::MakeScene("desk", seed);
  sim::RigOptions rig;
  rig.camera = sim::Resize(sim::Camera{}, 320, 240);
  rig.sensor = sim::SensorKind::kKinect1Clean;
  rig.detector = sim::DetectorKind::kPerfect;
  const sim::Simulator simulator(scene, rig);
  const slam::Camera camera = live::CameraOf(rig.camera);
  slam::Config config;
  config.detection.every = every;
  std::vector<slam::Detection> told;
  slam::Tracker tracker(camera, config, slam::Variant::kFull,
                        std::make_unique<live::ToldDetector>(told), 0, 1);
  const auto path = sim::MakeTrajectory(scene, kDetectedFrames, 30, seed);
  for (int i = 0; i < kDetectedFrames; ++i) {
    const sim::TimedPose& at = path[static_cast<std::size_t>(i)];
    const sim::SimulatedFrame simulated = simulator.Simulate(i, at.T_wc);
    told = live::DetectionsOf(simulated);
    slam::Frame frame = live::FrameOf(simulated, i, at.timestamp_s, camera.depth_factor);
    tracker.TrackFrame(frame, simulated.colour);
    if (frame.detector_asked || i < every) continue;
    for (const slam::Detection& truth : told) {
      const double iou = BestIou(truth, frame.detections);
      ++carried.true_boxes;
      if (iou < 0.5) continue;
      ++carried.found;
      carried.sum_iou += iou;
    }
    for (const slam::Detection& box : frame.detections) {
      carried.invented += BestIou(box, told) < 0.5;
    }
  }
}

TEST(DetectEvery, CarriesTheBoxesOfASimulatedDeskToWhereTheObjectsAre) {
  Carried carried;
  for (const std::uint64_t seed : {101u, 102u, 103u}) CarryOverDesk(seed, 5, carried);
  const double mean_iou = carried.sum_iou / carried.found;
  std::printf("%d true boxes, %d carried, mean IoU %.3f, %d where nothing is\n",
              carried.true_boxes, carried.found, mean_iou, carried.invented);
  ASSERT_GT(carried.true_boxes, 500);
  EXPECT_GT(carried.found, 0.9 * carried.true_boxes);
  EXPECT_GT(mean_iou, 0.85);
  EXPECT_LT(carried.invented, 0.1 * carried.true_boxes);
}

}  // namespace
