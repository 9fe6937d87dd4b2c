#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "slam/segment/growth/growth_config.h"
#include "slam/segment/growth/planes_on_blocks.h"

namespace slam {

/// What each plane gains at its pixels over the next best plane there: the difference of the
/// squared distances, sigmas^2. Where no other plane is near, the next best is as far away as
/// WideSigmas. Scratch memory of one search serves the next.
class PlaneGains {
 public:
  /// Finds the planes that gain less than min_gain a pixel. They are asked with the fewest
  /// pixels first, and a useless one no longer counts as the next best of those after it.
  /// @param useless  1 or 0 for each label
  void FindUseless(const PlanesOnBlocks& on, const GrowthConfig& config,
                   std::vector<std::uint8_t>& useless);

 private:
  /// What a plane with that many pixels of a block gains there when no other has reached it:
  /// how well it fits is not asked, as if the pixels scattered by one sigma.
  double GainAlone(int pixels) const {
    return static_cast<double>(wide_sigmas_ * wide_sigmas_ - 1.0f) * pixels;
  }
  void BoundGains(const PlanesOnBlocks& on);
  double GainOf(const PlanesOnBlocks& on, int hypothesis, int block,
                const std::vector<std::uint8_t>& useless);
  bool IsUseful(const PlanesOnBlocks& on, int label, const std::vector<std::uint8_t>& useless);

  float near_sigmas_ = 0.0f, wide_sigmas_ = 0.0f;
  double min_gain_ = 0.0;
  std::vector<int> pixels_;                ///< one a label
  std::vector<double> bounds_;             ///< lower bound on a label's gain
  std::vector<double> bounds_there_;       ///< the same of a hypothesis, in its block
  std::vector<std::size_t> fewest_first_;  ///< labels by pixels_
};

}  // namespace slam
