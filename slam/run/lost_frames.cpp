#include "slam/run/lost_frames.h"

#include "slam/run/text_number.h"

namespace slam {

void LostFrames::See(double timestamp_s, bool tracked) {
  const int frame = frames_++;
  if (tracked) {
    lost_in_a_row_ = 0;
    return;
  }
  if (lost_in_a_row_++ == 0) last_frame_ = frame, last_gap_s_ = timestamp_s;
  if (lost_++ == 0) first_frame_ = frame, first_gap_s_ = timestamp_s;
}

std::string LostFrames::Warning() const {
  if (lost_ == 0 || lost_ == frames_) return {};
  const std::string share =
      std::to_string(lost_) + " of " + std::to_string(frames_) + " frames are not tracked";
  const auto place = [](int frame, double s) {
    return "frame " + std::to_string(frame) + " (" + StampText(s) + " s)";
  };
  return ended_lost() ? share + "; the camera is lost since " +
                            place(last_frame_, last_gap_s_) + " and was not found again"
                      : share + ", the first of them " + place(first_frame_, first_gap_s_);
}

}  // namespace slam
