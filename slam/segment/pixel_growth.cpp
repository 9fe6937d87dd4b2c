#include "slam/segment/pixel_growth.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "slam/base/require.h"
#include "slam/segment/block_sums.h"
#include "slam/segment/room.h"

namespace slam {
namespace {

// A plane owning fewer pixels of a block than this does not spread from it: chance crossings of
// another surface with the plane's extension are thinner.
constexpr int kMinPixelsToSpread = 4;

}  // namespace

void PixelGrowth::Begin(const DepthGrid& grid, const GrowthConfig& config) {
  Require(config.block_px >= 2 && config.block_px <= kMaxBlockSide_px,
          "PixelGrowth: block_px outside [2, 64]");
  Require(config.vote_reach_px >= 0 && config.vote_reach_px <= kMaxCostReach_px,
          "PixelGrowth: vote_reach_px outside [0, 16]");
  grid_ = &grid, config_ = config;
  const int size = config.block_px;
  on_.cols = (grid.width + size - 1) / size, on_.rows = (grid.height + size - 1) / size;
  const auto blocks = static_cast<std::size_t>(on_.block_count());
  on_.planes.clear(), on_.pixel_planes.clear(), on_.planes_of.clear();
  on_.hypotheses.Begin(blocks, size);
  on_.reached.Begin(on_.cols, on_.rows);
  active_.clear(), next_active_.clear(), is_active_.assign(blocks, 0);
  is_stale_.assign(blocks, 0);
  cost_count_ = 0;
  shared_.resize(on_.hypotheses.set_words());

  // The blocks of the image, and what is measured in each.
  place_.clear(), on_.blocks.clear();
  measured_.resize(blocks * on_.hypotheses.set_words());
  for (int r = 0; r < on_.rows; ++r) {
    for (int c = 0; c < on_.cols; ++c) {
      const std::size_t block = place_.size();
      place_.emplace_back(c, r);
      on_.blocks.push_back(slam::BlockAt(grid, c * size, r * size, size));
      FindMeasured(on_.blocks.back(), measured_.data() + block * on_.hypotheses.set_words());
    }
  }
}

int PixelGrowth::AddPlane(const LabelPlane& plane, const std::vector<LabelPlane>& local) {
  on_.planes_of.push_back({static_cast<int>(on_.pixel_planes.size()), !local.empty()});
  on_.planes.push_back(plane);
  if (local.empty()) on_.pixel_planes.emplace_back(plane);
  for (const LabelPlane& tile : local) on_.pixel_planes.emplace_back(tile);
  on_.reached.AddLabel();
  return static_cast<int>(on_.planes.size()) - 1;
}

bool PixelGrowth::Reach(int block, int label) {
  if (!on_.reached.Add(label, PlaceOf(block))) return false;
  on_.hypotheses.Add(block, label, on_.PlaneIndex(block, label));
  return true;
}

void PixelGrowth::Activate(int block) {
  std::uint8_t& is_active = is_active_[static_cast<std::size_t>(block)];
  if (is_active == 0) active_.push_back(block), is_active = 1;
}

/// @returns whether a pixel is near.
bool PixelGrowth::Measure(int block, int hypothesis) {
  BlockHypotheses& all = on_.hypotheses;
  Hypothesis& at = all.At(hypothesis);
  at.near = FindNear(on_.PixelsOf(block), on_.PlaneOf(hypothesis), MeasuredOf(block),
                     NearSigmas(config_), WideSigmas(config_),
                     all.SetOf(hypothesis, BlockHypotheses::kNear),
                     all.SetOf(hypothesis, BlockHypotheses::kWide));
  at.measured = true;
  return at.near > 0;
}

void PixelGrowth::FindCostsOf(int block, int hypothesis) {
  on_.hypotheses.At(hypothesis).costs = static_cast<int>(cost_count_++);
  Provide(costs_, cost_count_ * EntriesOfBlock(config_.block_px));
  const BlockPixels& pixels = on_.PixelsOf(block);
  const cv::Point first = PlaceOf(block) * config_.block_px;
  const int reach = config_.vote_reach_px;
  const CostWindow window{reach,
                          std::min(reach, first.x),
                          std::min(reach, first.y),
                          std::min(reach, grid_->width - first.x - pixels.width),
                          std::min(reach, grid_->height - first.y - pixels.height),
                          NearSigmas(config_)};
  FindCosts(pixels, on_.PlaneOf(hypothesis), window,
            on_.hypotheses.SetOf(hypothesis, BlockHypotheses::kNear), CostsOf(hypothesis));
}

/// Gives the pixels of a block to the nearest of its planes and counts what each gets.
void PixelGrowth::Assign(int block) {
  BlockHypotheses& all = on_.hypotheses;
  const std::size_t words = all.set_words();
  all.FindShared(block, BlockHypotheses::kNear, shared_.data());
  const bool any_shared = !IsEmpty(shared_.data(), words);

  // What only one plane is near is that plane's; the others have costs to be compared.
  competing_hypotheses_.clear();
  for (int k = all.First(block); k != kNoHypothesis; k = all.At(k).next) {
    const ConstPixelSet near = all.SetOf(k, BlockHypotheses::kNear);
    if (any_shared && Meet(near, shared_.data(), words)) {
      if (all.At(k).costs < 0) FindCostsOf(block, k);
      competing_hypotheses_.push_back(k);
    } else {
      Copy(near, all.SetOf(k, BlockHypotheses::kOwned), words);
      all.At(k).pixels = all.At(k).near;
    }
  }
  if (!any_shared) return;

  competing_.resize(competing_hypotheses_.size());
  for (std::size_t c = 0; c < competing_.size(); ++c) {
    const int k = competing_hypotheses_[c];
    competing_[c] = {all.SetOf(k, BlockHypotheses::kNear), CostsOf(k),
                     all.SetOf(k, BlockHypotheses::kOwned), 0};
  }
  AssignPixels(competing_.data(), static_cast<int>(competing_.size()), config_.block_px);
  for (std::size_t c = 0; c < competing_.size(); ++c)
    all.At(competing_hypotheses_[c]).pixels = competing_[c].pixels;
}

/// @returns whether anything has changed.
bool PixelGrowth::LabelBlock(int block) {
  BlockHypotheses& all = on_.hypotheses;
  std::uint8_t& is_stale = is_stale_[static_cast<std::size_t>(block)];
  const int first = all.First(block);
  for (int k = first; k != kNoHypothesis; k = all.At(k).next) {
    if (!all.At(k).measured && Measure(block, k)) is_stale = 1;
  }
  if (is_stale == 0) return false;
  is_stale = 0;
  if (first == kNoHypothesis) return true;
  if (all.At(first).next == kNoHypothesis) {
    Copy(all.SetOf(first, BlockHypotheses::kNear), all.SetOf(first, BlockHypotheses::kOwned),
         all.set_words());
    all.At(first).pixels = all.At(first).near;
  } else {
    Assign(block);
  }
  return true;
}

void PixelGrowth::SpreadFrom(int block) {
  const cv::Point place = PlaceOf(block);
  BlockHypotheses& all = on_.hypotheses;
  for (int k = all.First(block); k != kNoHypothesis; k = all.At(k).next) {
    if (all.At(k).spread || all.At(k).pixels < kMinPixelsToSpread) continue;
    all.At(k).spread = true;
    const int label = all.At(k).label;
    for (unsigned bits = on_.reached.MissingAround(label, place); bits != 0; bits &= bits - 1) {
      const int neighbour = std::countr_zero(bits);
      Seed(block + (neighbour / 3 - 1) * on_.cols + neighbour % 3 - 1, label);
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

void PixelGrowth::DropUseless() {
  gains_.FindUseless(on_, config_, useless_);
  for (int label = 0; label < static_cast<int>(useless_.size()); ++label) {
    if (useless_[static_cast<std::size_t>(label)] == 0) continue;
    on_.reached.VisitBlocks(label, [&](int block) {
      on_.hypotheses.Remove(block, label);
      Activate(block);
      is_stale_[static_cast<std::size_t>(block)] = 1;
      return false;
    });
    on_.reached.Forget(label);
  }
  Grow();
}

void PixelGrowth::Replace(const std::vector<LabelPlane>& planes, const std::vector<int>& into,
                          const std::vector<std::vector<LabelPlane>>& local) {
  // Where the planes are now is where the new ones begin.
  BlockHypotheses& all = on_.hypotheses;
  seeds_.clear();
  for (int block = 0; block < on_.block_count(); ++block) {
    for (int k = all.First(block); k != kNoHypothesis; k = all.At(k).next) {
      if (all.At(k).pixels > 0)
        seeds_.emplace_back(block, into[static_cast<std::size_t>(all.At(k).label)]);
    }
  }

  on_.planes.clear(), on_.pixel_planes.clear(), on_.planes_of.clear();
  all.Clear(), on_.reached.Clear();
  for (std::size_t k = 0; k < planes.size(); ++k)
    AddPlane(planes[k], local.empty() ? std::vector<LabelPlane>{} : local[k]);
  cost_count_ = 0;
  std::fill(is_stale_.begin(), is_stale_.end(), 1);
  for (const auto& [block, label] : seeds_) Seed(block, label);
  Grow();
}

void PixelGrowth::DrawLabels(LabelImage& labels) {
  const BlockHypotheses& all = on_.hypotheses;
  labels.resize(grid_->q.size());
  for (int block = 0; block < on_.block_count(); ++block) {
    owners_.clear();
    for (int k = all.First(block); k != kNoHypothesis; k = all.At(k).next) {
      if (all.At(k).pixels > 0)
        owners_.push_back({all.At(k).label, all.SetOf(k, BlockHypotheses::kOwned)});
    }
    DrawOwners(on_.PixelsOf(block), owners_.data(), static_cast<int>(owners_.size()),
               labels.data() + IndexOf(block));
  }
}

void PixelGrowth::MarkExplained(double bias, double standard_errors,
                                std::vector<std::uint8_t>& explained) const {
  const BlockHypotheses& all = on_.hypotheses;
  const std::size_t words = all.set_words();
  explained.assign(grid_->q.size(), 1);
  for (int block = 0; block < on_.block_count(); ++block) {
    const BlockPixels& pixels = on_.PixelsOf(block);
    std::array<std::uint64_t, WordsOfSet(kMaxBlockSide_px)> unexplained;
    Copy(MeasuredOf(block), unexplained.data(), words);
    for (int k = all.First(block); k != kNoHypothesis; k = all.At(k).next) {
      const int n = all.At(k).pixels;
      if (n == 0) continue;
      const ConstPixelSet owned = all.SetOf(k, BlockHypotheses::kOwned);
      const double sum = SumResiduals(pixels, on_.PlaneOf(k), owned);
      const double bound = bias + standard_errors / std::sqrt(static_cast<double>(n));
      if (std::abs(sum) < bound * n) TakeOut(owned, unexplained.data(), words);
    }
    if (!IsEmpty(unexplained.data(), words))
      ClearMarks(pixels, unexplained.data(), explained.data() + IndexOf(block));
  }
}

void PixelGrowth::SumParts(const std::vector<PlaneSums>& whole, PartsOnBlocks& out) const {
  const BlockHypotheses& all = on_.hypotheses;
  out.Begin(on_.cols, on_.rows);
  for (int block = 0; block < on_.block_count(); ++block) {
    out.first.push_back(out.parts.size());
    for (int k = all.First(block); k != kNoHypothesis; k = all.At(k).next) {
      const Hypothesis& at = all.At(k);
      if (at.pixels == 0) continue;
      const bool has_all = !whole.empty() && whole[static_cast<std::size_t>(block)].n ==
                                                 static_cast<double>(at.pixels);
      out.parts.push_back(
          {at.label,
           has_all ? whole[static_cast<std::size_t>(block)]
                   : SumOfSet(on_.PixelsOf(block), all.SetOf(k, BlockHypotheses::kOwned))});
    }
  }
  out.first.push_back(out.parts.size());
}

}  // namespace slam
