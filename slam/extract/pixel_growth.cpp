#include "slam/extract/pixel_growth.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace slam {
namespace {

constexpr float kNone = std::numeric_limits<float>::infinity();

// A plane owning fewer pixels of a block than this does not spread from it: chance crossings of
// another surface with the plane's extension are thinner.
constexpr int kLeastPixelsToSpread = 4;

}  // namespace

PixelGrowth::PixelGrowth(const DepthGrid& grid, const GrowthConfig& config)
    : grid_(grid),
      config_(config),
      cols_((grid.width + config.block_px - 1) / config.block_px),
      rows_((grid.height + config.block_px - 1) / config.block_px),
      slot_size_(static_cast<std::size_t>(config.block_px * config.block_px)),
      reached_(static_cast<std::size_t>(cols_ * rows_)),
      labels_(grid.q.size(), kNoLabel) {}

bool PixelGrowth::Reach(int block, int label) {
  std::vector<Claim>& at = reached_[static_cast<std::size_t>(block)];
  const auto place =
      std::lower_bound(at.begin(), at.end(), label,
                       [](const Claim& claim, int other) { return claim.label < other; });
  if (place != at.end() && place->label == label) return false;
  at.insert(place, Claim{label, 0, false, false, false});
  return true;
}

int PixelGrowth::AddPlane(const LabelPlane& plane, const std::vector<int>& blocks) {
  const int label = static_cast<int>(planes_.size());
  planes_.push_back(plane);
  for (const int block : blocks) {
    if (Reach(block, label)) active_.push_back(block);
  }
  return label;
}

cv::Rect PixelGrowth::BlockArea(int block) const {
  const int size = config_.block_px;
  const int u = block % cols_ * size, v = block / cols_ * size;
  return {u, v, std::min(size, grid_.width - u), std::min(size, grid_.height - v)};
}

void PixelGrowth::Measure(const cv::Rect& area, Claim& claim) {
  claim.slot = distances_.size() / slot_size_;
  claim.measured = true;
  distances_.resize(distances_.size() + slot_size_, kNone);
  const LabelPlane plane = planes_[static_cast<std::size_t>(claim.label)];
  float* distances = distances_.data() + claim.slot * slot_size_;
  for (int y = 0; y < area.height; ++y) {
    const auto start = static_cast<std::size_t>(grid_.Index(area.x, area.y + y));
    float* row = distances + y * config_.block_px;
    for (int x = 0; x < area.width; ++x) {
      const std::size_t i = start + static_cast<std::size_t>(x);
      // An unmeasured pixel has g = 0 and would seem to lie on every plane.
      const float r = std::abs(ResidualSigmas(grid_, i, plane));
      row[x] = grid_.g[i] > 0.0f ? r : kNone;
    }
  }
  const float farthest = static_cast<float>(config_.max_pixel_sigmas);
  claim.near = std::any_of(distances, distances + slot_size_,
                           [farthest](float distance) { return distance < farthest; });
}

void PixelGrowth::Bid(const cv::Rect& area, Claim& claim) {
  claim.bidding = true;
  const int size = config_.block_px, reach = config_.vote_reach_px;
  const int top = std::max(area.y - reach, 0);
  const int bottom = std::min(area.y + area.height + reach, grid_.height);
  const int left = std::max(area.x - reach, 0);
  const int right = std::min(area.x + area.width + reach, grid_.width);
  const LabelPlane plane = planes_[static_cast<std::size_t>(claim.label)];
  const float most = static_cast<float>(config_.max_pixel_sigmas * config_.max_pixel_sigmas);
  // Zeros stand where the image ends.
  squares_.assign(static_cast<std::size_t>(size + 2 * reach), 0.0f);
  row_sums_.assign(static_cast<std::size_t>(size * (size + 2 * reach)), 0.0f);
  for (int v = top; v < bottom; ++v) {
    const auto start = static_cast<std::size_t>(grid_.Index(left, v));
    float* squares = squares_.data() + (left - (area.x - reach));
    for (int x = 0; x < right - left; ++x) {
      const float r = ResidualSigmas(grid_, start + static_cast<std::size_t>(x), plane);
      squares[x] = std::min(r * r, most);
    }
    float* sums = row_sums_.data() + (v - (area.y - reach)) * size;
    for (int offset = 0; offset <= 2 * reach; ++offset) {
      for (int x = 0; x < size; ++x) sums[x] += squares_[static_cast<std::size_t>(x + offset)];
    }
  }
  bids_.resize(distances_.size());
  float* bids = bids_.data() + claim.slot * slot_size_;
  std::fill(bids, bids + slot_size_, 0.0f);
  for (int y = 0; y < area.height; ++y) {
    for (int offset = 0; offset <= 2 * reach; ++offset) {
      const float* sums = row_sums_.data() + (y + offset) * size;
      for (int x = 0; x < size; ++x) bids[y * size + x] += sums[x];
    }
  }
  const float farthest = static_cast<float>(config_.max_pixel_sigmas);
  const float* distances = distances_.data() + claim.slot * slot_size_;
  for (std::size_t k = 0; k < slot_size_; ++k)
    bids[k] = distances[k] < farthest ? bids[k] : kNone;
}

/// Gives the pixels of a block to the nearest of its planes and counts in owned_ what each
/// gets, in the order of reached_[block].
void PixelGrowth::LabelBlock(int block) {
  std::vector<Claim>& claims = reached_[static_cast<std::size_t>(block)];
  const cv::Rect area = BlockArea(block);
  rivals_.clear();
  for (Claim& claim : claims) {
    if (!claim.measured) Measure(area, claim);
    if (claim.near) rivals_.push_back(&claim);
  }
  winner_.assign(slot_size_, kNoLabel);
  if (rivals_.size() == 1) ClaimUncontested(*rivals_.front());
  if (rivals_.size() > 1) ClaimContested(area);
  owned_.assign(claims.size(), 0);
  for (int y = 0; y < area.height; ++y) {
    const std::int16_t* winner = winner_.data() + y * config_.block_px;
    std::int16_t* labels =
        labels_.data() + static_cast<std::size_t>(grid_.Index(area.x, area.y + y));
    for (int x = 0; x < area.width; ++x) labels[x] = winner[x];
  }
  for (const Claim* rival : rivals_) {
    const auto label = static_cast<std::int16_t>(rival->label);
    owned_[static_cast<std::size_t>(rival - claims.data())] =
        static_cast<int>(std::count(winner_.begin(), winner_.end(), label));
  }
}

void PixelGrowth::ClaimUncontested(const Claim& only) {
  const float farthest = static_cast<float>(config_.max_pixel_sigmas);
  const float* distances = distances_.data() + only.slot * slot_size_;
  const auto label = static_cast<std::int16_t>(only.label);
  for (std::size_t k = 0; k < slot_size_; ++k) {
    winner_[k] = distances[k] < farthest ? label : kNoLabel;
  }
}

void PixelGrowth::ClaimContested(const cv::Rect& area) {
  least_.assign(slot_size_, kNone);
  for (Claim* rival : rivals_) {
    if (!rival->bidding) Bid(area, *rival);
    const float* bids = bids_.data() + rival->slot * slot_size_;
    const auto label = static_cast<std::int16_t>(rival->label);
    for (std::size_t k = 0; k < slot_size_; ++k) {
      const bool better = bids[k] < least_[k];
      least_[k] = better ? bids[k] : least_[k];
      winner_[k] = better ? label : winner_[k];
    }
  }
}

void PixelGrowth::Grow() {
  std::vector<std::pair<int, int>> spread;  // (block, label)
  // Each round adds at least one label to a block, so there are finitely many.
  while (!active_.empty()) {
    std::sort(active_.begin(), active_.end());
    active_.erase(std::unique(active_.begin(), active_.end()), active_.end());
    spread.clear();
    for (const int block : active_) {
      LabelBlock(block);
      const int c = block % cols_, r = block / cols_;
      for (std::size_t k = 0; k < owned_.size(); ++k) {
        if (owned_[k] < kLeastPixelsToSpread) continue;
        const int label = reached_[static_cast<std::size_t>(block)][k].label;
        for (int y = std::max(r - 1, 0); y <= std::min(r + 1, rows_ - 1); ++y) {
          for (int x = std::max(c - 1, 0); x <= std::min(c + 1, cols_ - 1); ++x) {
            spread.emplace_back(y * cols_ + x, label);
          }
        }
      }
    }
    active_.clear();
    for (const auto& [block, label] : spread) {
      if (Reach(block, label)) active_.push_back(block);
    }
  }
}

/// Adds the gains of the pixels of one block.
void PixelGrowth::AddGains(int block, Gains& gains) {
  const std::vector<Claim>& claims = reached_[static_cast<std::size_t>(block)];
  const cv::Rect area = BlockArea(block);
  const float unexplained = static_cast<float>(config_.max_pixel_sigmas + 1.0);
  winner_.assign(slot_size_, kNoLabel);  // the label of each pixel
  for (int y = 0; y < area.height; ++y) {
    const auto start = static_cast<std::size_t>(grid_.Index(area.x, area.y + y));
    for (int x = 0; x < area.width; ++x) {
      winner_[static_cast<std::size_t>(y * config_.block_px + x)] =
          labels_[start + static_cast<std::size_t>(x)];
    }
  }
  own_.assign(slot_size_, 0.0f);
  next_.assign(slot_size_, unexplained);
  next_label_.assign(slot_size_, kNoLabel);
  for (const Claim& claim : claims) {
    const float* distances = distances_.data() + claim.slot * slot_size_;
    const auto label = static_cast<std::int16_t>(claim.label);
    for (std::size_t k = 0; k < slot_size_; ++k) {
      const bool owns = winner_[k] == label;
      const bool nearer = !owns && distances[k] < next_[k];
      own_[k] = owns ? distances[k] : own_[k];
      next_[k] = nearer ? distances[k] : next_[k];
      next_label_[k] = nearer ? label : next_label_[k];
    }
  }
  for (std::size_t k = 0; k < slot_size_; ++k) {
    if (winner_[k] == kNoLabel) continue;
    const auto label = static_cast<std::size_t>(winner_[k]);
    ++gains.pixels[label];
    const float own = claims.size() > 1 ? own_[k] : 1.0f;  // nobody asks how well it fits
    gains.gain[label] += static_cast<double>(next_[k] * next_[k] - own * own);
    if (next_label_[k] == kNoLabel) continue;
    gains.without[label * planes_.size() + static_cast<std::size_t>(next_label_[k])] +=
        static_cast<double>(unexplained * unexplained - next_[k] * next_[k]);
  }
}

void PixelGrowth::DropUseless() {
  Gains gains{std::vector<double>(planes_.size(), 0.0), std::vector<int>(planes_.size(), 0),
              std::vector<double>(planes_.size() * planes_.size(), 0.0)};
  for (std::size_t block = 0; block < reached_.size(); ++block) {
    if (!reached_[block].empty()) AddGains(static_cast<int>(block), gains);
  }
  std::vector<std::size_t> order(planes_.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return gains.pixels[a] < gains.pixels[b];
  });
  std::vector<bool> dropped(planes_.size(), false);
  bool any = false;
  for (const std::size_t label : order) {
    if (gains.gain[label] >= config_.min_gain * std::max(gains.pixels[label], 1)) continue;
    dropped[label] = any = true;
    for (std::size_t other = 0; other < planes_.size(); ++other) {
      gains.gain[other] += gains.without[other * planes_.size() + label];
    }
  }
  if (any) Drop(dropped);
}

void PixelGrowth::Drop(const std::vector<bool>& dropped) {
  for (std::size_t block = 0; block < reached_.size(); ++block) {
    const auto gone = std::erase_if(reached_[block], [&](const Claim& claim) {
      return dropped[static_cast<std::size_t>(claim.label)];
    });
    if (gone > 0) active_.push_back(static_cast<int>(block));
  }
  Grow();
}

void PixelGrowth::Replace(std::vector<LabelPlane> planes, const std::vector<int>& into) {
  planes_ = std::move(planes);
  for (std::vector<Claim>& at : reached_) at.clear();
  distances_.clear();
  bids_.clear();
  for (int v = 0; v < grid_.height; ++v) {
    std::int16_t last = kNoLabel;
    int last_block = -1;
    for (int u = 0; u < grid_.width; ++u) {
      const std::int16_t label = labels_[static_cast<std::size_t>(grid_.Index(u, v))];
      const int block = BlockAt(u, v);
      if (label == kNoLabel || (label == last && block == last_block)) continue;
      if (Reach(block, into[static_cast<std::size_t>(label)])) active_.push_back(block);
      last = label, last_block = block;
    }
  }
  std::fill(labels_.begin(), labels_.end(), kNoLabel);
  Grow();
}

}  // namespace slam
