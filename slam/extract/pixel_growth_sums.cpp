#include "slam/extract/block_sums.h"
#include "slam/extract/pixel_growth.h"

namespace slam {

const std::vector<PlaneSums>& PixelGrowth::SumLabels(const std::vector<PlaneSums>& whole) {
  if (claim_sums_.size() < claims_.size()) claim_sums_.resize(2 * claims_.size());
  label_sums_.assign(planes_.size(), PlaneSums{});
  for (int block = 0; block < cols_ * rows_; ++block) {
    for (int claim = First(block); claim != kNoClaim; claim = At(claim).next) {
      const Claim& at = At(claim);
      if (at.pixels == 0) continue;
      const bool all = !whole.empty() && whole[static_cast<std::size_t>(block)].n ==
                                             static_cast<double>(at.pixels);
      PlaneSums& sums = claim_sums_[static_cast<std::size_t>(claim)];
      sums = all ? whole[static_cast<std::size_t>(block)]
                 : SumOfSet(PixelsOf(block), SetOf(claim, kOwned));
      label_sums_[static_cast<std::size_t>(at.label)] += sums;
    }
  }
  return label_sums_;
}

void PixelGrowth::SumOtherLabels(const LabelImage& labels, int count,
                                 std::vector<PlaneSums>& sums) const {
  sums.assign(static_cast<std::size_t>(count), PlaneSums{});
  for (int block = 0; block < cols_ * rows_; ++block) {
    const BlockPixels& pixels = PixelsOf(block);
    const std::int16_t* at = labels.data() + IndexOf(block);
    goes_to_.clear();
    bool whole = true;
    for (int claim = First(block); whole && claim != kNoClaim; claim = At(claim).next) {
      if (At(claim).pixels == 0) continue;
      std::int16_t to = kNoLabel;
      whole = HaveOneLabel(pixels, SetOf(claim, kOwned), at, to);
      goes_to_.emplace_back(claim, to);
    }
    if (!whole) {
      SumTile(pixels, at, sums);
      continue;
    }
    for (const auto& [claim, to] : goes_to_) {
      if (to == kNoLabel) continue;
      sums[static_cast<std::size_t>(to)] += claim_sums_[static_cast<std::size_t>(claim)];
    }
  }
}

}  // namespace slam
