#include "slam/extract/block_sums.h"
#include "slam/extract/pixel_growth.h"

namespace slam {

const std::vector<PlaneSums>& PixelGrowth::SumLabels(const std::vector<PlaneSums>& whole) {
  if (claim_sums_.size() < claims_.size()) claim_sums_.resize(2 * claims_.size());
  label_sums_.assign(planes_.size(), PlaneSums{});
  for (int block = 0; block < cols_ * rows_; ++block) {
    const cv::Rect area = BlockArea(block);
    const std::int16_t* labels =
        labels_.data() + static_cast<std::size_t>(grid_->Index(area.x, area.y));
    for (int claim = First(block); claim != kNoClaim; claim = At(claim).next) {
      const Claim& at = At(claim);
      if (at.pixels == 0) continue;
      const bool all = !whole.empty() && whole[static_cast<std::size_t>(block)].n ==
                                             static_cast<double>(at.pixels);
      PlaneSums& sums = claim_sums_[static_cast<std::size_t>(claim)];
      sums = all ? whole[static_cast<std::size_t>(block)]
                 : SumLabelled(PixelsOf(area), labels, static_cast<std::int16_t>(at.label));
      label_sums_[static_cast<std::size_t>(at.label)] += sums;
    }
  }
  return label_sums_;
}

void PixelGrowth::SumOtherLabels(const LabelImage& labels, int count,
                                 std::vector<PlaneSums>& sums) const {
  sums.assign(static_cast<std::size_t>(count), PlaneSums{});
  for (int block = 0; block < cols_ * rows_; ++block) {
    int owner = kNoClaim, owner_count = 0;
    for (int claim = First(block); claim != kNoClaim; claim = At(claim).next) {
      if (At(claim).pixels > 0) owner = claim, ++owner_count;
    }
    if (owner_count == 0) continue;
    const cv::Rect area = BlockArea(block);
    const BlockPixels pixels = PixelsOf(area);
    const std::int16_t* start =
        labels.data() + static_cast<std::size_t>(grid_->Index(area.x, area.y));
    std::int16_t label = kNoLabel;
    const int same = owner_count == 1 ? CountOnly(pixels, start, label) : 0;
    if (same > 0 && same == At(owner).pixels) {
      sums[static_cast<std::size_t>(label)] += claim_sums_[static_cast<std::size_t>(owner)];
    } else {
      SumTile(pixels, start, sums);
    }
  }
}

}  // namespace slam
