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

/// What its owner gains at each pixel of a block, over whom.
void PixelGrowth::CompareRivals(int block) {
  block_gains_.clear(), rival_claims_.clear();
  for (int claim = First(block); claim != kNoClaim; claim = At(claim).next) {
    if (!IsEmpty(SetOf(claim, kWide), set_words_)) rival_claims_.push_back(claim);
  }
  if (residuals_.size() < rival_claims_.size() * slot_size_)
    residuals_.resize(2 * rival_claims_.size() * slot_size_);
  const BlockPixels pixels = PixelsOf(block);
  const int count = static_cast<int>(slot_size_);
  float* residuals = residuals_.data();
  for (const int claim : rival_claims_) {
    MeasureBlock(pixels, count, PlaneOf(claim), MeasuredOf(block), residuals);
    block_gains_.push_back({{At(claim).label, SetOf(claim, kOwned)}, residuals, 0.0});
    residuals += slot_size_;
  }
  GainsOfBlock(block_gains_.data(), static_cast<int>(block_gains_.size()), config_.block_px,
               count, WideSigmas(), owners_.data(), next_labels_.data());
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

/// Sums what a label gains.
void PixelGrowth::AddGains(int label) {
  double& gain = gain_[static_cast<std::size_t>(label)];
  VisitReached(label, [&](int block) {
    const Claim& own = At(ClaimOf(block, label));
    if (At(First(block)).next == kNoClaim) {
      gain += GainAlone(own.pixels);
      return;
    }
    if (own.pixels == 0) return;
    std::uint8_t& known = knows_gains_[static_cast<std::size_t>(block)];
    if (known == 0) {
      CompareRivals(block);
      for (std::size_t k = 0; k < rival_claims_.size(); ++k)
        At(rival_claims_[k]).gain = block_gains_[k].gain;
      known = 1;
    }
    gain += own.gain;
  });
}

/// Adds what others gain at pixels where `label`'s plane is the next best, if it is not there.
void PixelGrowth::AddGainsWithout(int label) {
  const float unexplained = WideSigmas();
  VisitReached(label, [&](int block) {
    const ConstPixelSet wide = SetOf(ClaimOf(block, label), kWide);
    bool matters = false;
    for (int claim = First(block); claim != kNoClaim; claim = At(claim).next) {
      const auto other = static_cast<std::size_t>(At(claim).label);
      matters |= is_open_[other] != 0 && Meet(SetOf(claim, kOwned), wide, set_words_);
    }
    if (!matters) return;
    CompareRivals(block);
    const auto own =
        std::find_if(block_gains_.begin(), block_gains_.end(),
                     [label](const BlockGain& gain) { return gain.owner.label == label; });
    for (std::size_t k = 0; k < slot_size_; ++k) {
      if (owners_[k] == kNoLabel || next_labels_[k] != label) continue;
      gain_[static_cast<std::size_t>(owners_[k])] += static_cast<double>(
          unexplained * unexplained - own->residuals[k] * own->residuals[k]);
    }
  });
}

void PixelGrowth::DropUseless() {
  BoundGains();
  const std::size_t count = planes_.size();
  fewest_first_.resize(count);
  std::iota(fewest_first_.begin(), fewest_first_.end(), 0u);
  std::sort(fewest_first_.begin(), fewest_first_.end(), [&](std::size_t a, std::size_t b) {
    return pixels_[a] != pixels_[b] ? pixels_[a] < pixels_[b] : a < b;
  });
  gain_.assign(count, 0.0), is_open_.assign(count, 0), dropped_.assign(count, 0);
  for (std::size_t label = 0; label < count; ++label) {
    // More than what rounding of a sum could take away.
    constexpr double kSpare = 1e-6;
    const int n = std::max(pixels_[label], 1);
    if (least_gain_[label] >= (config_.min_gain + kSpare) * n) continue;
    is_open_[label] = 1;
    AddGains(static_cast<int>(label));
  }
  for (const std::size_t label : fewest_first_) {
    if (is_open_[label] == 0) continue;
    is_open_[label] = 0;
    if (gain_[label] >= config_.min_gain * std::max(pixels_[label], 1)) continue;
    dropped_[label] = 1;
    AddGainsWithout(static_cast<int>(label));
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
