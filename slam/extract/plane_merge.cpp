#include "slam/extract/plane_merge.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <optional>

namespace slam {
namespace {

constexpr double kLeastContacts = 8;  // pixels along the common boundary of what touches
constexpr double kNoMerge = std::numeric_limits<double>::infinity();

}  // namespace

void PlaneMerging::Refit(Patch& patch) const {
  const std::optional<PlaneFit> fit = Fit(patch.sums);
  if (!fit) return;
  patch.plane = {fit->plane, GrazingFactor(patch.sums, fit->plane, noise_)};
}

void PlaneMerging::Start(const DepthGrid& grid, const PixelGrowth& growth) {
  growth.SumLabels(sums_);
  patches_.clear();
  for (std::size_t k = 0; k < sums_.size(); ++k) {
    patches_.push_back({sums_[k], growth.planes()[k]});
    Refit(patches_.back());
  }
  into_.resize(patches_.size());
  std::iota(into_.begin(), into_.end(), 0);
  FindContacts(grid, growth.labels());
}

void PlaneMerging::AddContact(const DepthGrid& grid, int a, int b, std::size_t i,
                              std::size_t j) {
  const int low = std::min(a, b), high = std::max(a, b);
  int& number = contact_of_[static_cast<std::size_t>(low) * patches_.size() +
                            static_cast<std::size_t>(high)];
  if (number < 0) {
    number = static_cast<int>(contacts_.size());
    contacts_.push_back({low, high, {}});
  }
  PlaneSums& sums = contacts_[static_cast<std::size_t>(number)].sums;
  for (const std::size_t k : {i, j}) {
    const double g = static_cast<double>(grid.g[k]);
    sums.Add(static_cast<double>(grid.x[k]), static_cast<double>(grid.y[k]),
             static_cast<double>(grid.q[k]), g * g);
  }
}

void PlaneMerging::FindContacts(const DepthGrid& grid, const LabelImage& labels) {
  contacts_.clear();
  contact_of_.assign(patches_.size() * patches_.size(), -1);
  const auto width = static_cast<std::size_t>(grid.width);
  const auto touch = [&](std::size_t i, std::size_t j) {
    const int a = labels[i], b = labels[j];
    if (a != b && a != kNoLabel && b != kNoLabel) AddContact(grid, a, b, i, j);
  };
  for (int v = 0; v < grid.height; ++v) {
    const auto start = static_cast<std::size_t>(grid.Index(0, v));
    for (std::size_t i = start; i + 1 < start + width; ++i) touch(i, i + 1);
    if (v + 1 == grid.height) continue;
    for (std::size_t i = start; i < start + width; ++i) touch(i, i + width);
  }
  std::sort(contacts_.begin(), contacts_.end(), [](const Contact& p, const Contact& q) {
    return p.a != q.a ? p.a < q.a : p.b < q.b;
  });
}

/// What noise adds to a squared gap, with what else is allowed.
double PlaneMerging::AllowedGap2(const Patch& a, const Patch& b, double max_gap_sigmas) const {
  return max_gap_sigmas * max_gap_sigmas +
         clusters_.max_merge_chi2 * noise_.correlated_px / std::min(a.sums.n, b.sums.n);
}

double PlaneMerging::PatchGap(const Patch& a, const Patch& b, double max_gap_sigmas) const {
  const Patch& smaller = a.sums.n < b.sums.n ? a : b;
  const double gap2 = MeanSquaredGap(smaller.sums, a.plane.plane, b.plane.plane) /
                      (smaller.plane.grazing * smaller.plane.grazing);
  return gap2 / AllowedGap2(a, b, max_gap_sigmas);
}

/// Squared distance of two planes along their common boundary over what is allowed there.
double PlaneMerging::ContactGap(const Patch& a, const Patch& b,
                                const PlaneSums& contact) const {
  const double grazing = std::max(a.plane.grazing, b.plane.grazing);
  const double gap2 =
      MeanSquaredGap(contact, a.plane.plane, b.plane.plane) / (grazing * grazing);
  return gap2 / AllowedGap2(a, b, config_.max_gap_sigmas);
}

/// The lower number stays.
void PlaneMerging::Join(int a, int b) {
  if (b < a) std::swap(a, b);
  Patch& into = patches_[static_cast<std::size_t>(a)];
  Patch& from = patches_[static_cast<std::size_t>(b)];
  into.sums += from.sums;
  from.sums = {};
  Refit(into);
  for (int& target : into_) target = target == b ? a : target;
}

void PlaneMerging::MergeEqual() {
  const auto gap_of = [&](const Contact& contact) {
    const int a = Root(contact.a), b = Root(contact.b);
    if (a == b || contact.sums.n < kLeastContacts) return kNoMerge;
    return std::max(PatchGap(At(a), At(b), config_.max_gap_sigmas),
                    ContactGap(At(a), At(b), contact.sums));
  };
  gaps_.clear();
  for (const Contact& contact : contacts_) gaps_.push_back(gap_of(contact));
  while (true) {
    const auto least = std::min_element(gaps_.begin(), gaps_.end());
    if (least == gaps_.end() || !(*least < 1.0)) break;
    const Contact& best = contacts_[static_cast<std::size_t>(least - gaps_.begin())];
    const int joined = std::min(Root(best.a), Root(best.b));
    Join(Root(best.a), Root(best.b));
    for (std::size_t k = 0; k < contacts_.size(); ++k) {
      if (Root(contacts_[k].a) == joined || Root(contacts_[k].b) == joined) {
        gaps_[k] = gap_of(contacts_[k]);
      }
    }
  }
}

void PlaneMerging::JoinBent() {
  meeting_.clear();
  for (std::size_t k = 0; k < contacts_.size(); ++k) {
    const Contact& contact = contacts_[k];
    if (contact.sums.n < kLeastContacts) continue;
    const double gap = ContactGap(At(contact.a), At(contact.b), contact.sums);
    if (gap < 1.0) meeting_.emplace_back(gap, static_cast<int>(k));
  }
  std::sort(meeting_.begin(), meeting_.end());
  bool changed = true;
  while (changed) {
    changed = false;
    for (const auto& [gap, k] : meeting_) {
      const Contact& contact = contacts_[static_cast<std::size_t>(k)];
      const int a = Root(contact.a), b = Root(contact.b);
      if (a == b) continue;
      const double angle = Angle(At(a).plane.plane.Hessian().n, At(b).plane.plane.Hessian().n);
      if (!(angle < config_.max_bend_rad)) continue;
      if (!(PatchGap(At(a), At(b), config_.max_bend_sigmas) < 1.0)) continue;
      Join(a, b);
      changed = true;
    }
  }
}

const std::vector<LabelPlane>& PlaneMerging::Planes() {
  planes_.clear();
  for (const Patch& patch : patches_) planes_.push_back(patch.plane);
  return planes_;
}

}  // namespace slam
