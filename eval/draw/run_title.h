#pragma once

#include <string>

#include "eval/formats/run/run.h"
#include "eval/formats/sequence/sequence.h"

namespace eval {

/// What the title line of every picture says of a run.
struct RunTitle {
  std::string run;       ///< name of the run's folder
  std::string sequence;  ///< name of the sequence's folder
  std::string figures;   ///< "variant full   tracked 36 of 37 frames"
  std::string
      warning;  ///< "interrupted after 120 of 300 frames", "nothing was tracked"; or empty
};
RunTitle TitleOf(const Run& run, const Sequence& sequence);

}  // namespace eval
