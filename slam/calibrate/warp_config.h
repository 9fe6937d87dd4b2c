#pragma once

#include <string>

#include "slam/base/field_visitor.h"

namespace slam {

/// What is expected of a device that bends what is flat, before any of its depth is seen, and
/// where its warp comes from.
struct DepthWarpConfig {
  std::string source = "auto";  ///< "off", "auto", or the path of a warp file
  bool Learns() const { return source == "auto"; }

  // Those of a first Kinect, measured on a recording (docs/sensors.md).
  double bend_rms = 0.0033;
  double drift_share = 0.25;
  double reach_x_px = 30.0;  // correlation 0.44 after 32 pixels
  double reach_y_px = 68.0;  // 0.8 after 32 pixels, 0.2 after 112
};

inline void VisitFields(DepthWarpConfig& c, FieldVisitor& v) {
  v.Text("source", c.source,
         "off; auto: learnt from the planes of the run and applied once it is worth it; or a "
         "file of pas calibrate");
  v.Number("bend_rms", c.bend_rms, "(0, 0.1]",
           "expected bend of a device, root mean square, as a part of the depth");
  v.Number("drift_share", c.drift_share, "(0, 0.9]",
           "share of the bend's power that changes from second to second");
  v.Number("reach_x_px", c.reach_x_px, "[5, 1000]",
           "reach of the bend's correlation along x, at a focal length of 525 pixels");
  v.Number("reach_y_px", c.reach_y_px, "[5, 1000]", "the same along y");
}

}  // namespace slam
