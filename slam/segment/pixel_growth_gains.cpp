#include <algorithm>
#include <bit>
#include <numeric>

#include "slam/segment/pixel_growth.h"

namespace slam {

/// Calls visit(block) for the blocks that a label has reached, in their order, until it says
/// that this is enough.
template <typename Visit>
void PixelGrowth::VisitReached(int label, const Visit& visit) const {
  const Rows rows = reached_rows_[static_cast<std::size_t>(label)];
  for (int r = rows.first; r <= rows.last; ++r) {
    const std::size_t row = ReachedRow(r, label), margin = ReachedRow(r, 0);
    for (std::size_t byte = 0; byte < row_bytes_; ++byte) {
      unsigned bits = reached_[row + byte] & ~nothing_reached_[margin + byte] & 0xffu;
      for (; bits != 0; bits &= bits - 1) {
        const int c = 8 * static_cast<int>(byte) + std::countr_zero(bits) - 1;
        if (visit(r * cols_ + c)) return;
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
    const bool is_only = At(first).next == kNoClaim;
    if (!is_only) FindContested(block, kWide);
    for (int claim = first; claim != kNoClaim; claim = At(claim).next) {
      Claim& at = At(claim);
      const auto label = static_cast<std::size_t>(at.label);
      if (is_only) {
        at.least_gain = GainAlone(at.pixels);
      } else if (at.pixels == 0) {
        at.least_gain = 0.0;
      } else {
        const int shared = CountOfBoth(SetOf(claim, kOwned), contested_.data(), set_words_);
        at.least_gain = alone * (at.pixels - shared) - contested * shared;
      }
      pixels_[label] += at.pixels, least_gain_[label] += at.least_gain;
    }
  }
}

/// What a claim gains at its pixels of a block over the next best plane. Where that is dropped,
/// as if nobody else were near: the third best is not asked, because in much noise thin things
/// would go with it.
double PixelGrowth::GainOf(int claim, int block) {
  if (At(First(block)).next == kNoClaim || At(claim).pixels == 0) return At(claim).least_gain;
  const BlockPixels& pixels = PixelsOf(block);
  const ConstPixelSet owned = SetOf(claim, kOwned);
  float *stays = nearest_.data(), *goes = stays + slot_size_;
  std::fill(nearest_.begin(), nearest_.end(), WideSigmas());
  bool any_goes = false;
  for (int other = First(block); other != kNoClaim; other = At(other).next) {
    if (other == claim || !Meet(SetOf(other, kWide), owned, set_words_)) continue;
    const bool is_dropped = dropped_[static_cast<std::size_t>(At(other).label)] != 0;
    LowerToDistance(pixels, PlaneOf(other), is_dropped ? goes : stays);
    any_goes |= is_dropped;
  }
  for (std::size_t k = 0; any_goes && k < slot_size_; ++k)
    stays[k] = goes[k] < stays[k] ? WideSigmas() : stays[k];
  return SumGains(pixels, PlaneOf(claim), owned, stays);
}

/// Whether a label gains enough. Looks no further once what it gains at least in the other
/// blocks suffices.
bool PixelGrowth::IsUseful(int label) {
  // More than what the rounding of a sum could take away.
  constexpr double kSpare = 1e-6;
  const int pixels = std::max(pixels_[static_cast<std::size_t>(label)], 1);
  const double enough = config_.min_gain * pixels, surely = enough + kSpare * pixels;
  double gain = 0.0, others = least_gain_[static_cast<std::size_t>(label)];
  if (others >= surely) return true;
  bool is_sure = false;
  VisitReached(label, [&](int block) {
    const int claim = ClaimOf(block, label);
    gain += GainOf(claim, block), others -= At(claim).least_gain;
    is_sure = gain + others >= surely;
    return is_sure;
  });
  return is_sure || gain >= enough;
}

void PixelGrowth::DropUseless() {
  BoundGains();
  fewest_first_.resize(planes_.size());
  std::iota(fewest_first_.begin(), fewest_first_.end(), 0u);
  std::sort(fewest_first_.begin(), fewest_first_.end(), [&](std::size_t a, std::size_t b) {
    return pixels_[a] != pixels_[b] ? pixels_[a] < pixels_[b] : a < b;
  });
  dropped_.assign(planes_.size(), 0);
  for (const std::size_t label : fewest_first_)
    if (!IsUseful(static_cast<int>(label))) dropped_[label] = 1;
  Drop();
}

void PixelGrowth::Drop() {
  for (int label = 0; label < static_cast<int>(dropped_.size()); ++label) {
    if (dropped_[static_cast<std::size_t>(label)] == 0) continue;
    VisitReached(label, [&](int block) {
      Unlink(block, label);
      Activate(block);
      is_stale_[static_cast<std::size_t>(block)] = 1;
      return false;
    });
    std::copy(nothing_reached_.begin(), nothing_reached_.end(),
              reached_.begin() + static_cast<std::ptrdiff_t>(ReachedRow(-1, label)));
  }
  Grow();
}

}  // namespace slam
