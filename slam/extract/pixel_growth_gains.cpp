#include <algorithm>
#include <bit>
#include <numeric>

#include "slam/extract/pixel_growth.h"

namespace slam {

/// Calls visit(block) for the blocks that a label has reached, in their order.
template <typename Visit>
void PixelGrowth::VisitReached(int label, const Visit& visit) const {
  for (int r = 0; r < rows_; ++r) {
    const std::size_t row = ReachedRow(r, label);
    for (int byte = 0; byte < static_cast<int>(row_bytes_); ++byte) {
      unsigned bits = reached_[row + static_cast<std::size_t>(byte)];
      for (; bits != 0; bits &= bits - 1) {
        const int c = 8 * byte + std::countr_zero(bits) - 1;
        if (c >= 0 && c < cols_) visit(r * cols_ + c);
      }
    }
  }
}

int PixelGrowth::ClaimOf(int block, int label) const {
  int claim = First(block);
  while (At(claim).label != label) claim = At(claim).next;
  return claim;
}

/// Counts the pixels of every label and what they gain at least. Where no other plane is near,
/// that is much; elsewhere the vote may have chosen a plane that fits worse.
void PixelGrowth::BoundGains() {
  pixels_.assign(planes_.size(), 0), least_gain_.assign(planes_.size(), 0.0);
  const float near2 = NearSigmas() * NearSigmas(), wide2 = WideSigmas() * WideSigmas();
  const auto alone = static_cast<double>(wide2 - near2), contested = static_cast<double>(near2);
  for (int block = 0; block < cols_ * rows_; ++block) {
    const int first = First(block);
    if (first == kNoClaim) continue;
    if (At(first).next == kNoClaim) {
      const auto label = static_cast<std::size_t>(At(first).label);
      pixels_[label] += At(first).pixels;
      least_gain_[label] += GainAlone(At(first).pixels);
      continue;
    }
    // What more than one plane is near, as seen by each of them.
    FindContested(block, kWide);
    for (int claim = first; claim != kNoClaim; claim = At(claim).next) {
      const int n = At(claim).pixels;
      if (n == 0) continue;
      int shared = 0;
      const ConstPixelSet owned = SetOf(claim, kOwned);
      for (std::size_t k = 0; k < set_words_; ++k)
        shared += std::popcount(owned[k] & contested_[k]);
      const auto label = static_cast<std::size_t>(At(claim).label);
      pixels_[label] += n;
      least_gain_[label] += alone * (n - shared) - contested * shared;
    }
  }
}

/// What a label gains at its pixels of a block over the next best plane that is not dropped.
double PixelGrowth::GainIn(int block, int label) {
  const int first = First(block), own = ClaimOf(block, label);
  if (At(first).next == kNoClaim) return GainAlone(At(own).pixels);
  if (At(own).pixels == 0) return 0.0;
  const BlockPixels& pixels = PixelsOf(block);
  const ConstPixelSet owned = SetOf(own, kOwned);
  std::fill(nearest_.begin(), nearest_.end(), WideSigmas());
  for (int claim = first; claim != kNoClaim; claim = At(claim).next) {
    if (claim == own || dropped_[static_cast<std::size_t>(At(claim).label)] != 0) continue;
    if (Meet(SetOf(claim, kWide), owned, set_words_))
      LowerToDistance(pixels, PlaneOf(claim), nearest_.data());
  }
  return SumGains(pixels, PlaneOf(own), owned, nearest_.data());
}

double PixelGrowth::GainOf(int label) {
  double gain = 0.0;
  VisitReached(label, [&](int block) { gain += GainIn(block, label); });
  return gain;
}

void PixelGrowth::DropUseless() {
  BoundGains();
  const std::size_t count = planes_.size();
  fewest_first_.resize(count);
  std::iota(fewest_first_.begin(), fewest_first_.end(), 0u);
  std::sort(fewest_first_.begin(), fewest_first_.end(), [&](std::size_t a, std::size_t b) {
    return pixels_[a] != pixels_[b] ? pixels_[a] < pixels_[b] : a < b;
  });
  dropped_.assign(count, 0);
  for (const std::size_t label : fewest_first_) {
    // More than what the rounding of a sum could take away.
    constexpr double kSpare = 1e-6;
    const int n = std::max(pixels_[label], 1);
    if (least_gain_[label] >= (config_.min_gain + kSpare) * n) continue;
    if (GainOf(static_cast<int>(label)) < config_.min_gain * n) dropped_[label] = 1;
  }
  Drop();
}

void PixelGrowth::Drop() {
  for (int label = 0; label < static_cast<int>(dropped_.size()); ++label) {
    if (dropped_[static_cast<std::size_t>(label)] == 0) continue;
    VisitReached(label, [&](int block) {
      Unlink(block, label);
      Activate(block);
      is_stale_[static_cast<std::size_t>(block)] = 1;
    });
    std::copy(nothing_reached_.begin(), nothing_reached_.end(),
              reached_.begin() + static_cast<std::ptrdiff_t>(ReachedRow(-1, label)));
  }
  Grow();
}

}  // namespace slam
