#include "slam/segment/growth/plane_gains.h"

#include <algorithm>
#include <array>
#include <bit>
#include <numeric>

#include "slam/base/index.h"

namespace slam {

/// Counts the pixels of every label and bounds what they gain from below. Where no other plane
/// is near, that is much; elsewhere the vote may have chosen a plane that fits worse.
void PlaneGains::BoundGains(const PlanesOnBlocks& on) {
  const BlockHypotheses& hypotheses = on.hypotheses;
  pixels_.assign(on.planes.size(), 0), bounds_.assign(on.planes.size(), 0.0);
  bounds_there_.resize(hypotheses.size());
  const float near2 = near_sigmas_ * near_sigmas_, wide2 = wide_sigmas_ * wide_sigmas_;
  const auto alone = static_cast<double>(wide2 - near2), beside = static_cast<double>(near2);
  for (int block = 0; block < on.blocks->count(); ++block) {
    const int first = hypotheses.First(block);
    if (first == kNoHypothesis) continue;
    const bool is_only = hypotheses.At(first).next == kNoHypothesis;
    const PixelSet wide_of_several =
        is_only ? PixelSet{0} : hypotheses.FindShared(block, &Hypothesis::wide);
    for (int k = first; k != kNoHypothesis; k = hypotheses.At(k).next) {
      const Hypothesis& at = hypotheses.At(k);
      const int pixels = std::popcount(at.owned);
      const int shared = std::popcount(at.owned & wide_of_several);
      const double bound =
          is_only ? GainAlone(pixels) : alone * (pixels - shared) - beside * shared;
      bounds_there_[Index(k)] = bound;
      const auto label = static_cast<std::size_t>(at.label);
      pixels_[label] += pixels, bounds_[label] += bound;
    }
  }
}

/// What a hypothesis gains at its pixels of a block over the next best plane. Where that is
/// useless, as if nobody else were near: the third best is not asked, because in much noise
/// thin things would go with it.
double PlaneGains::GainOf(const PlanesOnBlocks& on, int hypothesis, int block,
                          const std::vector<std::uint8_t>& useless) {
  const BlockHypotheses& hypotheses = on.hypotheses;
  const int first = hypotheses.First(block);
  if (hypotheses.At(first).next == kNoHypothesis || hypotheses.At(hypothesis).owned == 0)
    return bounds_there_[Index(hypothesis)];

  // The nearest plane at each pixel, of those that stay and of those that go.
  const BlockPixels& pixels = on.blocks->PixelsOf(block);
  const PixelSet owned = hypotheses.At(hypothesis).owned;
  std::array<float, kBlockPixels> stays, goes;
  stays.fill(wide_sigmas_), goes.fill(wide_sigmas_);
  bool any_goes = false;
  for (int other = first; other != kNoHypothesis; other = hypotheses.At(other).next) {
    if (other == hypothesis || (hypotheses.At(other).wide & owned) == 0) continue;
    const bool is_useless = useless[Index(hypotheses.At(other).label)] != 0;
    LowerToDistance(pixels, on.PlaneOf(other), is_useless ? goes.data() : stays.data());
    any_goes |= is_useless;
  }
  for (std::size_t k = 0; any_goes && k < stays.size(); ++k)
    stays[k] = goes[k] < stays[k] ? wide_sigmas_ : stays[k];
  return SumGains(pixels, on.PlaneOf(hypothesis), owned, stays.data());
}

/// Whether a label gains enough. Looks no further once the bounds of the other blocks suffice.
bool PlaneGains::IsUseful(const PlanesOnBlocks& on, int label,
                          const std::vector<std::uint8_t>& useless) {
  // sigmas^2 a pixel: more than the rounding of a sum takes away.
  constexpr double kSpare = 1e-6;
  const int pixels = std::max(pixels_[Index(label)], 1);
  const double enough = min_gain_ * pixels, surely = enough + kSpare * pixels;
  double gain = 0.0, others = bounds_[Index(label)];
  if (others >= surely) return true;
  bool is_sure = false;
  on.reached.VisitBlocks(label, [&](int block) {
    const int k = on.hypotheses.Find(block, label);
    gain += GainOf(on, k, block, useless);
    others -= bounds_there_[Index(k)];
    is_sure = gain + others >= surely;
    return is_sure;
  });
  return is_sure || gain >= enough;
}

void PlaneGains::FindUseless(const PlanesOnBlocks& on, const GrowthConfig& config,
                             std::vector<std::uint8_t>& useless) {
  near_sigmas_ = NearSigmas(config), wide_sigmas_ = WideSigmas(config);
  min_gain_ = config.min_gain;
  BoundGains(on);

  // Fewest pixels first: a small plane that only steals from its neighbours goes before these
  // are asked.
  fewest_first_.resize(on.planes.size());
  std::iota(fewest_first_.begin(), fewest_first_.end(), 0u);
  std::sort(fewest_first_.begin(), fewest_first_.end(), [&](std::size_t a, std::size_t b) {
    return pixels_[a] != pixels_[b] ? pixels_[a] < pixels_[b] : a < b;
  });
  useless.assign(on.planes.size(), 0);
  for (const std::size_t label : fewest_first_)
    if (!IsUseful(on, static_cast<int>(label), useless)) useless[label] = 1;
}

}  // namespace slam
