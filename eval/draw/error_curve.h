#pragma once

#include <optional>
#include <string>
#include <vector>

#include "eval/formats/run/run.h"
#include "eval/formats/sequence/sequence.h"

namespace eval {

/// How the run was laid on the truth before positions were compared.
enum class ErrorAlignment {
  kPositions,  ///< rigidly by positions, as for the ATE
  kPoses,      ///< by whole poses: the ATE is not defined, fewer than 3 positions or a line
  kNothingTracked,  ///< not at all: the run has no pose
  kNoSharedTime,    ///< not at all: no pose of the run is of the time of a true one
  kNotFinite,       ///< not at all: the errors are beyond what a picture can show
};
/// Says in a sentence how, or why not.
std::string Explain(ErrorAlignment alignment);

/// Errors of one pose.
struct ErrorSample {
  double time_s = 0;  ///< since the first frame
  double position_mm = 0;
  double rotation_deg = 0;
};

/// Why a span of time has no errors.
enum class Gap {
  kLost,     ///< the run has no pose
  kNotRun,   ///< the run was interrupted before
  kNoTruth,  ///< the run has poses, the truth has none
};
struct GapSpan {
  Gap gap = Gap::kLost;
  double from_s = 0, to_s = 0;  ///< since the first frame
  int frames = 0;
};

/// The errors of a run over time, and where there are none.
struct ErrorCurve {
  double duration_s = 0;  ///< from the first to the last frame; above 0
  int frames = 0;         ///< of the sequence
  ErrorAlignment alignment = ErrorAlignment::kNothingTracked;
  std::vector<ErrorSample> samples;  ///< by rising time; empty where not aligned
  std::vector<GapSpan> gaps;         ///< by rising time; they do not overlap
};

/// Position errors after the alignment of positions that the ATE uses (of whole poses where
/// that is not defined), rotation errors after the mean rotation is taken out (AlignByPoses).
/// Nothing for a sequence without true poses or with fewer than 2 frames.
std::optional<ErrorCurve> ErrorsOverTime(const Run& run, const Sequence& sequence);

}  // namespace eval
