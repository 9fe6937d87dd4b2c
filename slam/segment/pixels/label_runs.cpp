#include "slam/segment/pixels/label_runs.h"

#include "slam/base/index.h"

namespace slam {

std::size_t LabelRuns::At(int u, int v) const {
  const auto first = runs.begin() + static_cast<std::ptrdiff_t>(rows[Index(v)]);
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
    const std::int16_t* row =
        labels.data() + static_cast<std::size_t>(v) * static_cast<std::size_t>(width);
    for (int begin = 0; begin < width;) {
      const std::int16_t label = row[begin];
      const auto* next = std::find_if(row + begin, row + width,
                                      [label](std::int16_t other) { return other != label; });
      const int end = static_cast<int>(next - row);
      out.runs.push_back({begin, end, label});
      begin = end;
    }
  }
  out.rows.push_back(out.runs.size());
}

LabelContacts CountContacts(const LabelRuns& runs, std::size_t label_count) {
  LabelContacts contacts{LabelPairs<int>(label_count), std::vector<int>(label_count)};
  const auto add = [&](int a, int b, int sides) {
    if (a == b) return;
    if (a != kNoLabel) contacts.around[Index(a)] += sides;
    if (b != kNoLabel) contacts.around[Index(b)] += sides;
    if (a != kNoLabel && b != kNoLabel) contacts.shared.Of(a, b) += sides;
  };
  for (std::size_t row = 0; row + 1 < runs.rows.size(); ++row)
    for (std::size_t k = runs.rows[row]; k + 1 < runs.rows[row + 1]; ++k)
      add(runs.runs[k].label, runs.runs[k + 1].label, 1);
  VisitRunsBelow(runs, [&](std::size_t a, std::size_t b, int begin, int end) {
    add(runs.runs[a].label, runs.runs[b].label, end - begin);
  });
  return contacts;
}

}  // namespace slam
