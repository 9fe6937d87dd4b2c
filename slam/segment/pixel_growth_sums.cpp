#include "slam/segment/block_sums.h"
#include "slam/segment/pixel_growth.h"

namespace slam {

const std::vector<PlaneSums>& PixelGrowth::SumLabels(const std::vector<PlaneSums>& whole) {
  label_sums_.assign(planes_.size(), PlaneSums{});
  for (int block = 0; block < cols_ * rows_; ++block) {
    for (int claim = First(block); claim != kNoClaim; claim = At(claim).next) {
      const Claim& at = At(claim);
      if (at.pixels == 0) continue;
      const bool all = !whole.empty() && whole[static_cast<std::size_t>(block)].n ==
                                             static_cast<double>(at.pixels);
      label_sums_[static_cast<std::size_t>(at.label)] +=
          all ? whole[static_cast<std::size_t>(block)]
              : SumOfSet(PixelsOf(block), SetOf(claim, kOwned));
    }
  }
  return label_sums_;
}

}  // namespace slam
