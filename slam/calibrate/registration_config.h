#pragma once

#include "slam/base/field_visitor.h"

namespace slam {

/// What is done about depth that lies beside its colour (RegistrationLearner).
struct RegistrationConfig {
  bool learn = true;
  double min_shift_px = 0.75;  // less moves hardly an edge to another pixel
  double usual_px = 1.0;       // what usual calibrations leave, by axis (docs/sensors.md)
};

inline void VisitFields(RegistrationConfig& c, FieldVisitor& v) {
  v.Flag("learn", c.learn,
         "how far depth lies beside its colour is learnt from the edges of both, and taken out "
         "once it is known");
  v.Number("min_shift_px", c.min_shift_px, "[0, 100]", "smallest shift that is taken out");
  v.Number("usual_px", c.usual_px, "(0, 100]",
           "standard deviation of the shift that calibrations leave, by axis");
}

}  // namespace slam
