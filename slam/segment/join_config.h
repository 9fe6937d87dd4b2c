#pragma once

#include "slam/base/field_visitor.h"
#include "slam/geometry/sensor_model.h"

namespace slam {

/// When parts are one surface, which the sensor may bend.
struct JoinConfig {
  double bend_ratio = kKinectBend;
  double bend_length_rad = kBendLength_rad;
  // In bends: of a normal variable, 3 are passed 1 time in 400. With a sensor that does not bend
  // the bound on the smaller part counts most: without it d435 lost 0.036 of correct.
  double max_union_bends = 3.0;
  double max_part_bends = 5.0;
  double max_hidden_bends = 3.0;  // no border tells: with 4, tops 10 mm apart were joined
  double max_turn_bends = 7.0;    // of slopes, between strips that are nearly a length apart
  double max_gap_sigmas = 1.5;
  // The sensor's own steps of depth are about one sigma high. The mean square counts, so a step
  // along a part of the border does too.
  double max_step_sigmas = 3.0;
};

inline void VisitFields(JoinConfig& c, FieldVisitor& v) {
  v.Number("bend_ratio", c.bend_ratio, "[0, 0.05]",
           "root mean square of what the sensor bends flat things by, as a part of the depth; "
           "0: nothing");
  v.Degrees("bend_length_deg", c.bend_length_rad, "(0, 90)",
            "angle of view over which the bend changes by its own size");
  v.Number("max_union_bends", c.max_union_bends, "(0, inf)",
           "largest deviation (root mean square) of a surface from its plane, in bends");
  v.Number("max_part_bends", c.max_part_bends, "(0, inf)",
           "the same of the smaller of two parts that touch");
  v.Number("max_hidden_bends", c.max_hidden_bends, "(0, inf)",
           "the same of two parts that something in front separates");
  v.Number("max_turn_bends", c.max_turn_bends, "(0, inf)",
           "largest change of slope where two parts meet, in bends over their length");
  v.Number("max_gap_sigmas", c.max_gap_sigmas, "(0, inf)",
           "deviation allowed beside the bend, in standard deviations of a pixel");
  v.Number("max_step_sigmas", c.max_step_sigmas, "(0, inf)",
           "largest step (root mean square along the border) where two parts meet, in standard "
           "deviations of a pixel");
}

}  // namespace slam
