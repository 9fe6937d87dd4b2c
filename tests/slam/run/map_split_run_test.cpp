// The map's say in a run: what was told apart from near is told apart from afar.
#include <gtest/gtest.h>

#include <algorithm>

#include "slam/run/tracker.h"
#include "slam/segment/depth_sensor.h"
#include "tests/support/textured_world.h"

namespace slam {
namespace {

/// A plate of 0.28 m x 0.2 m, 9 mm before the printed wall at z = 2; depth alone knows of it.
struct PlateOnAWall {
  static constexpr double kStep_m = 0.009;
  Camera camera;
  TexturedCorner corner;
  cv::Mat1b mask;  ///< of the last view

  Frame See(double z_m, int index) {
    Pose T_cw;
    T_cw.t = {0, 0, -z_m};
    Frame frame = corner.See(camera, T_cw, index);
    mask.create(frame.depth_m.size());
    for (int v = 0; v < mask.rows; ++v) {
      for (int u = 0; u < mask.cols; ++u) {
        float& depth_m = frame.depth_m(v, u);
        const Eigen::Vector3d x_c = camera.Backproject({u, v}, static_cast<double>(depth_m));
        const bool on_wall = std::abs(x_c.z() + z_m - 2.0) < 1e-3;
        const bool on_plate = on_wall && std::abs(x_c.x()) < 0.14 && std::abs(x_c.y()) < 0.1;
        mask(v, u) = on_plate ? 255 : 0;
        if (on_plate) depth_m -= static_cast<float>(kStep_m);
      }
    }
    return frame;
  }
  double Iou(const Frame& frame) const {
    double best = 0.0;
    for (const FramePlane& plane : frame.planes) {
      const cv::Mat1b own = cv::Mat(frame.plane_labels == plane.index + 1);
      const double shared = cv::countNonZero(own & mask);
      best = std::max(best, shared / (cv::countNonZero(own) + cv::countNonZero(mask) - shared));
    }
    return best;
  }
};

/// IoU of the plate in the last of the views of a camera that goes away from it.
double PlateFromAfar(Variant variant, bool enabled) {
  PlateOnAWall plate;
  Config config;
  config.plane_extraction = ExtractionFor(DepthSensor::kD435);
  config.plane_extraction.map_split.enabled = enabled;
  Tracker tracker(plate.camera, config, variant, nullptr, 0, 1);
  double iou = 0.0;
  for (int i = 0; i < 30; ++i) {
    Frame frame = plate.See(1.3 - 0.03 * std::max(0, i - 8), i);
    const cv::Mat3b bgr(frame.gray.size(), cv::Vec3b(0, 0, 0));
    EXPECT_TRUE(tracker.TrackFrame(frame, bgr).tracked) << "frame " << i;
    iou = plate.Iou(frame);
    if (i == 8) {
      EXPECT_GT(iou, 0.8) << "it is no test if it is not found from near";
    }
  }
  return iou;
}

TEST(MapInARun, TellsApartFromAfarWhatWasToldApartFromNear) {
  EXPECT_LT(PlateFromAfar(Variant::kFull, false), 0.3) << "it is no test if it is found anyway";
  EXPECT_GT(PlateFromAfar(Variant::kFull, true), 0.8);
}

TEST(MapInARun, HasNoSayWithoutAssociation) {
  EXPECT_LT(PlateFromAfar(Variant::kNoAssociation, true), 0.3);
}

}  // namespace
}  // namespace slam
