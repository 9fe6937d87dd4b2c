#pragma once

#include "property_tests/generators/poses.h"
#include "slam/segment/plane_segments.h"
#include "tests/support/closed_form_depth.h"
#include "tests/support/depth_planes.h"

/// Exact depth of drawn scenes, and the planes that are extracted from it.
namespace slam {

inline Frame Extract(const cv::Mat1f& depth_m, const Camera& camera,
                     const SensorModel& sensor = {}) {
  Frame frame = closed_form::MakeFrame(depth_m);
  ExtractPlanes(frame, PixelRays(camera), {}, sensor);
  return frame;
}

/// Their tops are 10 mm apart at least: two at one height are one surface where nothing is seen
/// between them.
inline closed_form::World AnyBoxes() {
  closed_form::World world = closed_form::Desk();
  for (int k = AnyInt(1, 2); k > 0; --k) {
    const double top_m = AnyReal(0.01, 0.05) + 0.05 * k;
    closed_form::PutOnDesk(world, 0.22 * k - 0.33, AnyReal(-0.05, 0.05),
                           {AnyReal(0.1, 0.16), AnyReal(0.1, 0.2), top_m}, AnyReal(0.0, 1.0),
                           "box");
  }
  return world;
}

inline closed_form::View ViewOf(const closed_form::World& world, const Camera& camera) {
  const double height = AnyReal(0.6, 0.9), x = AnyReal(-0.15, 0.15);
  return closed_form::Render(world, camera, closed_form::LookAt({x, -0.4, height}, {0, 0, 0}));
}

}  // namespace slam
