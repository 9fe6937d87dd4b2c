#pragma once

namespace sim {

/// What goes wrong with time in a real recording; nothing by default.
struct TimingDefects {
  double drop_ratio = 0;    ///< share of frames lost, in [0, 1); never the first
  double repeat_ratio = 0;  ///< share of frames that show the one before again; never the first
  double depth_offset_s = 0;  ///< depth is exposed, and stamped, this much after colour
  double stamp_jitter_s = 0;  ///< sd of the stamps about the time of exposure

  bool IsNone() const {
    return drop_ratio == 0 && repeat_ratio == 0 && depth_offset_s == 0 && stamp_jitter_s == 0;
  }
};

}  // namespace sim
