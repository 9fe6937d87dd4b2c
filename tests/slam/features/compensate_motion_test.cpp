#include "slam/features/compensate_motion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "slam/features/point_features.h"
#include "slam/features/read_depths.h"
#include "tests/support/textured_world.h"

namespace slam {
namespace {

Vector6d Speed(double vx, double vy, double vz, double wx, double wy, double wz) {
  Vector6d speed;
  speed << vx, vy, vz, wx, wy, wz;
  return speed;
}

/// A frame that was read while the camera moved so, before a slanted wall or with no depth.
Frame ReadAt(const Vector6d& speed, const Camera& camera, bool has_depth) {
  Frame frame;
  frame.gray = BlockPattern(640, 5)(cv::Rect(0, 0, 640, 480)).clone();
  if (has_depth) {
    frame.depth_m.create(480, 640);
    for (int v = 0; v < 480; ++v) {
      for (int u = 0; u < 640; ++u)
        frame.depth_m(v, u) = 1.5f + 0.0005f * static_cast<float>(u);
    }
  }
  frame.speed.mean = speed;
  frame.depth_late_s = 0.015;
  frame.readout.taken_out_s = 0.03;
  frame.readout.speed = speed;
  frame.features = ExtractPointFeatures(frame.gray, camera, {});
  ReadDepths(frame.depth_m, camera, {}, frame.T_dc(), frame.readout, frame.features);
  return frame;
}

Camera Lens() {
  Camera camera = CameraOfSize(640, 480);
  camera.k1 = 0.1, camera.k2 = -0.05;
  return camera;
}

const Vector6d kPredicted = Speed(0.4, -0.3, 0.2, 0.5, -0.8, 1.0);
const Vector6d kFound = Speed(0.3, -0.2, 0.3, 0.7, -0.6, 0.8);

TEST(CompensateMotion, GivesWhatExtractionAtThatSpeedWouldHave) {
  const Camera camera = Lens();
  for (const bool has_depth : {true, false}) {
    Frame frame = ReadAt(kPredicted, camera, has_depth);
    const std::vector<PointFeature> before = frame.features;
    EXPECT_TRUE(CompensateMotion(camera, kFound, frame));
    const std::vector<PointFeature> expected = ReadAt(kFound, camera, has_depth).features;
    ASSERT_EQ(frame.features.size(), expected.size());
    double moved_px = 0.0;
    int measured = 0;
    for (std::size_t i = 0; i < expected.size(); ++i) {
      const PointFeature &f = frame.features[i], &e = expected[i];
      if ((f.depth_m > 0) != (e.depth_m > 0)) continue;  // at the image's border
      EXPECT_LT((f.u_px - e.u_px).norm(), 0.02);
      // Depth is read at another pixel of the wall, which changes by half a millimetre a pixel.
      EXPECT_NEAR(f.depth_m, e.depth_m, 0.003);
      moved_px = std::max(moved_px, (f.u_px - before[i].u_px).norm());
      measured += f.depth_m > 0;
    }
    EXPECT_GT(moved_px, 2.0);
    EXPECT_GT(measured, has_depth ? 500 : -1);
    EXPECT_EQ(frame.speed.mean, kFound);
    EXPECT_EQ(frame.readout.speed, kFound);
  }
}

// A shutter that reads all rows at once may have depth that is late, and the other way round.
TEST(CompensateMotion, MovesAFrameInWhichOneOfTheTwoTakesItsTime) {
  const Camera camera = Lens();
  for (const bool late : {true, false}) {
    Frame frame = ReadAt(kPredicted, camera, true);
    if (late) {
      frame.readout.taken_out_s = 0.0;
    } else {
      frame.depth_late_s = 0.0;
    }
    const std::vector<PointFeature> before = frame.features;
    ASSERT_TRUE(CompensateMotion(camera, kFound, frame));
    double moved_px = 0.0, moved_m = 0.0;
    for (std::size_t i = 0; i < before.size(); ++i) {
      moved_px = std::max(moved_px, (frame.features[i].u_px - before[i].u_px).norm());
      moved_m = std::max(moved_m, std::abs(frame.features[i].depth_m - before[i].depth_m));
    }
    // Depth that is late is that of another time, rows only show it elsewhere.
    EXPECT_EQ(moved_m > 1e-3, late) << moved_m;
    EXPECT_EQ(moved_px < 1e-9, late) << moved_px;
    EXPECT_EQ(moved_px > 1.0, !late) << moved_px;
  }
}

TEST(CompensateMotion, LeadsBackToWhereItBegan) {
  const Camera camera = Lens();
  Frame frame = ReadAt(kPredicted, camera, true);
  const std::vector<PointFeature> before = frame.features;
  CompensateMotion(camera, kFound, frame);
  CompensateMotion(camera, kPredicted, frame);
  ASSERT_FALSE(before.empty());
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_LT((frame.features[i].u_px - before[i].u_px).norm(), 1e-3);
    EXPECT_NEAR(frame.features[i].depth_m, before[i].depth_m, 1e-5);
  }
}

TEST(CompensateMotion, LeavesAFrameOfOneMomentAsItIs) {
  const Camera camera = Lens();
  Frame frame = ReadAt(kPredicted, camera, true);
  frame.readout.taken_out_s = 0.0, frame.depth_late_s = 0.0;
  const std::vector<PointFeature> before = frame.features;
  EXPECT_FALSE(CompensateMotion(camera, kFound, frame));
  ASSERT_FALSE(before.empty());
  for (std::size_t i = 0; i < before.size(); ++i)
    EXPECT_EQ(frame.features[i].u_px, before[i].u_px);
}

}  // namespace
}  // namespace slam
