#pragma once

#include "slam/base/field_visitor.h"
#include "slam/geometry/sensor_model.h"

namespace slam {

/// When parts are one surface, which the sensor may bend.
struct JoinConfig {
  double bend_ratio = kKinectBend;
  double bend_length_rad = kBendLength_rad;
  double max_seen_ratio = 1.2;
  // What two parts of one surface are apart, root mean square: measured on simulated surfaces that
  // something hides in part, with and without bends.
  double union_bends = 0.55, union_gap_sigmas = 0.17;
  double max_union_chi2 = 100.0;  // parts may be curved as a whole: their border tells more
  double max_hidden_cost = 6.0;
  double max_turn_bends = 7.0;  // of slopes, between strips that are nearly a length apart
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
  v.Number("max_seen_ratio", c.max_seen_ratio, "(0, inf)",
           "largest bend that is believed of a frame's large surfaces, in bends");
  v.Number("union_bends", c.union_bends, "[0, inf)",
           "what parts of one surface are apart by the bend (root mean square), in bends");
  v.Number("union_gap_sigmas", c.union_gap_sigmas, "[0, inf)",
           "the same by other errors, in standard deviations of a pixel");
  v.Number("max_union_chi2", c.max_union_chi2, "(0, inf)",
           "largest chi-square (3 degrees of freedom) of one plane for two parts that touch");
  v.Number("max_hidden_cost", c.max_hidden_cost, "[-100, 100]",
           "largest -2 log likelihood of one plane for two parts that something in front "
           "separates, and whose chi-square 99.9 % of such parts stay below");
  v.Number("max_turn_bends", c.max_turn_bends, "(0, inf)",
           "largest change of slope where two parts meet, in bends over their length");
  v.Number("max_step_sigmas", c.max_step_sigmas, "(0, inf)",
           "largest step (root mean square along the border) where two parts meet, in standard "
           "deviations of a pixel");
}

}  // namespace slam
