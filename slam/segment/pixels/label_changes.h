#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

namespace slam {

/// As many labels as a word holds, the first in the lowest bits.
template <typename Label>
std::uint64_t LabelWord(const Label* labels) {
  std::uint64_t word = 0;
  if constexpr (std::endian::native == std::endian::little) {
    std::memcpy(&word, labels, sizeof word);
  } else {
    for (std::size_t k = sizeof word / sizeof(Label); k-- > 0;)
      word = word << 8 * sizeof(Label) | static_cast<std::make_unsigned_t<Label>>(labels[k]);
  }
  return word;
}

/// Calls visit(k) for every k in [first, end), ascending, for which labels[k] is not
/// labels[k - 1].
template <typename Label, typename Visit>
void VisitChanges(const Label* labels, int first, int end, const Visit& visit) {
  constexpr int kBits = 8 * sizeof(Label), kAtOnce = 64 / kBits;
  const auto visit_word = [&](std::uint64_t differs, int start) {
    while (differs != 0) {
      const int at = std::countr_zero(differs) / kBits;
      visit(start + at);
      differs &= ~(((std::uint64_t{1} << kBits) - 1) << at * kBits);
    }
  };
  int k = first;
  for (; k + 2 * kAtOnce <= end; k += 2 * kAtOnce) {
    const std::uint64_t low = LabelWord(labels + k) ^ LabelWord(labels + k - 1);
    const std::uint64_t high =
        LabelWord(labels + k + kAtOnce) ^ LabelWord(labels + k + kAtOnce - 1);
    if ((low | high) == 0) continue;
    visit_word(low, k);
    visit_word(high, k + kAtOnce);
  }
  for (; k < end; ++k) {
    if (labels[k] != labels[k - 1]) visit(k);
  }
}

}  // namespace slam
