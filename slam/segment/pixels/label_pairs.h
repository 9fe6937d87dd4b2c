#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "slam/base/index.h"

namespace slam {

/// A value for each pair of labels that touch. Its memory serves again.
template <typename Value>
class LabelPairs {
 public:
  struct Entry {
    std::pair<int, int> labels;  ///< lower, higher
    Value value;
  };

  /// Forgets everything. @param label_count  labels are below it
  void Clear(int label_count) {
    entries_.clear(), next_.clear();
    first_.assign(static_cast<std::size_t>(label_count), kNone);
  }

  /// The value of a pair; a new one is Value{}. Another pair may move it.
  Value& Of(int a, int b) {
    const std::pair<int, int> labels = std::minmax(a, b);
    int& first = first_[Index(labels.first)];
    for (int k = first; k != kNone; k = next_[Index(k)]) {
      Entry& entry = entries_[Index(k)];
      if (entry.labels.second == labels.second) return entry.value;
    }
    next_.push_back(first);
    first = static_cast<int>(entries_.size());
    return entries_.emplace_back(Entry{labels, Value{}}).value;
  }

  /// In order of their labels from now on; Of() needs a Clear() first.
  std::vector<Entry>& Sorted() {
    std::sort(entries_.begin(), entries_.end(),
              [](const Entry& a, const Entry& b) { return a.labels < b.labels; });
    first_.clear(), next_.clear();
    return entries_;
  }

 private:
  static constexpr int kNone = -1;

  std::vector<Entry> entries_;
  std::vector<int> first_;  ///< entry of each lower label
  std::vector<int> next_;   ///< entry of the same lower label, of each
};

}  // namespace slam
