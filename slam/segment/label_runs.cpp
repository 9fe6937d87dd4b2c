#include "slam/segment/label_runs.h"

#include "slam/segment/label_changes.h"

namespace slam {
namespace {

/// A row of FindInterior from the runs of three rows.
void FindInside(const LabelRun* above, const LabelRun* here, const LabelRun* below, int width,
                std::vector<LabelRun>& out) {
  int done = 0;
  while (true) {
    const int begin = std::max({above->begin, here->begin, below->begin}) + 1;
    const int end = std::min({above->end, here->end, below->end});
    const bool same = here->label == above->label && here->label == below->label;
    if (same && here->label != kNoLabel && begin < end - 1) {
      out.push_back({done, begin, kNoLabel});
      out.push_back({begin, end - 1, here->label});
      done = end - 1;
    }
    if (end == width) break;
    above += above->end == end ? 1 : 0;
    here += here->end == end ? 1 : 0;
    below += below->end == end ? 1 : 0;
  }
  out.push_back({done, width, kNoLabel});
}

}  // namespace

std::size_t LabelRuns::At(int u, int v) const {
  const auto first =
      runs.begin() + static_cast<std::ptrdiff_t>(rows[static_cast<std::size_t>(v)]);
  const auto last =
      runs.begin() + static_cast<std::ptrdiff_t>(rows[static_cast<std::size_t>(v) + 1]);
  const auto after = std::upper_bound(
      first, last, u, [](int column, const LabelRun& run) { return column < run.begin; });
  return static_cast<std::size_t>(after - runs.begin()) - 1;
}

void FindRuns(const LabelImage& labels, int width, int height, LabelRuns& out) {
  out.width = width;
  out.runs.clear(), out.rows.clear();
  for (int v = 0; v < height; ++v) {
    out.rows.push_back(out.runs.size());
    if (width == 0) continue;
    const std::int16_t* row =
        labels.data() + static_cast<std::size_t>(v) * static_cast<std::size_t>(width);
    int begin = 0;
    const auto end_run = [&](int u) {
      out.runs.push_back({begin, u, row[begin]});
      begin = u;
    };
    VisitChanges(row, 1, width, end_run);
    out.runs.push_back({begin, width, row[begin]});
  }
  out.rows.push_back(out.runs.size());
}

void MapRuns(const LabelRuns& runs, const std::vector<int>& to, LabelRuns& out) {
  out.width = runs.width;
  out.runs.clear(), out.rows.clear();
  for (std::size_t row = 0; row + 1 < runs.rows.size(); ++row) {
    out.rows.push_back(out.runs.size());
    for (std::size_t k = runs.rows[row]; k < runs.rows[row + 1]; ++k) {
      LabelRun run = runs.runs[k];
      if (run.label != kNoLabel) run.label = to[static_cast<std::size_t>(run.label)];
      if (run.begin > 0 && out.runs.back().label == run.label) {
        out.runs.back().end = run.end;
      } else {
        out.runs.push_back(run);
      }
    }
  }
  out.rows.push_back(out.runs.size());
}

void FindInterior(const LabelRuns& runs, LabelRuns& out) {
  out.width = runs.width;
  out.runs.clear(), out.rows.clear();
  if (runs.rows.empty()) return;
  const std::size_t height = runs.rows.size() - 1;
  for (std::size_t v = 0; v < height; ++v) {
    out.rows.push_back(out.runs.size());
    if (runs.width == 0) continue;
    if (v == 0 || v + 1 == height) {
      out.runs.push_back({0, runs.width, kNoLabel});
      continue;
    }
    const LabelRun* first = runs.runs.data();
    FindInside(first + runs.rows[v - 1], first + runs.rows[v], first + runs.rows[v + 1],
               runs.width, out.runs);
  }
  out.rows.push_back(out.runs.size());
}

}  // namespace slam
