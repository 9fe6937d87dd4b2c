#include "slam/extract/pixel_growth.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "slam/base/lanes.h"
#include "slam/base/require.h"

namespace slam {
namespace {

// A plane owning fewer pixels of a block than this does not spread from it: chance crossings of
// another surface with the plane's extension are thinner.
constexpr int kLeastPixelsToSpread = 4;

/// Makes room; what is there stays. Grows by more than is asked, so that it soon no longer
/// does.
template <typename T>
void Provide(std::vector<T>& room, std::size_t size) {
  if (room.size() < size) room.resize(size + size / 2);
}

}  // namespace

void PixelGrowth::Begin(const DepthGrid& grid, const GrowthConfig& config) {
  Require(config.block_px >= 2 && config.block_px <= kMostBlockSide_px,
          "PixelGrowth: block_px outside [2, 64]");
  Require(config.vote_reach_px >= 0 && config.vote_reach_px <= kMostBidReach_px,
          "PixelGrowth: vote_reach_px outside [0, 16]");
  grid_ = &grid, config_ = config;
  cols_ = (grid.width + config.block_px - 1) / config.block_px;
  rows_ = (grid.height + config.block_px - 1) / config.block_px;
  const auto pixels = static_cast<std::size_t>(config.block_px * config.block_px);
  const auto blocks = static_cast<std::size_t>(cols_ * rows_);
  slot_size_ = (pixels + kLanes - 1) / kLanes * kLanes;
  words_ = (blocks + 63) / 64;
  planes_.clear(), claims_.clear(), reached_.clear();
  first_.assign(blocks, kNoClaim);
  active_.clear(), next_active_.clear(), is_active_.assign(blocks, 0);
  is_stale_.assign(blocks, 0), knows_gains_.assign(blocks, 0);
  labels_.assign(grid.q.size(), kNoLabel);
  bid_count_ = 0;
  owners_.resize(slot_size_), next_labels_.resize(slot_size_), gains_.resize(slot_size_);
}

int PixelGrowth::AddPlane(const LabelPlane& plane) {
  planes_.push_back(plane);
  reached_.resize(planes_.size() * words_, 0);
  return static_cast<int>(planes_.size()) - 1;
}

bool PixelGrowth::Reach(int block, int label) {
  std::uint64_t& bits = ReachedBits(block, label);
  const std::uint64_t bit = std::uint64_t{1} << (block % 64);
  if ((bits & bit) != 0) return false;
  bits |= bit;
  const int claim = static_cast<int>(claims_.size());
  claims_.push_back({label, kNoClaim, 0, -1, 0.0f, false, false, 0.0});
  int* link = &First(block);
  while (*link != kNoClaim && At(*link).label < label) link = &At(*link).next;
  At(claim).next = *link;
  *link = claim;
  return true;
}

void PixelGrowth::Activate(int block) {
  std::uint8_t& is_active = is_active_[static_cast<std::size_t>(block)];
  if (is_active == 0) active_.push_back(block), is_active = 1;
}

cv::Rect PixelGrowth::BlockArea(int block) const {
  const int size = config_.block_px;
  const int u = block % cols_ * size, v = block / cols_ * size;
  return {u, v, std::min(size, grid_->width - u), std::min(size, grid_->height - v)};
}

BlockPixels PixelGrowth::PixelsOf(const cv::Rect& area) const {
  return slam::BlockAt(*grid_, area.x, area.y, config_.block_px);
}

void PixelGrowth::Measure(const BlockPixels& pixels, int claim) {
  Provide(residuals_, static_cast<std::size_t>(claim + 1) * slot_size_);
  Claim& at = At(claim);
  const PixelPlane plane(planes_[static_cast<std::size_t>(at.label)]);
  at.measured = true;
  at.least = MeasureBlock(pixels, static_cast<int>(slot_size_), plane,
                          residuals_.data() + static_cast<std::size_t>(claim) * slot_size_);
}

void PixelGrowth::Bid(const BlockPixels& pixels, const cv::Rect& area, int claim) {
  Claim& at = At(claim);
  at.bid = static_cast<int>(bid_count_++);
  Provide(bids_, bid_count_ * slot_size_);
  const int reach = config_.vote_reach_px;
  const BidWindow window{reach,
                         std::min(reach, area.x),
                         std::min(reach, area.y),
                         std::min(reach, grid_->width - area.x - area.width),
                         std::min(reach, grid_->height - area.y - area.height),
                         static_cast<float>(config_.max_pixel_sigmas)};
  BidForBlock(pixels, static_cast<int>(slot_size_),
              PixelPlane(planes_[static_cast<std::size_t>(at.label)]), window,
              ResidualsOf(claim), bids_.data() + static_cast<std::size_t>(at.bid) * slot_size_);
}

/// The claims of a block with a pixel nearer than that, by label, measured.
void PixelGrowth::GatherRivals(int block, float nearer_than) {
  rivals_.clear(), rival_claims_.clear();
  for (int claim = First(block); claim != kNoClaim; claim = At(claim).next) {
    if (At(claim).least < nearer_than) rival_claims_.push_back(claim);
  }
  for (const int claim : rival_claims_)
    rivals_.push_back({At(claim).label, ResidualsOf(claim), nullptr, 0, 0.0});
}

/// Gives the pixels of a block to the nearest of its planes and counts what each gets.
/// @returns whether anything has changed.
bool PixelGrowth::LabelBlock(int block) {
  const cv::Rect area = BlockArea(block);
  const BlockPixels pixels = PixelsOf(area);
  const auto farthest = static_cast<float>(config_.max_pixel_sigmas);
  std::uint8_t& is_stale = is_stale_[static_cast<std::size_t>(block)];
  for (int claim = First(block); claim != kNoClaim; claim = At(claim).next) {
    if (At(claim).measured) continue;
    Measure(pixels, claim);
    knows_gains_[static_cast<std::size_t>(block)] = 0;
    if (At(claim).least < farthest) is_stale = 1;
  }
  if (is_stale == 0) return false;
  is_stale = 0;
  knows_gains_[static_cast<std::size_t>(block)] = 0;
  for (int claim = First(block); claim != kNoClaim; claim = At(claim).next)
    At(claim).pixels = 0;
  GatherRivals(block, farthest);
  if (rivals_.size() > 1) {
    for (const int claim : rival_claims_) {
      if (At(claim).bid < 0) Bid(pixels, area, claim);
    }
    for (std::size_t k = 0; k < rivals_.size(); ++k) {
      const auto bid = static_cast<std::size_t>(At(rival_claims_[k]).bid);
      rivals_[k].bids = bids_.data() + bid * slot_size_;
    }
  }
  ClaimBlock(rivals_.data(), static_cast<int>(rivals_.size()), static_cast<int>(slot_size_),
             farthest, owners_.data());
  for (std::size_t k = 0; k < rivals_.size(); ++k)
    At(rival_claims_[k]).pixels = rivals_[k].pixels;
  WriteOwners(pixels, owners_.data(),
              labels_.data() + static_cast<std::size_t>(grid_->Index(area.x, area.y)));
  return true;
}

/// Whether a label has reached a block and all its neighbours, so that it cannot spread.
bool PixelGrowth::HasReachedAround(int block, int label) const {
  const int c = block % cols_, r = block / cols_;
  const int first = std::max(c - 1, 0), count = std::min(c + 1, cols_ - 1) - first + 1;
  const std::uint64_t all = (std::uint64_t{1} << count) - 1;
  const std::uint64_t* words = reached_.data() + static_cast<std::size_t>(label) * words_;
  for (int y = std::max(r - 1, 0); y <= std::min(r + 1, rows_ - 1); ++y) {
    const int at = y * cols_ + first, shift = at % 64;
    const std::uint64_t* word = words + at / 64;
    std::uint64_t bits = *word >> shift;
    if (shift + count > 64) bits |= word[1] << (64 - shift);
    if ((bits & all) != all) return false;
  }
  return true;
}

void PixelGrowth::SpreadFrom(int block) {
  const int c = block % cols_, r = block / cols_;
  for (int claim = First(block); claim != kNoClaim; claim = At(claim).next) {
    if (At(claim).spread || At(claim).pixels < kLeastPixelsToSpread) continue;
    At(claim).spread = true;
    const int label = At(claim).label;
    if (HasReachedAround(block, label)) continue;
    for (int y = std::max(r - 1, 0); y <= std::min(r + 1, rows_ - 1); ++y) {
      for (int x = std::max(c - 1, 0); x <= std::min(c + 1, cols_ - 1); ++x) {
        Seed(y * cols_ + x, label);
      }
    }
  }
}

void PixelGrowth::Grow() {
  // Each round adds at least one label to a block, so there are finitely many.
  while (!active_.empty()) {
    std::swap(active_, next_active_);
    active_.clear();
    const auto unchanged = [&](int block) {
      is_active_[static_cast<std::size_t>(block)] = 0;
      return !LabelBlock(block);
    };
    next_active_.erase(std::remove_if(next_active_.begin(), next_active_.end(), unchanged),
                       next_active_.end());
    for (const int block : next_active_) SpreadFrom(block);
  }
}

/// What its owner gains at each pixel of a block, over whom.
void PixelGrowth::CompareRivals(int block, float unexplained) {
  GatherRivals(block, unexplained);
  const cv::Rect area = BlockArea(block);
  ReadOwners(PixelsOf(area), static_cast<int>(slot_size_),
             labels_.data() + static_cast<std::size_t>(grid_->Index(area.x, area.y)),
             owners_.data());
  GainsOfBlock(rivals_.data(), static_cast<int>(rivals_.size()), static_cast<int>(slot_size_),
               unexplained, owners_.data(), gains_.data(), next_labels_.data());
}

/// Adds the gains of the pixels of one block.
void PixelGrowth::AddGains(int block) {
  if (First(block) == kNoClaim) return;
  const float unexplained = static_cast<float>(config_.max_pixel_sigmas + 1.0);
  if (At(First(block)).next == kNoClaim) {  // nobody asks how well it fits
    const Claim& only = At(First(block));
    const auto label = static_cast<std::size_t>(only.label);
    pixels_[label] += only.pixels;
    gain_[label] += static_cast<double>(unexplained * unexplained - 1.0f) * only.pixels;
    return;
  }
  std::uint8_t& known = knows_gains_[static_cast<std::size_t>(block)];
  if (known == 0) {
    CompareRivals(block, unexplained);
    for (int claim = First(block); claim != kNoClaim; claim = At(claim).next)
      At(claim).gain = 0.0;
    for (std::size_t k = 0; k < rivals_.size(); ++k)
      At(rival_claims_[k]).gain = rivals_[k].gain;
    known = 1;
  }
  for (int claim = First(block); claim != kNoClaim; claim = At(claim).next) {
    const auto label = static_cast<std::size_t>(At(claim).label);
    pixels_[label] += At(claim).pixels;
    gain_[label] += At(claim).gain;
  }
}

/// Adds what others gain at pixels where `label`'s plane is the next best, if it is not there.
void PixelGrowth::AddGainsWithout(int label) {
  const float unexplained = static_cast<float>(config_.max_pixel_sigmas + 1.0);
  for (int block = 0; block < cols_ * rows_; ++block) {
    const std::uint64_t bits = ReachedBits(block, label);
    if (bits == 0) block |= 63;  // none of these 64
    if ((bits >> (block % 64) & 1) == 0) continue;
    CompareRivals(block, unexplained);
    const auto own = std::find_if(rivals_.begin(), rivals_.end(),
                                  [label](const BlockRival& r) { return r.label == label; });
    if (own == rivals_.end()) continue;
    for (std::size_t k = 0; k < slot_size_; ++k) {
      if (owners_[k] == kNoLabel || next_labels_[k] != label) continue;
      gain_[static_cast<std::size_t>(owners_[k])] += static_cast<double>(
          unexplained * unexplained - own->residuals[k] * own->residuals[k]);
    }
  }
}

void PixelGrowth::DropUseless() {
  gain_.assign(planes_.size(), 0.0), pixels_.assign(planes_.size(), 0);
  for (int block = 0; block < cols_ * rows_; ++block) AddGains(block);
  fewest_first_.resize(planes_.size());
  std::iota(fewest_first_.begin(), fewest_first_.end(), 0u);
  std::sort(fewest_first_.begin(), fewest_first_.end(), [&](std::size_t a, std::size_t b) {
    return pixels_[a] != pixels_[b] ? pixels_[a] < pixels_[b] : a < b;
  });
  dropped_.assign(planes_.size(), 0);
  for (const std::size_t label : fewest_first_) {
    if (gain_[label] >= config_.min_gain * std::max(pixels_[label], 1)) continue;
    dropped_[label] = 1;
    AddGainsWithout(static_cast<int>(label));
  }
  Drop();
}

void PixelGrowth::Unlink(int block, int label) {
  int* link = &First(block);
  while (At(*link).label != label) link = &At(*link).next;
  *link = At(*link).next;
}

void PixelGrowth::Drop() {
  for (int label = 0; label < static_cast<int>(dropped_.size()); ++label) {
    if (dropped_[static_cast<std::size_t>(label)] == 0) continue;
    for (int block = 0; block < cols_ * rows_; ++block) {
      std::uint64_t& bits = ReachedBits(block, label);
      if ((bits >> (block % 64) & 1) == 0) continue;
      bits &= ~(std::uint64_t{1} << (block % 64));
      Unlink(block, label);
      Activate(block);
      is_stale_[static_cast<std::size_t>(block)] = 1;
    }
  }
  Grow();
}

void PixelGrowth::Replace(const std::vector<LabelPlane>& planes, const std::vector<int>& into) {
  seeds_.clear();
  for (int block = 0; block < cols_ * rows_; ++block) {
    for (int claim = First(block); claim != kNoClaim; claim = At(claim).next) {
      if (At(claim).pixels > 0)
        seeds_.emplace_back(block, into[static_cast<std::size_t>(At(claim).label)]);
    }
  }
  planes_ = planes;
  claims_.clear();
  bid_count_ = 0;
  reached_.assign(planes_.size() * words_, 0);
  std::fill(first_.begin(), first_.end(), kNoClaim);
  std::fill(is_stale_.begin(), is_stale_.end(), 1);
  for (const auto& [block, label] : seeds_) Seed(block, label);
  Grow();
}

void PixelGrowth::MarkSettled(double bias, double standard_errors,
                              std::vector<std::uint8_t>& settled) const {
  settled.assign(labels_.size(), 0);
  for (int block = 0; block < cols_ * rows_; ++block) {
    const cv::Rect area = BlockArea(block);
    const BlockPixels pixels = PixelsOf(area);
    const auto start = static_cast<std::size_t>(grid_->Index(area.x, area.y));
    bool read = false;
    for (int claim = First(block); claim != kNoClaim; claim = At(claim).next) {
      const int n = At(claim).pixels, label = At(claim).label;
      if (n == 0) continue;
      if (!read) {
        ReadOwners(pixels, static_cast<int>(slot_size_), labels_.data() + start,
                   owners_.data());
        read = true;
      }
      const double sum =
          SumOwned(ResidualsOf(claim), static_cast<int>(slot_size_), label, owners_.data());
      const double bound = bias + standard_errors / std::sqrt(static_cast<double>(n));
      if (!(std::abs(sum) < bound * n)) continue;
      MarkOwned(pixels, label, owners_.data(), settled.data() + start);
    }
  }
}

}  // namespace slam
