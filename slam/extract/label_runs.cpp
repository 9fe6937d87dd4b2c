#include "slam/extract/label_runs.h"

#include <cstring>

namespace slam {
namespace {

constexpr int kAtOnce = 4;  // labels in a word

/// Whether the labels of kAtOnce pixels equal those to their left.
bool EqualLeft(const std::int16_t* labels) {
  std::uint64_t here = 0, left = 0;
  std::memcpy(&here, labels, sizeof here);
  std::memcpy(&left, labels - 1, sizeof left);
  return here == left;
}

}  // namespace

void FindRuns(const std::vector<std::int16_t>& labels, int width, int height, LabelRuns& out) {
  out.width = width;
  out.runs.clear(), out.rows.clear();
  for (int v = 0; v < height; ++v) {
    out.rows.push_back(out.runs.size());
    if (width == 0) continue;
    const std::int16_t* row =
        labels.data() + static_cast<std::size_t>(v) * static_cast<std::size_t>(width);
    int begin = 0;
    const auto look = [&](int u) {
      if (row[u] == row[u - 1]) return;
      out.runs.push_back({begin, u, row[begin]});
      begin = u;
    };
    int u = 1;
    for (; u + kAtOnce <= width; u += kAtOnce) {
      if (EqualLeft(row + u)) continue;
      for (int k = 0; k < kAtOnce; ++k) look(u + k);
    }
    for (; u < width; ++u) look(u);
    out.runs.push_back({begin, width, row[begin]});
  }
  out.rows.push_back(out.runs.size());
}

}  // namespace slam
