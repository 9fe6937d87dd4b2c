#pragma once

#include "slam/base/field_visitor.h"

namespace slam {

/// What is done about a rolling shutter (RollingLearner).
struct RollingConfig {
  bool learn = true;
  // Colour cameras read for most of the time between two images: 26 ms a first Kinect's (Ringaby and
  // Forssen, ICCV workshops 2011), none at all with a global shutter.
  double usual_s = 0.015;
};

inline void VisitFields(RollingConfig& c, FieldVisitor& v) {
  v.Flag(
      "learn", c.learn,
      "how long the colour camera takes from its first row to its last is learnt from points, "
      "and each row is told at its own time");
  v.Number("usual_s", c.usual_s, "(0, 1]",
           "standard deviation of that time over cameras, from none");
}

}  // namespace slam
