#include "slam/segment/pixel_growth.h"

#include <algorithm>
#include <bit>
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
  set_words_ = WordsOfSet(config.block_px);
  planes_.clear(), pixel_planes_.clear(), claims_.clear();
  first_.assign(blocks, kNoClaim);
  active_.clear(), next_active_.clear(), is_active_.assign(blocks, 0);
  is_stale_.assign(blocks, 0), is_drawn_.assign(blocks, 0);
  labels_.resize(grid.q.size());
  bid_count_ = 0;
  nearest_.resize(2 * slot_size_);
  contested_.resize(set_words_), unsettled_.resize(set_words_);
  BeginReached();
  place_.clear(), blocks_.clear();
  measured_.resize(blocks * set_words_);
  for (int r = 0; r < rows_; ++r) {
    for (int c = 0; c < cols_; ++c) {
      const std::size_t block = place_.size();
      const int size = config.block_px;
      place_.emplace_back(c, r);
      blocks_.push_back(slam::BlockAt(grid, c * size, r * size, size));
      FindMeasured(blocks_.back(), measured_.data() + block * set_words_);
    }
  }
}

/// What a label that has reached nothing begins with: the margin around the blocks, a column
/// and a row wide and more on the right.
void PixelGrowth::BeginReached() {
  reached_.clear(), reached_rows_.clear();
  row_bytes_ = static_cast<std::size_t>(cols_ + 2 + 7) / 8;
  // Three bits are read from two bytes, so one more follows.
  label_bytes_ = row_bytes_ * static_cast<std::size_t>(rows_ + 2) + 1;
  nothing_reached_.assign(label_bytes_, 0xff);
  for (int r = 0; r < rows_; ++r) {
    for (unsigned c = 1; c <= static_cast<unsigned>(cols_); ++c)
      nothing_reached_[ReachedRow(r, 0) + c / 8] &= static_cast<std::uint8_t>(~(1u << c % 8));
  }
}

int PixelGrowth::AddPlane(const LabelPlane& plane) {
  planes_.push_back(plane), pixel_planes_.emplace_back(plane);
  reached_.insert(reached_.end(), nothing_reached_.begin(), nothing_reached_.end());
  reached_rows_.push_back({rows_, -1});
  return static_cast<int>(planes_.size()) - 1;
}

bool PixelGrowth::Reach(int block, int label) {
  const cv::Point place = PlaceOf(block);
  const auto c = static_cast<unsigned>(place.x + 1);
  std::uint8_t& bits = reached_[ReachedRow(place.y, label) + c / 8];
  const unsigned bit = 1u << c % 8;
  if ((bits & bit) != 0) return false;
  bits = static_cast<std::uint8_t>(bits | bit);
  Rows& rows = reached_rows_[static_cast<std::size_t>(label)];
  rows = {std::min(rows.first, place.y), std::max(rows.last, place.y)};
  const int claim = static_cast<int>(claims_.size());
  claims_.push_back({});
  Provide(sets_, claims_.size() * kSetCount * set_words_);
  int* link = &First(block);
  while (*link != kNoClaim && At(*link).label < label) link = &At(*link).next;
  At(claim).label = label;
  At(claim).next = *link;
  *link = claim;
  return true;
}

/// The blocks around one, and itself, that a label has not reached: three bits a row.
unsigned PixelGrowth::NotReachedAround(cv::Point place, int label) const {
  const auto c = static_cast<unsigned>(place.x);  // of the block to the left, after the margin
  const std::uint8_t* row = reached_.data() + ReachedRow(place.y - 1, label) + c / 8;
  unsigned reached = 0;
  for (unsigned r = 0; r < 3; ++r, row += row_bytes_) {
    const unsigned bits = row[0] | static_cast<unsigned>(row[1]) << 8;
    reached |= (bits >> c % 8 & 7u) << 3 * r;
  }
  return ~reached & 0x1ffu;
}

void PixelGrowth::Activate(int block) {
  std::uint8_t& is_active = is_active_[static_cast<std::size_t>(block)];
  if (is_active == 0) active_.push_back(block), is_active = 1;
}

/// @returns whether a pixel is near.
bool PixelGrowth::Measure(const BlockPixels& pixels, int block, int claim) {
  Claim& at = At(claim);
  at.near = FindNear(pixels, PlaneOf(claim), MeasuredOf(block), NearSigmas(), WideSigmas(),
                     SetOf(claim, kNear), SetOf(claim, kWide));
  at.measured = true;
  return at.near > 0;
}

void PixelGrowth::Bid(const BlockPixels& pixels, int block, int claim) {
  At(claim).bid = static_cast<int>(bid_count_++);
  Provide(bids_, bid_count_ * slot_size_);
  const cv::Point first = PlaceOf(block) * config_.block_px;
  const int reach = config_.vote_reach_px;
  const BidWindow window{reach,
                         std::min(reach, first.x),
                         std::min(reach, first.y),
                         std::min(reach, grid_->width - first.x - pixels.width),
                         std::min(reach, grid_->height - first.y - pixels.height),
                         NearSigmas()};
  BidForBlock(pixels, static_cast<int>(slot_size_), PlaneOf(claim), window, SetOf(claim, kNear),
              BidsOf(claim));
}

/// The pixels of a block that more than one claim has in that set.
void PixelGrowth::FindContested(int block, Set set) {
  for (std::size_t k = 0; k < set_words_; ++k) {
    std::uint64_t seen = 0, contested = 0;
    for (int claim = First(block); claim != kNoClaim; claim = At(claim).next) {
      const std::uint64_t has = SetOf(claim, set)[k];
      contested |= seen & has, seen |= has;
    }
    contested_[k] = contested;
  }
}

/// Gives the pixels of a block to the nearest of its planes and counts what each gets.
void PixelGrowth::Share(const BlockPixels& pixels, int block) {
  FindContested(block, kNear);
  const bool is_contested = !IsEmpty(contested_.data(), set_words_);
  rival_claims_.clear();
  for (int claim = First(block); claim != kNoClaim; claim = At(claim).next) {
    const ConstPixelSet near = SetOf(claim, kNear);
    if (is_contested && Meet(near, contested_.data(), set_words_)) {
      if (At(claim).bid < 0) Bid(pixels, block, claim);
      rival_claims_.push_back(claim);
    } else {
      Copy(near, SetOf(claim, kOwned), set_words_);
      At(claim).pixels = At(claim).near;
    }
  }
  if (!is_contested) return;
  rivals_.resize(rival_claims_.size());
  for (std::size_t r = 0; r < rivals_.size(); ++r) {
    const int claim = rival_claims_[r];
    rivals_[r] = {SetOf(claim, kNear), BidsOf(claim), SetOf(claim, kOwned), 0};
  }
  ShareBlock(rivals_.data(), static_cast<int>(rivals_.size()), config_.block_px);
  for (std::size_t r = 0; r < rivals_.size(); ++r)
    At(rival_claims_[r]).pixels = rivals_[r].pixels;
}

/// @returns whether anything has changed.
bool PixelGrowth::LabelBlock(int block) {
  const BlockPixels& pixels = PixelsOf(block);
  std::uint8_t& is_stale = is_stale_[static_cast<std::size_t>(block)];
  const int first = First(block);
  for (int claim = first; claim != kNoClaim; claim = At(claim).next) {
    if (!At(claim).measured && Measure(pixels, block, claim)) is_stale = 1;
  }
  if (is_stale == 0) return false;
  is_stale = 0;
  is_drawn_[static_cast<std::size_t>(block)] = 0;
  if (first == kNoClaim) return true;
  if (At(first).next == kNoClaim) {
    Copy(SetOf(first, kNear), SetOf(first, kOwned), set_words_);
    At(first).pixels = At(first).near;
  } else {
    Share(pixels, block);
  }
  return true;
}

void PixelGrowth::SpreadFrom(int block) {
  const cv::Point place = PlaceOf(block);
  for (int claim = First(block); claim != kNoClaim; claim = At(claim).next) {
    if (At(claim).spread || At(claim).pixels < kLeastPixelsToSpread) continue;
    At(claim).spread = true;
    const int label = At(claim).label;
    for (unsigned bits = NotReachedAround(place, label); bits != 0; bits &= bits - 1) {
      const int k = std::countr_zero(bits);
      Seed(block + (k / 3 - 1) * cols_ + k % 3 - 1, label);
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

void PixelGrowth::Unlink(int block, int label) {
  int* link = &First(block);
  while (At(*link).label != label) link = &At(*link).next;
  *link = At(*link).next;
}

void PixelGrowth::Replace(const std::vector<LabelPlane>& planes, const std::vector<int>& into) {
  seeds_.clear();
  for (int block = 0; block < cols_ * rows_; ++block) {
    for (int claim = First(block); claim != kNoClaim; claim = At(claim).next) {
      if (At(claim).pixels > 0)
        seeds_.emplace_back(block, into[static_cast<std::size_t>(At(claim).label)]);
    }
  }
  planes_.clear(), pixel_planes_.clear(), claims_.clear();
  reached_.clear(), reached_rows_.clear();
  for (const LabelPlane& plane : planes) AddPlane(plane);
  bid_count_ = 0;
  std::fill(first_.begin(), first_.end(), kNoClaim);
  std::fill(is_stale_.begin(), is_stale_.end(), 1);
  for (const auto& [block, label] : seeds_) Seed(block, label);
  Grow();
}

const LabelImage& PixelGrowth::labels() const {
  for (int block = 0; block < cols_ * rows_; ++block) {
    std::uint8_t& is_drawn = is_drawn_[static_cast<std::size_t>(block)];
    if (is_drawn != 0) continue;
    is_drawn = 1;
    block_owners_.clear();
    for (int claim = First(block); claim != kNoClaim; claim = At(claim).next) {
      if (At(claim).pixels > 0)
        block_owners_.push_back({At(claim).label, SetOf(claim, kOwned)});
    }
    DrawOwners(PixelsOf(block), block_owners_.data(), static_cast<int>(block_owners_.size()),
               labels_.data() + IndexOf(block));
  }
  return labels_;
}

void PixelGrowth::MarkSettled(double bias, double standard_errors,
                              std::vector<std::uint8_t>& settled) {
  settled.assign(labels_.size(), 1);
  for (int block = 0; block < cols_ * rows_; ++block) {
    const BlockPixels& pixels = PixelsOf(block);
    const PixelSet unsettled = unsettled_.data();
    Copy(MeasuredOf(block), unsettled, set_words_);
    for (int claim = First(block); claim != kNoClaim; claim = At(claim).next) {
      const int n = At(claim).pixels;
      if (n == 0) continue;
      const ConstPixelSet owned = SetOf(claim, kOwned);
      const double sum = SumResiduals(pixels, PlaneOf(claim), owned);
      const double bound = bias + standard_errors / std::sqrt(static_cast<double>(n));
      if (std::abs(sum) < bound * n) TakeOut(owned, unsettled, set_words_);
    }
    if (!IsEmpty(unsettled, set_words_))
      ClearMarks(pixels, unsettled, settled.data() + IndexOf(block));
  }
}

}  // namespace slam
