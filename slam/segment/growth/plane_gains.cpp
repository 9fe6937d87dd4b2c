#include "slam/segment/growth/plane_gains.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <numeric>
#include <utility>

#include "slam/base/index.h"

namespace slam {
namespace {

class PlaneGains {
 public:
  PlaneGains(const PlanesOnBlocks& on, const GrowthConfig& config)
      : on_(on),
        near_sigmas_(NearSigmas(config)),
        wide_sigmas_(WideSigmas(config)),
        min_gain_(config.min_gain) {}
  void BoundGains();
  std::vector<std::uint8_t> FindUseless();

 private:
  double GainOf(int hypothesis, int block) const;
  bool IsUseful(int label) const;

  const PlanesOnBlocks& on_;
  const float near_sigmas_, wide_sigmas_;
  const double min_gain_;
  std::vector<int> pixels_;  ///< one a label
  /// One a label: the blocks that it has reached, each with its hypothesis there.
  std::vector<std::vector<std::pair<int, int>>> places_;
  std::vector<double> bounds_;        ///< lower bound on a label's gain
  std::vector<double> bounds_there_;  ///< the same of a hypothesis, in its block
  std::vector<std::uint8_t> useless_;
};

/// Counts the pixels of every label and bounds what they gain from below. Where no other plane
/// is near, that is much; elsewhere the vote may have chosen a plane that fits worse.
void PlaneGains::BoundGains() {
  const BlockHypotheses& hypotheses = on_.hypotheses;
  pixels_.assign(on_.planes.size(), 0), bounds_.assign(on_.planes.size(), 0.0);
  places_.assign(on_.planes.size(), {});
  bounds_there_.resize(hypotheses.size());
  const float near2 = near_sigmas_ * near_sigmas_, wide2 = wide_sigmas_ * wide_sigmas_;
  const auto alone = static_cast<double>(wide2 - near2), beside = static_cast<double>(near2);
  const auto only = static_cast<double>(wide2 - 1.0f);  // as if its pixels scattered by a sigma
  for (int block = 0; block < on_.blocks->count(); ++block) {
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
          is_only ? only * pixels : alone * (pixels - shared) - beside * shared;
      bounds_there_[Index(k)] = bound;
      const auto label = static_cast<std::size_t>(at.label);
      pixels_[label] += pixels, bounds_[label] += bound;
      places_[label].emplace_back(block, k);
    }
  }
}

/// What a hypothesis gains at its pixels of a block over the next best plane. Where that is
/// useless, as if nobody else were near: the third best is not asked, because in much noise
/// thin things would go with it.
double PlaneGains::GainOf(int hypothesis, int block) const {
  const BlockHypotheses& hypotheses = on_.hypotheses;
  const int first = hypotheses.First(block);
  if (hypotheses.At(first).next == kNoHypothesis || hypotheses.At(hypothesis).owned == 0)
    return bounds_there_[Index(hypothesis)];

  // The nearest plane at each pixel, of those that stay and of those that go.
  const BlockPixels& pixels = on_.blocks->PixelsOf(block);
  const PixelSet owned = hypotheses.At(hypothesis).owned;
  std::array<float, kBlockPixels> stays, goes;
  stays.fill(wide_sigmas_), goes.fill(wide_sigmas_);
  bool any_goes = false;
  for (int other = first; other != kNoHypothesis; other = hypotheses.At(other).next) {
    if (other == hypothesis || (hypotheses.At(other).wide & owned) == 0) continue;
    const bool is_useless = useless_[Index(hypotheses.At(other).label)] != 0;
    LowerToDistance(pixels, on_.PlaneOf(other), is_useless ? goes.data() : stays.data());
    any_goes |= is_useless;
  }
  for (std::size_t k = 0; any_goes && k < stays.size(); ++k)
    stays[k] = goes[k] < stays[k] ? wide_sigmas_ : stays[k];
  return SumGains(pixels, on_.PlaneOf(hypothesis), owned, stays.data());
}

/// Whether a label gains enough. Looks no further once the bounds of the other blocks suffice.
bool PlaneGains::IsUseful(int label) const {
  // sigmas^2 a pixel: more than the rounding of a sum takes away.
  constexpr double kSpare = 1e-6;
  const int pixels = std::max(pixels_[Index(label)], 1);
  const double enough = min_gain_ * pixels, surely = enough + kSpare * pixels;
  double gain = 0.0, others = bounds_[Index(label)];
  if (others >= surely) return true;
  for (const auto& [block, k] : places_[Index(label)]) {
    gain += GainOf(k, block);
    others -= bounds_there_[Index(k)];
    if (gain + others >= surely) return true;
  }
  return gain >= enough;
}

std::vector<std::uint8_t> PlaneGains::FindUseless() {
  // Fewest pixels first: a small plane that only steals from its neighbours goes before these
  // are asked.
  std::vector<std::size_t> fewest_first(pixels_.size());
  std::iota(fewest_first.begin(), fewest_first.end(), 0u);
  std::stable_sort(fewest_first.begin(), fewest_first.end(),
                   [&](std::size_t a, std::size_t b) { return pixels_[a] < pixels_[b]; });
  useless_.assign(pixels_.size(), 0);
  for (const std::size_t label : fewest_first)
    if (!IsUseful(static_cast<int>(label))) useless_[label] = 1;
  return std::move(useless_);
}

}  // namespace

std::vector<std::uint8_t> FindUseless(const PlanesOnBlocks& on, const GrowthConfig& config) {
  PlaneGains gains(on, config);
  gains.BoundGains();
  return gains.FindUseless();
}

}  // namespace slam
