#pragma once

namespace sim {

/// How the colour camera exposes a frame. Nothing by default: an instant, all rows at once.
struct Exposure {
  double shutter_s = 0;     ///< open this long about the frame's time: motion blur
  int shutter_samples = 8;  ///< poses that a blurred frame averages, evenly over the shutter
  double rolling_s = 0;     ///< the last row is exposed this much after the first
  double drift_stops = 0;   ///< auto-exposure: gain wanders within +- this, by powers of two

  bool Moves() const { return shutter_s > 0 || rolling_s != 0; }
  bool IsPlain() const { return !Moves() && drift_stops == 0; }
};

}  // namespace sim
