#include "slam/segment/growth/pixel_growth.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "slam/base/index.h"
#include "slam/segment/growth/plane_gains.h"

namespace slam {
namespace {

// A plane owning fewer pixels of a block than this does not spread from it: chance crossings of
// another surface with the plane's extension are thinner.
constexpr int kMinPixelsToSpread = 4;

}  // namespace

void PixelGrowth::Begin(const ImageBlocks& blocks, const GrowthConfig& config) {
  on_.blocks = &blocks, config_ = config;
  const auto count = static_cast<std::size_t>(blocks.count());
  on_.planes.clear(), on_.pixel_planes.clear(), on_.planes_of.clear(), is_reached_.clear();
  on_.hypotheses.Begin(count);
  active_.clear(), next_active_.clear(), is_active_.assign(count, 0);
  is_stale_.assign(count, 0);
  cost_count_ = 0;
}

int PixelGrowth::AddPlane(const LabelPlane& plane, const std::vector<LabelPlane>& local) {
  on_.planes_of.push_back({static_cast<int>(on_.pixel_planes.size()), !local.empty()});
  on_.planes.push_back(plane);
  if (local.empty()) on_.pixel_planes.emplace_back(plane);
  for (const LabelPlane& tile : local) on_.pixel_planes.emplace_back(tile);
  is_reached_.resize(is_reached_.size() + is_active_.size());
  return static_cast<int>(on_.planes.size()) - 1;
}

void PixelGrowth::Seed(int block, int label) {
  const std::size_t blocks = is_active_.size();
  std::uint8_t& is_reached = is_reached_[Index(label) * blocks + Index(block)];
  if (is_reached != 0) return;
  is_reached = 1;
  on_.hypotheses.Add(block, label, on_.PlaneIndex(block, label));
  Activate(block);
}

void PixelGrowth::Activate(int block) {
  std::uint8_t& is_active = is_active_[Index(block)];
  if (is_active == 0) active_.push_back(block), is_active = 1;
}

/// @returns whether a pixel is near.
bool PixelGrowth::Measure(int block, int hypothesis) {
  Hypothesis& at = on_.hypotheses.At(hypothesis);
  const NearPixels found =
      FindNear(on_.blocks->PixelsOf(block), on_.PlaneOf(hypothesis),
               on_.blocks->MeasuredOf(block), NearSigmas(config_), WideSigmas(config_));
  at.near = found.near, at.wide = found.wide;
  at.measured = true;
  return at.near != 0;
}

void PixelGrowth::FindCostsOf(int block, int hypothesis) {
  on_.hypotheses.At(hypothesis).costs = static_cast<int>(cost_count_++);
  if (costs_.size() < cost_count_ * kBlockPixels) costs_.resize(cost_count_ * kBlockPixels);
  FindCosts(on_.blocks->PixelsOf(block), on_.PlaneOf(hypothesis), NearSigmas(config_),
            on_.hypotheses.At(hypothesis).near, CostsOf(hypothesis));
}

/// Gives the pixels of a block to the nearest of its planes.
void PixelGrowth::Assign(int block) {
  BlockHypotheses& all = on_.hypotheses;
  const PixelSet shared = all.FindShared(block, &Hypothesis::near);

  // What only one plane is near is that plane's; the others have costs to be compared.
  competing_.clear();
  for (int k = all.First(block); k != kNoHypothesis; k = all.At(k).next) {
    all.At(k).owned = all.At(k).near;
    if ((all.At(k).near & shared) == 0) continue;
    if (all.At(k).costs < 0) FindCostsOf(block, k);
    competing_.push_back({.hypothesis = k});
  }
  if (shared == 0) return;
  for (CompetingPlane& plane : competing_) plane.costs = CostsOf(plane.hypothesis);
  AssignPixels(competing_.data(), static_cast<int>(competing_.size()));
  for (const CompetingPlane& plane : competing_) all.At(plane.hypothesis).owned = plane.owned;
}

/// @returns whether anything has changed.
bool PixelGrowth::LabelBlock(int block) {
  BlockHypotheses& all = on_.hypotheses;
  std::uint8_t& is_stale = is_stale_[Index(block)];
  const int first = all.First(block);
  for (int k = first; k != kNoHypothesis; k = all.At(k).next) {
    if (!all.At(k).measured && Measure(block, k)) is_stale = 1;
  }
  if (is_stale == 0) return false;
  is_stale = 0;
  Assign(block);
  return true;
}

void PixelGrowth::SpreadFrom(int block) {
  const int cols = on_.blocks->cols, c = block % cols, r = block / cols;
  BlockHypotheses& all = on_.hypotheses;
  for (int k = all.First(block); k != kNoHypothesis; k = all.At(k).next) {
    if (all.At(k).spread || std::popcount(all.At(k).owned) < kMinPixelsToSpread) continue;
    all.At(k).spread = true;
    const int label = all.At(k).label;
    for (int row = std::max(r - 1, 0); row < std::min(r + 2, on_.blocks->rows); ++row)
      for (int col = std::max(c - 1, 0); col < std::min(c + 2, cols); ++col)
        Seed(row * cols + col, label);
  }
}

void PixelGrowth::Grow() {
  // Each round adds at least one label to a block, so there are finitely many.
  while (!active_.empty()) {
    std::swap(active_, next_active_);
    active_.clear();
    const auto unchanged = [&](int block) {
      is_active_[Index(block)] = 0;
      return !LabelBlock(block);
    };
    next_active_.erase(std::remove_if(next_active_.begin(), next_active_.end(), unchanged),
                       next_active_.end());
    for (const int block : next_active_) SpreadFrom(block);
  }
}

void PixelGrowth::DropUseless() {
  const std::vector<std::uint8_t> useless = FindUseless(on_, config_);
  for (int block = 0; block < on_.blocks->count(); ++block) {
    if (!on_.hypotheses.Remove(block, useless)) continue;
    Activate(block);
    is_stale_[Index(block)] = 1;
  }
  Grow();
}

void PixelGrowth::Replace(const std::vector<LabelPlane>& planes, const std::vector<int>& into,
                          const std::vector<std::vector<LabelPlane>>& local) {
  // Where the planes are now is where the new ones begin.
  BlockHypotheses& all = on_.hypotheses;
  std::vector<std::pair<int, int>> seeds;  // (block, label)
  for (int block = 0; block < on_.blocks->count(); ++block) {
    for (int k = all.First(block); k != kNoHypothesis; k = all.At(k).next) {
      if (all.At(k).owned != 0) seeds.emplace_back(block, into[Index(all.At(k).label)]);
    }
  }

  on_.planes.clear(), on_.pixel_planes.clear(), on_.planes_of.clear(), is_reached_.clear();
  all.Begin(static_cast<std::size_t>(on_.blocks->count()));
  for (std::size_t k = 0; k < planes.size(); ++k) AddPlane(planes[k], local[k]);
  cost_count_ = 0;
  std::fill(is_stale_.begin(), is_stale_.end(), 1);
  for (const auto& [block, label] : seeds) Seed(block, label);
  Grow();
}

void PixelGrowth::DrawLabels(int width, int height, LabelImage& labels) {
  const BlockHypotheses& all = on_.hypotheses;
  labels.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (int block = 0; block < on_.blocks->count(); ++block) {
    owners_.clear();
    for (int k = all.First(block); k != kNoHypothesis; k = all.At(k).next) {
      if (all.At(k).owned != 0) owners_.push_back({all.At(k).label, all.At(k).owned});
    }
    const cv::Point first = PlaceOf(block) * kBlock_px;
    DrawOwners(on_.blocks->PixelsOf(block), owners_.data(), static_cast<int>(owners_.size()),
               labels.data() + (static_cast<std::ptrdiff_t>(first.y) * width + first.x), width);
  }
}

std::vector<PixelSet> PixelGrowth::FindUnexplained(double bias, double standard_errors) const {
  const BlockHypotheses& all = on_.hypotheses;
  std::vector<PixelSet> unexplained = on_.blocks->measured;
  for (int block = 0; block < on_.blocks->count(); ++block) {
    for (int k = all.First(block); k != kNoHypothesis; k = all.At(k).next) {
      const PixelSet owned = all.At(k).owned;
      if (owned == 0) continue;
      const int n = std::popcount(owned);
      const double sum = SumResiduals(on_.blocks->PixelsOf(block), on_.PlaneOf(k), owned);
      const double bound = bias + standard_errors / std::sqrt(static_cast<double>(n));
      if (std::abs(sum) < bound * n) unexplained[Index(block)] &= ~owned;
    }
  }
  return unexplained;
}

void PixelGrowth::SumParts(const std::vector<PlaneSums>& whole, PartsOnBlocks& out) const {
  const BlockHypotheses& all = on_.hypotheses;
  out.Begin(on_.blocks->cols, on_.blocks->rows);
  for (int block = 0; block < on_.blocks->count(); ++block) {
    out.first.push_back(out.parts.size());
    for (int k = all.First(block); k != kNoHypothesis; k = all.At(k).next) {
      const Hypothesis& at = all.At(k);
      if (at.owned == 0) continue;
      const bool has_all = at.owned == on_.blocks->MeasuredOf(block);
      out.parts.push_back({at.label, has_all
                                         ? whole[Index(block)]
                                         : SumOfSet(on_.blocks->PixelsOf(block), at.owned)});
    }
  }
  out.first.push_back(out.parts.size());
}

}  // namespace slam
