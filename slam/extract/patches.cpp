#include "slam/extract/patches.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

#include "slam/base/plane.h"
#include "slam/extract/boundary_steps.h"

namespace slam {
namespace {

constexpr double kLeastContacts = 8;  // pixels along the common boundary of what touches

/// The pixels on either side of the common boundary of each pair of labels (lower, higher).
using Contacts = std::map<std::pair<int, int>, PlaneSums>;

Contacts FindContacts(const DepthGrid& grid, const LabelImage& labels) {
  Contacts contacts;
  LabelRuns runs;
  FindRuns(labels, grid.width, grid.height, runs);
  std::pair<int, int> last{-1, -1};  // neighbouring pixels touch the same pair: look it up once
  PlaneSums* sums = nullptr;
  VisitBoundaries(runs, [&](std::size_t i, std::size_t j) {
    const int a = labels[i], b = labels[j];
    if (a == kNoLabel || b == kNoLabel) return;
    const std::pair<int, int> pair = std::minmax(a, b);
    if (pair != last) sums = &contacts[pair], last = pair;
    for (const std::size_t k : {i, j}) {
      const double g = static_cast<double>(grid.g[k]);
      sums->Add(static_cast<double>(grid.x[k]), static_cast<double>(grid.y[k]),
                static_cast<double>(grid.q[k]), g * g);
    }
  });
  return contacts;
}

/// Squared distance of two planes over the pixels of the smaller, in sigmas of those.
double PatchGap2(const Patch& a, const Patch& b) {
  const Patch& smaller = a.sums.n < b.sums.n ? a : b;
  return MeanSquaredGap(smaller.sums, a.plane.plane, b.plane.plane) /
         (smaller.plane.grazing * smaller.plane.grazing);
}

/// What noise adds to a squared gap, with what else is allowed.
double AllowedGap2(const Patch& a, const Patch& b, double max_gap_sigmas,
                   const PlaneExtractionConfig& config) {
  return max_gap_sigmas * max_gap_sigmas + config.coarse.max_merge_chi2 *
                                               config.noise.correlated_px /
                                               std::min(a.sums.n, b.sums.n);
}

/// Squared distance of two planes along their common boundary over what is allowed there.
double ContactGap(const Patch& a, const Patch& b, const PlaneSums& contact,
                  const PlaneExtractionConfig& config) {
  const double grazing = std::max(a.plane.grazing, b.plane.grazing);
  const double gap2 =
      MeanSquaredGap(contact, a.plane.plane, b.plane.plane) / (grazing * grazing);
  return gap2 / AllowedGap2(a, b, config.max_merge_gap_sigmas, config);
}

void Refit(Patch& patch, const DepthNoise& noise) {
  const std::optional<PlaneFit> fit = Fit(patch.sums);
  if (!fit) return;
  patch.plane = {fit->plane, GrazingFactor(patch.sums, fit->plane, noise)};
}

std::vector<Patch> FittedPatches(PixelGrowth& growth, const std::vector<PlaneSums>& blocks,
                                 const DepthNoise& noise) {
  const std::vector<PlaneSums>& sums = growth.SumLabels(blocks);
  std::vector<Patch> patches;
  for (std::size_t k = 0; k < sums.size(); ++k) {
    patches.push_back({sums[k], growth.planes()[k]});
    Refit(patches.back(), noise);
  }
  return patches;
}

/// Pairs of labels without a step between them, least step first.
std::vector<std::pair<int, int>> MeetingLabels(const DepthGrid& grid, const LabelImage& labels,
                                               const std::vector<LabelPlane>& planes,
                                               const PlaneExtractionConfig& config) {
  std::vector<std::pair<double, std::pair<int, int>>> ranked;
  for (const auto& [pair, step] : MeasureSteps(grid, labels, planes)) {
    if (step.pairs < kLeastContacts) continue;
    const double square = step.MeanSquare(config.noise.correlated_px);
    if (square < config.max_bend_step_sigmas * config.max_bend_step_sigmas)
      ranked.emplace_back(square, pair);
  }
  std::sort(ranked.begin(), ranked.end());
  std::vector<std::pair<int, int>> meeting;
  for (const auto& [square, pair] : ranked) meeting.push_back(pair);
  return meeting;
}

}  // namespace

double PatchGap(const Patch& a, const Patch& b, double max_gap_sigmas,
                const PlaneExtractionConfig& config) {
  return PatchGap2(a, b) / AllowedGap2(a, b, max_gap_sigmas, config);
}

PatchUnion::PatchUnion(std::vector<Patch> patches)
    : patches_(std::move(patches)), into_(patches_.size()) {
  std::iota(into_.begin(), into_.end(), 0);
}

void PatchUnion::Join(int a, int b, const DepthNoise& noise) {
  if (b < a) std::swap(a, b);
  Patch &stays = patches_[static_cast<std::size_t>(a)],
        &goes = patches_[static_cast<std::size_t>(b)];
  stays.sums += goes.sums;
  goes.sums = {};
  Refit(stays, noise);
  for (int& target : into_) target = target == b ? a : target;
}

std::vector<LabelPlane> PatchUnion::Planes() const {
  std::vector<LabelPlane> planes;
  for (const Patch& patch : patches_) planes.push_back(patch.plane);
  return planes;
}

void MergeEqualNeighbours(const DepthGrid& grid, const std::vector<PlaneSums>& blocks,
                          const PlaneExtractionConfig& config, PixelGrowth& growth) {
  PatchUnion merged(FittedPatches(growth, blocks, config.noise));
  const Contacts contacts = FindContacts(grid, growth.labels());
  while (true) {
    double least = 1.0;
    std::pair<int, int> best{-1, -1};
    for (const auto& [pair, contact] : contacts) {
      const int a = merged.Root(pair.first), b = merged.Root(pair.second);
      if (a == b || contact.n < kLeastContacts) continue;
      const double gap =
          std::max(PatchGap(merged.At(a), merged.At(b), config.max_merge_gap_sigmas, config),
                   ContactGap(merged.At(a), merged.At(b), contact, config));
      if (gap < least) least = gap, best = {a, b};
    }
    if (best.first < 0) break;
    merged.Join(best.first, best.second, config.noise);
  }
  growth.Replace(merged.Planes(), merged.into());
}

PatchUnion JoinBentParts(const DepthGrid& grid, const std::vector<PlaneSums>& blocks,
                         const PlaneExtractionConfig& config, PixelGrowth& growth) {
  PatchUnion joined(FittedPatches(growth, blocks, config.noise));
  const std::vector<std::pair<int, int>> meeting =
      MeetingLabels(grid, growth.labels(), joined.Planes(), config);
  bool changed = true;
  while (changed) {
    changed = false;
    for (const auto& [k, l] : meeting) {
      const int a = joined.Root(k), b = joined.Root(l);
      if (a == b) continue;
      const Patch &A = joined.At(a), &B = joined.At(b);
      const double angle = Angle(A.plane.plane.Hessian().n, B.plane.plane.Hessian().n);
      if (!(angle < config.max_bend_rad)) continue;
      if (!(PatchGap(A, B, config.max_bend_sigmas, config) < 1.0)) continue;
      joined.Join(a, b, config.noise);
      changed = true;
    }
  }
  return joined;
}

}  // namespace slam
