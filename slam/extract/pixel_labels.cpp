#include "slam/extract/pixel_labels.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace slam {
namespace {

// A plane owning fewer pixels of a block than this does not spread from it: chance crossings of
// another surface with the plane's extension are thinner.
constexpr int kLeastPixelsToSpread = 4;

/// What each label gains over the next best plane at its pixels, and how that would change if
/// that plane were not there.
struct Gains {
  std::vector<double> gain;  ///< sum over the label's pixels
  std::vector<int> pixels;
  std::vector<double> without;  ///< [label][next best], increase
};

}  // namespace

PixelGrowth::PixelGrowth(const DepthGrid& grid, const GrowthConfig& config)
    : grid_(grid),
      config_(config),
      cols_((grid.width + config.block_px - 1) / config.block_px),
      rows_((grid.height + config.block_px - 1) / config.block_px),
      reached_(static_cast<std::size_t>(cols_ * rows_)),
      labels_(grid.q.size(), kNoLabel) {}

bool PixelGrowth::Reach(int block, int label) {
  std::vector<int>& at = reached_[static_cast<std::size_t>(block)];
  const auto place = std::lower_bound(at.begin(), at.end(), label);
  if (place != at.end() && *place == label) return false;
  at.insert(place, label);
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

/// Distances of the pixels of a block from one plane, and how many of them may belong to it.
int PixelGrowth::MeasureBlock(int u0, int v0, int u1, int v1, int label,
                              float* distance) const {
  const LabelPlane& plane = planes_[static_cast<std::size_t>(label)];
  const float farthest = static_cast<float>(config_.max_pixel_sigmas);
  int near = 0;
  for (int v = v0; v < v1; ++v) {
    const auto start = static_cast<std::size_t>(grid_.Index(u0, v));
    float* row = distance + (v - v0) * config_.block_px;
    for (int x = 0; x < u1 - u0; ++x) {
      const std::size_t i = start + static_cast<std::size_t>(x);
      // An unmeasured pixel has g = 0 and would seem to lie on every plane.
      const float r = std::abs(ResidualSigmas(grid_, i, plane));
      row[x] = grid_.g[i] > 0.0f ? r : std::numeric_limits<float>::infinity();
    }
    for (int x = 0; x < u1 - u0; ++x) near += row[x] < farthest ? 1 : 0;
  }
  return near;
}

/// Gives the pixels of a block to the nearest of its planes and counts what each owns, in the
/// order of reached_[block].
void PixelGrowth::LabelBlock(int block, std::vector<int>& owned) {
  const std::vector<int>& candidates = reached_[static_cast<std::size_t>(block)];
  const int size = config_.block_px;
  const int u0 = block % cols_ * size, v0 = block / cols_ * size;
  const int u1 = std::min(u0 + size, grid_.width), v1 = std::min(v0 + size, grid_.height);
  const auto area = static_cast<std::size_t>(size * size);
  owned.assign(candidates.size(), 0);
  distances_.resize(candidates.size() * area);
  rivals_.clear();
  rival_labels_.clear();
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    if (MeasureBlock(u0, v0, u1, v1, candidates[k], distances_.data() + k * area) == 0)
      continue;
    rivals_.push_back(k);
    rival_labels_.push_back(candidates[k]);
  }
  const bool contested = rivals_.size() > 1;
  if (contested) SumNeighbourCosts(u0, v0, u1, v1, rival_labels_);
  const float farthest = static_cast<float>(config_.max_pixel_sigmas);
  for (int v = v0; v < v1; ++v) {
    for (int u = u0; u < u1; ++u) {
      const auto at = static_cast<std::size_t>((v - v0) * size + u - u0);
      float least = std::numeric_limits<float>::infinity();
      int chosen = -1;
      for (std::size_t k = 0; k < rivals_.size(); ++k) {
        if (!(distances_[rivals_[k] * area + at] < farthest)) continue;
        const float cost = contested ? costs_[k * area + at] : 0.0f;
        if (cost < least) least = cost, chosen = static_cast<int>(k);
      }
      std::int16_t& label = labels_[static_cast<std::size_t>(grid_.Index(u, v))];
      label = kNoLabel;
      if (chosen < 0) continue;
      label = static_cast<std::int16_t>(rival_labels_[static_cast<std::size_t>(chosen)]);
      ++owned[rivals_[static_cast<std::size_t>(chosen)]];
    }
  }
}

/// costs_[candidate][pixel of the block]: squared distances of the pixels around it from the
/// candidate's plane, each cut off where a pixel no longer belongs.
void PixelGrowth::SumNeighbourCosts(int u0, int v0, int u1, int v1,
                                    const std::vector<int>& candidates) {
  const int size = config_.block_px, reach = config_.vote_reach_px;
  const int left = std::max(u0 - reach, 0), right = std::min(u1 + reach, grid_.width);
  const int top = std::max(v0 - reach, 0), bottom = std::min(v1 + reach, grid_.height);
  const int width = right - left;
  const float most = static_cast<float>(config_.max_pixel_sigmas * config_.max_pixel_sigmas);
  costs_.assign(candidates.size() * static_cast<std::size_t>(size * size), 0.0f);
  row_sums_.resize(static_cast<std::size_t>(size * (bottom - top)));
  cost_row_.resize(static_cast<std::size_t>(width));
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    const LabelPlane& plane = planes_[static_cast<std::size_t>(candidates[k])];
    for (int v = top; v < bottom; ++v) {
      const auto start = static_cast<std::size_t>(grid_.Index(left, v));
      for (int x = 0; x < width; ++x) {
        const float r = ResidualSigmas(grid_, start + static_cast<std::size_t>(x), plane);
        cost_row_[static_cast<std::size_t>(x)] = std::min(r * r, most);
      }
      for (int u = u0; u < u1; ++u) {
        const int from = std::max(u - reach, left), to = std::min(u + reach + 1, right);
        float sum = 0.0f;
        for (int x = from; x < to; ++x) sum += cost_row_[static_cast<std::size_t>(x - left)];
        row_sums_[static_cast<std::size_t>((v - top) * size + u - u0)] = sum;
      }
    }
    float* cost = costs_.data() + k * static_cast<std::size_t>(size * size);
    for (int v = v0; v < v1; ++v) {
      for (int y = std::max(v - reach, top); y < std::min(v + reach + 1, bottom); ++y) {
        for (int x = 0; x < u1 - u0; ++x) {
          cost[(v - v0) * size + x] +=
              row_sums_[static_cast<std::size_t>((y - top) * size + x)];
        }
      }
    }
  }
}

void PixelGrowth::Grow() {
  std::vector<int> owned;
  std::vector<std::pair<int, int>> spread;  // (block, label)
  // Each round adds at least one label to a block, so there are finitely many.
  while (!active_.empty()) {
    std::sort(active_.begin(), active_.end());
    active_.erase(std::unique(active_.begin(), active_.end()), active_.end());
    spread.clear();
    for (const int block : active_) {
      LabelBlock(block, owned);
      const int c = block % cols_, r = block / cols_;
      for (std::size_t k = 0; k < owned.size(); ++k) {
        if (owned[k] < kLeastPixelsToSpread) continue;
        const int label = reached_[static_cast<std::size_t>(block)][k];
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

void PixelGrowth::DropUseless() {
  Gains gains{std::vector<double>(planes_.size(), 0.0), std::vector<int>(planes_.size(), 0),
              std::vector<double>(planes_.size() * planes_.size(), 0.0)};
  const float unexplained = static_cast<float>(config_.max_pixel_sigmas + 1.0);
  for (int v = 0; v < grid_.height; ++v) {
    for (int u = 0; u < grid_.width; ++u) {
      const auto i = static_cast<std::size_t>(grid_.Index(u, v));
      if (labels_[i] == kNoLabel) continue;
      const auto label = static_cast<std::size_t>(labels_[i]);
      ++gains.pixels[label];
      const std::vector<int>& candidates = reached_[static_cast<std::size_t>(BlockAt(u, v))];
      if (candidates.size() == 1) {
        gains.gain[label] += static_cast<double>(unexplained * unexplained) - 1.0;
        continue;
      }
      float next = unexplained;
      int next_label = -1;
      for (const int other : candidates) {
        if (other == labels_[i]) continue;
        const float distance =
            std::abs(ResidualSigmas(grid_, i, planes_[static_cast<std::size_t>(other)]));
        if (distance < next) next = distance, next_label = other;
      }
      const float own = ResidualSigmas(grid_, i, planes_[label]);
      gains.gain[label] += static_cast<double>(next * next - own * own);
      if (next_label >= 0) {
        gains.without[label * planes_.size() + static_cast<std::size_t>(next_label)] +=
            static_cast<double>(unexplained * unexplained - next * next);
      }
    }
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
  if (!any) return;
  for (std::size_t block = 0; block < reached_.size(); ++block) {
    const auto gone =
        std::remove_if(reached_[block].begin(), reached_[block].end(),
                       [&](int label) { return dropped[static_cast<std::size_t>(label)]; });
    if (gone == reached_[block].end()) continue;
    reached_[block].erase(gone, reached_[block].end());
    active_.push_back(static_cast<int>(block));
  }
  Grow();
}

void PixelGrowth::Replace(std::vector<LabelPlane> planes, const std::vector<int>& into) {
  planes_ = std::move(planes);
  for (std::vector<int>& at : reached_) at.clear();
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

std::vector<PlaneSums> SumLabels(const DepthGrid& grid, const LabelImage& labels, int count) {
  std::vector<PlaneSums> sums(static_cast<std::size_t>(count));
  std::size_t i = 0;
  while (i < labels.size()) {
    const std::int16_t label = labels[i];
    if (label == kNoLabel) {
      ++i;
      continue;
    }
    PlaneSums run;  // sums of a run stay in registers
    for (; i < labels.size() && labels[i] == label; ++i) {
      const double g = static_cast<double>(grid.g[i]);
      run.Add(static_cast<double>(grid.x[i]), static_cast<double>(grid.y[i]),
              static_cast<double>(grid.q[i]), g * g);
    }
    sums[static_cast<std::size_t>(label)] += run;
  }
  return sums;
}

namespace {

int Root(std::vector<int>& parent, int i) {
  while (parent[static_cast<std::size_t>(i)] != i) {
    int& up = parent[static_cast<std::size_t>(i)];
    up = parent[static_cast<std::size_t>(up)];
    i = up;
  }
  return i;
}

/// The lower number becomes the root, so that a root is its component's first provisional one.
void Unite(std::vector<int>& parent, int i, int j) {
  i = Root(parent, i), j = Root(parent, j);
  parent[static_cast<std::size_t>(std::max(i, j))] = std::min(i, j);
}

/// Provisional numbers by runs; equal ones are united in `parent`.
std::vector<int> NumberRuns(const DepthGrid& grid, const LabelImage& labels,
                            std::vector<int>& parent) {
  std::vector<int> number(labels.size(), -1);
  for (int v = 0; v < grid.height; ++v) {
    for (int u = 0; u < grid.width; ++u) {
      const auto i = static_cast<std::size_t>(grid.Index(u, v));
      if (labels[i] == kNoLabel) continue;
      const bool left = u > 0 && labels[i - 1] == labels[i];
      const std::size_t above = v > 0 ? i - static_cast<std::size_t>(grid.width) : i;
      const bool up = v > 0 && labels[above] == labels[i];
      if (left) {
        number[i] = number[i - 1];
        if (up && number[above] != number[i]) Unite(parent, number[i], number[above]);
      } else if (up) {
        number[i] = number[above];
      } else {
        number[i] = static_cast<int>(parent.size());
        parent.push_back(number[i]);
      }
    }
  }
  return number;
}

}  // namespace

LabelComponents ConnectedComponents(const DepthGrid& grid, const LabelImage& labels,
                                    const std::vector<LabelPlane>& planes) {
  std::vector<int> parent;
  LabelComponents out;
  out.component = NumberRuns(grid, labels, parent);
  std::vector<int> compact(parent.size(), -1);
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (labels[i] == kNoLabel) continue;
    int& id = compact[static_cast<std::size_t>(Root(parent, out.component[i]))];
    if (id < 0) {
      id = static_cast<int>(out.list.size());
      out.list.push_back({labels[i], 0, static_cast<int>(i), 0, 0});
    }
    out.component[i] = id;
    ++out.list[static_cast<std::size_t>(id)].pixels;
  }
  const auto count_side = [&](std::size_t from, std::size_t to) {
    if (labels[from] == kNoLabel || labels[to] == labels[from] || !(grid.g[to] > 0)) return;
    LabelComponent& c = out.list[static_cast<std::size_t>(out.component[from])];
    const float residual = ResidualSigmas(grid, to, planes[static_cast<std::size_t>(c.label)]);
    ++(residual > 0 ? c.in_front : c.behind);
  };
  for (int v = 0; v < grid.height; ++v) {
    for (int u = 0; u < grid.width; ++u) {
      const auto i = static_cast<std::size_t>(grid.Index(u, v));
      if (u + 1 < grid.width) count_side(i, i + 1), count_side(i + 1, i);
      const std::size_t below = i + static_cast<std::size_t>(grid.width);
      if (v + 1 < grid.height) count_side(i, below), count_side(below, i);
    }
  }
  return out;
}

}  // namespace slam
