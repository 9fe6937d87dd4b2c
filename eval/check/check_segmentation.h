#pragma once

#include "eval/formats/run/run.h"

namespace eval {

/// Checks the images of segmentation/, when the run has them: 8-bit, one size, one for each
/// frame, and no value but 0 and index + 1 of that frame's planes.
void CheckSegmentation(Folder& folder, const Run& run);

}  // namespace eval
