#pragma once

#include <vector>

#include "slam/segment/pixels/label_runs.h"

namespace slam {

/// A 4-connected set of pixels with one label.
struct LabelComponent {
  int label = 0;
  int pixels = 0;
};

/// Connected components of a label image, in order of their first pixel.
struct LabelComponents {
  LabelRuns runs;              ///< those of the label image
  std::vector<int> component;  ///< one a run; -1 where there is no label
  std::vector<LabelComponent> list;
};

/// Finds the components of components.runs. Our own because it joins runs
/// instead of pixels: cv::connectedComponentsWithStats, called for each label within its
/// bounds, took 21 times as long on label images of desks, a seventh of the whole extraction.
void ConnectRuns(LabelComponents& components);

}  // namespace slam
