#pragma once

#include <functional>
#include <map>
#include <optional>
#include <vector>

#include "eval/formats/run/run.h"
#include "eval/planes/overlap.h"
#include "eval/planes/true_frame.h"

namespace eval {

/// Everything that is known about one frame of a run.
struct FrameEvidence {
  int number = 0;  ///< in the sequence, from 0
  TrueFrame truth;
  std::vector<RunFramePlane>
      planes;                   ///< of a run of labels alone they have an index and pixels
  std::map<int, int> truth_of;  ///< by index of the frame plane
  /// Ids of true planes with labels of the segmentation, where pixels decide the truth.
  std::optional<LabelPairs> pairs;

  int TruthOf(const RunFramePlane& plane) const;
  /// A scored plane that is too small or too slanted to be asked for: found or not, it is no
  /// mistake.
  bool Ignored(int truth_id) const;
};

/// The run put the plane on a map plane, known or new.
bool Decided(const RunFramePlane& plane);

/// Pixels by truth and machine label of the frame without what is ignored. `label_of` gives the machine
/// label of a frame plane, 0 to leave it out.
LabelPairs PairsOf(const FrameEvidence& e,
                   const std::function<int(const RunFramePlane& plane)>& label_of);

/// Whether truth of frame planes is decided by their pixels (else by their geometry).
bool DecidedByPixels(const Run& run, const Sequence& sequence);

/// Hands over each frame of the sequence with a true pose, by rising time. One that the run says
/// nothing about has no planes.
/// @param sequence  with gt/scene.json and groundtruth.txt, its faces united
/// @throws InputError for images that cannot be read or differ in size
void VisitEvidence(const Run& run, const Sequence& sequence,
                   const std::function<void(const FrameEvidence&)>& visit);

}  // namespace eval
