#include "slam/segment/pixels/label_components.h"

#include <algorithm>
#include <cstddef>
#include <numeric>

#include "slam/base/index.h"

namespace slam {
namespace {

int Root(std::vector<int>& parent, int i) {
  while (parent[Index(i)] != i) {
    int& up = parent[Index(i)];
    up = parent[Index(up)];
    i = up;
  }
  return i;
}

/// The lower number becomes the root, so that a root is its component's first run.
void Unite(std::vector<int>& parent, int i, int j) {
  i = Root(parent, i), j = Root(parent, j);
  parent[Index(std::max(i, j))] = std::min(i, j);
}

}  // namespace

void ConnectRuns(LabelComponents& components) {
  const LabelRuns& runs = components.runs;
  std::vector<int>& of_run = components.component;  // at first a run of the same component
  of_run.resize(runs.runs.size());
  std::iota(of_run.begin(), of_run.end(), 0);
  VisitRunsBelow(runs, [&](std::size_t a, std::size_t b, int, int) {
    if (runs.runs[a].label == runs.runs[b].label && runs.runs[a].label != kNoLabel)
      Unite(of_run, static_cast<int>(a), static_cast<int>(b));
  });

  // Components are numbered by their first run, which is the root.
  for (std::size_t k = 0; k < of_run.size(); ++k)
    of_run[k] = of_run[Index(of_run[k])];  // lower ones are roots' already
  components.list.clear();
  for (std::size_t row = 0; row + 1 < runs.rows.size(); ++row) {
    for (std::size_t k = runs.rows[row]; k < runs.rows[row + 1]; ++k) {
      const LabelRun& run = runs.runs[k];
      const auto root = static_cast<std::size_t>(of_run[k]);
      of_run[k] = -1;
      if (run.label == kNoLabel) continue;
      if (root == k) {
        of_run[k] = static_cast<int>(components.list.size());
        components.list.push_back({run.label, 0});
      } else {
        of_run[k] = of_run[root];
      }
      components.list[Index(of_run[k])].pixels += run.end - run.begin;
    }
  }
}

}  // namespace slam
