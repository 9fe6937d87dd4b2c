#pragma once

#include <cstddef>
#include <vector>

#include "slam/segment/pixels/label_pairs.h"
#include "slam/segment/pixels/label_runs.h"

namespace slam {

/// How long the borders between labels are, in sides of pixels.
struct LabelContacts {
  LabelPairs<int> shared;   ///< of two labels
  std::vector<int> around;  ///< of each label with all that is beside it in the image
};

LabelContacts CountContacts(const LabelRuns& runs, std::size_t label_count);

}  // namespace slam
