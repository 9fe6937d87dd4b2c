#include "slam/segment/patches.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include "slam/geometry/plane.h"

namespace slam {
namespace {

// Along a common boundary; what touches in fewer may do so by stray pixels.
constexpr int kMinContact_px = 8;

/// Squared distance of two planes over the pixels of the smaller, in sigmas of those.
double PatchGap2(const Patch& a, const Patch& b) {
  const Patch& smaller = a.sums.n < b.sums.n ? a : b;
  return MeanSquaredGap(smaller.sums, a.plane.plane, b.plane.plane) /
         (smaller.plane.grazing * smaller.plane.grazing);
}

/// What noise adds to a squared gap, with what else is allowed.
double AllowedGap2(const Patch& a, const Patch& b, double max_gap_sigmas,
                   const DepthNoise& noise, const PlaneExtractionConfig& config) {
  return max_gap_sigmas * max_gap_sigmas +
         config.coarse.max_merge_chi2 * noise.correlated_px / std::min(a.sums.n, b.sums.n);
}

/// Squared distance of two planes along their common boundary over what is allowed there.
double ContactGap(const Patch& a, const Patch& b, const PlaneSums& contact,
                  const DepthNoise& noise, const PlaneExtractionConfig& config) {
  const double grazing = std::max(a.plane.grazing, b.plane.grazing);
  const double gap2 =
      MeanSquaredGap(contact, a.plane.plane, b.plane.plane) / (grazing * grazing);
  return gap2 / AllowedGap2(a, b, config.max_merge_gap_sigmas, noise, config);
}

/// The sums of a pixel that a distance of planes depends on.
void AddRay(const DepthGrid& grid, std::size_t i, PlaneSums& sums) {
  const double x = static_cast<double>(grid.x[i]), y = static_cast<double>(grid.y[i]);
  const double g = static_cast<double>(grid.g[i]), weight = g * g;
  const double vx = weight * x, vy = weight * y;
  sums.n += 1, sums.w += weight, sums.wx += vx, sums.wy += vy;
  sums.wxx += vx * x, sums.wxy += vx * y, sums.wyy += vy * y;
}

void Refit(Patch& patch, const DepthNoise& noise) {
  const std::optional<PlaneFit> fit = Fit(patch.sums);
  if (!fit) return;
  patch.plane = {fit->plane, GrazingFactor(patch.sums, fit->plane, noise)};
}

}  // namespace

double PatchGap(const Patch& a, const Patch& b, double max_gap_sigmas, const DepthNoise& noise,
                const PlaneExtractionConfig& config) {
  return PatchGap2(a, b) / AllowedGap2(a, b, max_gap_sigmas, noise, config);
}

void PatchUnion::Begin(const std::vector<PlaneSums>& sums,
                       const std::vector<LabelPlane>& planes, const DepthNoise& noise) {
  patches_.clear(), apart_.clear();
  for (std::size_t k = 0; k < sums.size(); ++k) {
    patches_.push_back({sums[k], planes[k]});
    Refit(patches_.back(), noise);
  }
  into_.resize(patches_.size());
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

bool PatchUnion::Apart(int a, int b) const {
  return std::any_of(apart_.begin(), apart_.end(), [&](const std::pair<int, int>& pair) {
    const int k = Root(pair.first), l = Root(pair.second);
    return (k == a && l == b) || (k == b && l == a);
  });
}

bool PatchUnion::IsAmbiguous(int a, int b, const DepthNoise& noise,
                             const PlaneExtractionConfig& config) const {
  const auto is_of_b = [&](int k) {
    return Root(k) != a && Root(k) != b &&
           PatchGap(At(k), At(b), config.max_bend_sigmas, noise, config) < 1.0;
  };
  return std::any_of(apart_.begin(), apart_.end(), [&](const std::pair<int, int>& pair) {
    return (Root(pair.first) == a && is_of_b(pair.second)) ||
           (Root(pair.second) == a && is_of_b(pair.first));
  });
}

void PatchUnion::CopyPlanes(std::vector<LabelPlane>& planes) const {
  planes.clear();
  for (const Patch& patch : patches_) planes.push_back(patch.plane);
}

void PatchJoining::FindContacts(const DepthGrid& grid, PixelGrowth& growth) {
  growth.DrawLabels(labels_);
  FindRuns(labels_, grid.width, grid.height, runs_);
  contacts_.Clear(static_cast<int>(growth.planes().size()));
  std::pair<int, int> last{-1, -1};  // what follows touches the same pair: look it up once
  Contact* contact = nullptr;
  VisitBoundaryPieces(
      runs_, [&](std::size_t, std::size_t, int count, std::size_t a, std::size_t b) {
        const std::pair<int, int> pair = std::minmax(runs_.runs[a].label, runs_.runs[b].label);
        if (pair.first == kNoLabel) return;
        if (pair != last) contact = &contacts_.Of(pair.first, pair.second), last = pair;
        contact->pixels += 2 * count;
      });
}

/// Sums the contacts, not summed yet, of patches that may be one plane: most never are.
void PatchJoining::SumContacts(const DepthGrid& grid, const DepthNoise& noise,
                               const PlaneExtractionConfig& config) {
  wanted_.assign(patches_.into().size(), 0);
  for (auto& [pair, contact] : contacts_.Sorted()) {
    const int a = patches_.Root(pair.first), b = patches_.Root(pair.second);
    contact.wanted = !contact.summed && a != b && contact.pixels >= kMinContact_px &&
                     PatchGap(patches_.At(a), patches_.At(b), config.max_merge_gap_sigmas,
                              noise, config) < 1.0;
    if (!contact.wanted) continue;
    contact.summed = true;
    wanted_[static_cast<std::size_t>(pair.first)] = 1;
    wanted_[static_cast<std::size_t>(pair.second)] = 1;
  }
  std::pair<int, int> last{-1, -1};
  Contact* contact = nullptr;
  VisitBoundaryPieces(
      runs_, [&](std::size_t i, std::size_t j, int count, std::size_t a, std::size_t b) {
        const std::pair<int, int> pair = std::minmax(runs_.runs[a].label, runs_.runs[b].label);
        if (pair.first == kNoLabel || wanted_[static_cast<std::size_t>(pair.first)] == 0 ||
            wanted_[static_cast<std::size_t>(pair.second)] == 0)
          return;
        if (pair != last) contact = &contacts_.Known(pair.first, pair.second), last = pair;
        if (!contact->wanted) return;
        for (const std::size_t end = i + static_cast<std::size_t>(count); i < end; ++i, ++j) {
          AddRay(grid, i, contact->rays);
          AddRay(grid, j, contact->rays);
        }
      });
}

void PatchJoining::MergeEqualNeighbours(const DepthGrid& grid,
                                        const std::vector<PlaneSums>& blocks,
                                        const DepthNoise& noise,
                                        const PlaneExtractionConfig& config,
                                        PixelGrowth& growth) {
  growth.SumLabels(blocks, sums_);
  patches_.Begin(sums_, growth.planes(), noise);
  FindContacts(grid, growth);

  // The closest pair joins, as long as noise explains its distance. The sums of a contact are
  // taken only once the patches themselves agree.
  auto& contacts = contacts_.Sorted();
  while (true) {
    double min_gap = 1.0;
    std::pair<int, int> best{-1, -1};
    for (auto& [pair, contact] : contacts) {
      const int a = patches_.Root(pair.first), b = patches_.Root(pair.second);
      if (a == b || contact.pixels < kMinContact_px) continue;
      const double patch_gap =
          PatchGap(patches_.At(a), patches_.At(b), config.max_merge_gap_sigmas, noise, config);
      if (!(patch_gap < min_gap)) continue;
      if (!contact.summed) SumContacts(grid, noise, config);
      const double gap = std::max(
          patch_gap, ContactGap(patches_.At(a), patches_.At(b), contact.rays, noise, config));
      if (gap < min_gap) min_gap = gap, best = {a, b};
    }
    if (best.first < 0) break;
    patches_.Join(best.first, best.second, noise);
  }

  // Growth begins anew with the planes of what was joined.
  patches_.CopyPlanes(planes_);
  growth.Replace(planes_, patches_.into());
}

/// Pairs of labels without a step between them, smallest step first.
void PatchJoining::RankMeetingLabels(const DepthNoise& noise,
                                     const PlaneExtractionConfig& config) {
  meeting_.clear();
  for (const auto& [pair, step] : steps_.Sorted()) {
    if (step.pairs < kMinContact_px) continue;
    const double square = step.MeanSquare(noise.correlated_px);
    if (square < config.max_bend_step_sigmas * config.max_bend_step_sigmas)
      meeting_.emplace_back(square, pair);
  }
  std::sort(meeting_.begin(), meeting_.end());
}

/// Joins the segments of labels that meet while they keep the bounds on bending.
void PatchJoining::JoinMeeting(const DepthNoise& noise, const PlaneExtractionConfig& config) {
  bool changed = true;
  while (changed) {
    changed = false;
    for (const auto& [square, pair] : meeting_) {
      const int a = patches_.Root(pair.first), b = patches_.Root(pair.second);
      if (a == b || patches_.Apart(a, b)) continue;
      const Patch &A = patches_.At(a), &B = patches_.At(b);
      const double angle = Angle(A.plane.plane.Hessian().n, B.plane.plane.Hessian().n);
      if (!(angle < config.max_bend_rad)) continue;
      if (!(PatchGap(A, B, config.max_bend_sigmas, noise, config) < 1.0)) continue;
      if (patches_.IsAmbiguous(a, b, noise, config) ||
          patches_.IsAmbiguous(b, a, noise, config))
        continue;
      patches_.Join(a, b, noise);
      changed = true;
    }
  }
}

const PatchUnion& PatchJoining::JoinBentParts(const DepthGrid& grid,
                                              const std::vector<PlaneSums>& blocks,
                                              const DepthNoise& noise,
                                              const PlaneExtractionConfig& config,
                                              PixelGrowth& growth, bool warped) {
  growth.SumLabels(blocks, sums_);
  patches_.Begin(sums_, growth.planes(), noise);
  patches_.CopyPlanes(planes_);
  growth.DrawLabels(labels_);
  FindRuns(labels_, grid.width, grid.height, runs_);

  // What meets in a crease or a step is kept apart; what meets without one may be joined.
  if (warped) {
    MeasureShares(grid, labels_, runs_, planes_, noise, strips_, shares_);
    for (const auto& [pair, share] : shares_.Sorted()) {
      if (share.IsCrease()) patches_.KeepApart(pair.first, pair.second);
    }
  }
  step_measurement_.Measure(grid, labels_, runs_, planes_, steps_);
  RankMeetingLabels(noise, config);
  JoinMeeting(noise, config);
  return patches_;
}

}  // namespace slam
