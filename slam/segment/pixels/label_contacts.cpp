#include "slam/segment/pixels/label_contacts.h"

#include "slam/base/index.h"

namespace slam {

LabelContacts CountContacts(const LabelRuns& runs, std::size_t label_count) {
  LabelContacts contacts;
  contacts.shared.Clear(static_cast<int>(label_count));
  contacts.around.assign(label_count, 0);
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
