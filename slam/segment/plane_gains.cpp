#include "slam/segment/plane_gains.h"

#include <algorithm>
#include <numeric>

namespace slam {

/// Counts the pixels of every label and bounds what they gain from below. Where no other plane
/// is near, that is much; elsewhere the vote may have chosen a plane that fits worse.
void PlaneGains::BoundGains(const PlanesOnBlocks& on) {
  const BlockHypotheses& hypotheses = on.hypotheses;
  pixels_.assign(on.planes.size(), 0), bounds_.assign(on.planes.size(), 0.0);
  bounds_there_.resize(hypotheses.size());
  const float near2 = near_sigmas_ * near_sigmas_, wide2 = wide_sigmas_ * wide_sigmas_;
  const auto alone = static_cast<double>(wide2 - near2), beside = static_cast<double>(near2);
  for (int block = 0; block < on.block_count(); ++block) {
    const int first = hypotheses.First(block);
    if (first == kNoHypothesis) continue;
    const bool is_only = hypotheses.At(first).next == kNoHypothesis;
    if (!is_only) hypotheses.FindShared(block, BlockHypotheses::kWide, shared_.data());
    for (int k = first; k != kNoHypothesis; k = hypotheses.At(k).next) {
      const Hypothesis& at = hypotheses.At(k);
      double& bound = bounds_there_[static_cast<std::size_t>(k)];
      if (is_only) {
        bound = GainAlone(at.pixels);
      } else if (at.pixels == 0) {
        bound = 0.0;
      } else {
        const int shared = CountOfBoth(hypotheses.SetOf(k, BlockHypotheses::kOwned),
                                       shared_.data(), hypotheses.set_words());
        bound = alone * (at.pixels - shared) - beside * shared;
      }
      const auto label = static_cast<std::size_t>(at.label);
      pixels_[label] += at.pixels, bounds_[label] += bound;
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
  if (hypotheses.At(first).next == kNoHypothesis || hypotheses.At(hypothesis).pixels == 0)
    return bounds_there_[static_cast<std::size_t>(hypothesis)];

  // The nearest plane at each pixel, of those that stay and of those that go.
  const BlockPixels& pixels = on.PixelsOf(block);
  const ConstPixelSet owned = hypotheses.SetOf(hypothesis, BlockHypotheses::kOwned);
  const std::size_t count = nearest_.size() / 2;
  float *stays = nearest_.data(), *goes = stays + count;
  std::fill(nearest_.begin(), nearest_.end(), wide_sigmas_);
  bool any_goes = false;
  for (int other = first; other != kNoHypothesis; other = hypotheses.At(other).next) {
    if (other == hypothesis ||
        !Meet(hypotheses.SetOf(other, BlockHypotheses::kWide), owned, hypotheses.set_words()))
      continue;
    const bool is_useless = useless[static_cast<std::size_t>(hypotheses.At(other).label)] != 0;
    LowerToDistance(pixels, on.PlaneOf(other), is_useless ? goes : stays);
    any_goes |= is_useless;
  }
  for (std::size_t k = 0; any_goes && k < count; ++k)
    stays[k] = goes[k] < stays[k] ? wide_sigmas_ : stays[k];
  return SumGains(pixels, on.PlaneOf(hypothesis), owned, stays);
}

/// Whether a label gains enough. Looks no further once the bounds of the other blocks suffice.
bool PlaneGains::IsUseful(const PlanesOnBlocks& on, int label,
                          const std::vector<std::uint8_t>& useless) {
  // sigmas^2 a pixel: more than the rounding of a sum takes away.
  constexpr double kSpare = 1e-6;
  const int pixels = std::max(pixels_[static_cast<std::size_t>(label)], 1);
  const double enough = min_gain_ * pixels, surely = enough + kSpare * pixels;
  double gain = 0.0, others = bounds_[static_cast<std::size_t>(label)];
  if (others >= surely) return true;
  bool is_sure = false;
  on.reached.VisitBlocks(label, [&](int block) {
    const int k = on.hypotheses.Find(block, label);
    gain += GainOf(on, k, block, useless);
    others -= bounds_there_[static_cast<std::size_t>(k)];
    is_sure = gain + others >= surely;
    return is_sure;
  });
  return is_sure || gain >= enough;
}

void PlaneGains::FindUseless(const PlanesOnBlocks& on, const GrowthConfig& config,
                             std::vector<std::uint8_t>& useless) {
  near_sigmas_ = NearSigmas(config), wide_sigmas_ = WideSigmas(config);
  min_gain_ = config.min_gain;
  nearest_.resize(2 * EntriesOfBlock(config.block_px));
  shared_.resize(on.hypotheses.set_words());
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
