#pragma once

#include <string>
#include <vector>

#include "eval/formats/folder.h"
#include "eval/formats/pose/pose.h"
#include "io/text_table.h"

namespace eval {

/// What stamps of a trajectory do that go back (poses are sorted) or come again. Recorded truth
/// has some that come again (TUM's fr2/desk).
struct StampFaults {
  Severity disorder = Severity::kWarning;
  Severity repetition = Severity::kWarning;
};

/// Reads `t tx ty tz qx qy qz qw` lines (TUM): seconds, metres, T_wc, by rising stamp. Unit
/// quaternions are normalised once more, for their last digits.
Trajectory ReadTrajectory(Folder& folder, const std::string& file, StampFaults faults = {});
/// The same from records of the file that have been read already.
Trajectory ReadTrajectory(Folder& folder, const std::string& file,
                          const std::vector<io::TextRecord>& records, StampFaults faults);

/// Reads groundtruth.txt, which is optional, but not empty when it is there.
Trajectory ReadGroundtruth(Folder& folder);

}  // namespace eval
