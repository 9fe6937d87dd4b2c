#pragma once

#include <string>

namespace slam {

/// Counts the frames of a run that are not tracked.
class LostFrames {
 public:
  /// Ask of each frame once, in order.
  void See(double timestamp_s, bool tracked);

  /// Whether the last frame is not tracked.
  bool ended_lost() const { return lost_in_a_row_ > 0; }
  /// How many are not tracked, and since when; empty when all are, and when none is: then
  /// tracking never started.
  std::string Warning() const;

 private:
  int frames_ = 0, lost_ = 0, lost_in_a_row_ = 0;
  int first_frame_ = 0, last_frame_ = 0;         ///< where the first and the last gap begin
  double first_gap_s_ = 0.0, last_gap_s_ = 0.0;  ///< when they do
};

}  // namespace slam
