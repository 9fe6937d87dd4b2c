#pragma once

#include <string>
#include <vector>

#include "slam/input/sequence_index.h"

namespace slam {

/// What to say of colour images that come at quite another rate than the camera says, as when
/// their stamps are no seconds; empty when they do not.
std::string RateWarning(const std::vector<SequenceEntry>& entries, double fps);

}  // namespace slam
