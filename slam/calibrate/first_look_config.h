#pragma once

#include "slam/base/field_visitor.h"

namespace slam {

/// What is learnt of the device before a recording is run.
struct FirstLookConfig {
  int frames = 300;  // 10 s: shorter looks are worse by a tenth (docs/calibration.md)
};

inline void VisitFields(FirstLookConfig& c, FieldVisitor& v) {
  v.Integer(
      "frames", c.frames, "[0, 10000000]",
      "frames of a recording that are looked at before it is run to learn its depth_warp, "
      "depth_registration and rolling_shutter; 0: these are learnt on the way alone, as "
      "with a live camera");
}

}  // namespace slam
