#pragma once

#include <future>
#include <optional>
#include <string>
#include <vector>

#include "slam/input/frame_gate.h"
#include "slam/input/frame_source.h"
#include "slam/input/repeated_images.h"
#include "slam/model/frame.h"
#include "slam/model/module_times.h"
#include "slam/run/tracker.h"

namespace slam {

/// A frame before it is tracked.
struct FrameAhead {
  bool taken = false;    ///< by the gate
  bool repeats = false;  ///< the images of the one before; then nothing is extracted
  Frame frame;
  ModuleTimes times;
};

/// The frames of a recording on their way to a tracker. While one is tracked, the next is read and
/// extracted on another thread; with what the tracker knew before either, so that the number of
/// threads changes nothing.
class FramesAhead {
 public:
  /// @param count    frames of the source, from its first
  /// @param tracker  that they are for; Extract is called by nobody else
  /// @param threads  1, or more: the next frame is then made while the caller has this one
  FramesAhead(FrameSource& source, int count, const Camera& camera, Tracker& tracker,
              int threads);

  /// The next frame; none: there are no more. @throws InputError when it cannot be read
  std::optional<FrameAhead> Next();
  /// Frames that Next has given.
  int given() const { return given_; }
  /// Whether there are frames that were not begun.
  bool MayGoOn() const { return begun_ < count_; }
  /// No more frames are begun.
  void Stop() { count_ = begun_; }

  /// Of all frames given: how many repeat the images of the one before, and what the gate has
  /// left out.
  int repeats() const { return repeated_.count(); }
  std::vector<std::string> Warnings() const { return gate_.Warnings(); }

 private:
  void Begin();
  FrameAhead ReadAndExtract(int i, const Straightening& straightening);

  FrameSource& source_;
  int count_;
  Tracker& tracker_;
  int threads_;
  int begun_ = 0, given_ = 0;
  FrameGate gate_;
  RepeatedImages repeated_;
  int indices_ = 0;  ///< of frames that the tracker is given: taken by the gate, and no repeats
  std::future<FrameAhead> ahead_;  ///< last: its thread uses the rest
};

}  // namespace slam
