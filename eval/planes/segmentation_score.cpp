#include "eval/planes/segmentation_score.h"

#include <algorithm>
#include <optional>
#include <set>
#include <vector>

namespace eval {
namespace {

enum class Kind { kCorrect, kOver, kUnder };

struct Instance {
  Kind kind = Kind::kCorrect;
  std::vector<int> truth, machine;
  double measure = 0.0;  ///< mean of the two shares
};

double Share(long long part, long long whole) {
  return static_cast<double>(part) / static_cast<double>(whole);
}

/// The parts that lie in `whole` by at least `min_share` of themselves and, at least two,
/// together make up `min_share` of it. `shared(part)` counts pixels in common.
template <typename SharedPixels>
std::optional<Instance> Gather(long long whole_pixels, const std::map<int, long long>& parts,
                               double min_share, const SharedPixels& shared) {
  Instance found;
  double part_shares = 0.0;
  long long sum = 0;
  for (const auto& [part, pixels] : parts) {
    const long long both = shared(part);
    if (both == 0 || !(Share(both, pixels) >= min_share)) continue;
    found.machine.push_back(part);
    part_shares += Share(both, pixels);
    sum += both;
  }
  if (found.machine.size() < 2 || !(Share(sum, whole_pixels) >= min_share)) return std::nullopt;
  const double mean_share = part_shares / static_cast<double>(found.machine.size());
  found.measure = 0.5 * (mean_share + Share(sum, whole_pixels));
  return found;
}

std::vector<Instance> FindInstances(const Overlap& o, double min_share) {
  std::vector<Instance> instances;
  for (const auto& [t, row] : o.shared) {
    for (const auto& [m, both] : row) {
      if (!IsCorrect(o, t, m, min_share)) continue;
      const double of_truth = Share(both, o.truth_pixels.at(t));
      const double of_machine = Share(both, o.machine_pixels.at(m));
      instances.push_back({Kind::kCorrect, {t}, {m}, 0.5 * (of_truth + of_machine)});
    }
  }
  for (const auto& [t, pixels] : o.truth_pixels) {
    auto over = Gather(pixels, o.machine_pixels, min_share,
                       [&, id = t](int m) { return o.Shared(id, m); });
    if (!over) continue;
    over->kind = Kind::kOver;
    over->truth = {t};
    instances.push_back(*over);
  }
  for (const auto& [m, pixels] : o.machine_pixels) {
    auto under = Gather(pixels, o.truth_pixels, min_share,
                        [&, id = m](int t) { return o.Shared(t, id); });
    if (!under) continue;
    under->kind = Kind::kUnder;
    under->truth = std::move(under->machine);
    under->machine = {m};
    instances.push_back(*under);
  }
  std::stable_sort(instances.begin(), instances.end(),
                   [](const Instance& a, const Instance& b) { return a.measure > b.measure; });
  return instances;
}

}  // namespace

HooverScore& HooverScore::operator+=(const HooverScore& other) {
  truth += other.truth, machine += other.machine;
  correct += other.correct, over += other.over, under += other.under;
  missed += other.missed, noise += other.noise;
  truth_pixels += other.truth_pixels, correct_pixels += other.correct_pixels;
  return *this;
}

PanopticCounts& PanopticCounts::operator+=(const PanopticCounts& other) {
  tp += other.tp, fp += other.fp, fn += other.fn;
  iou_sum += other.iou_sum;
  return *this;
}

bool IsCorrect(const Overlap& overlap, int truth, int machine, double min_share) {
  const long long both = overlap.Shared(truth, machine);
  return Share(both, overlap.truth_pixels.at(truth)) >= min_share &&
         Share(both, overlap.machine_pixels.at(machine)) >= min_share;
}

HooverScore ScoreHoover(const Overlap& overlap, double min_share) {
  HooverScore score;
  score.truth = static_cast<int>(overlap.truth_pixels.size());
  score.machine = static_cast<int>(overlap.machine_pixels.size());
  for (const auto& [truth, pixels] : overlap.truth_pixels) score.truth_pixels += pixels;
  std::set<int> used_truth, used_machine;
  for (const Instance& instance : FindInstances(overlap, min_share)) {
    const auto taken = [](const std::set<int>& used) {
      return [&used](int id) { return used.count(id) > 0; };
    };
    if (std::any_of(instance.truth.begin(), instance.truth.end(), taken(used_truth))) continue;
    if (std::any_of(instance.machine.begin(), instance.machine.end(), taken(used_machine))) {
      continue;
    }
    used_truth.insert(instance.truth.begin(), instance.truth.end());
    used_machine.insert(instance.machine.begin(), instance.machine.end());
    if (instance.kind == Kind::kCorrect) {
      ++score.correct;
      score.correct_pixels += overlap.truth_pixels.at(instance.truth.front());
    }
    if (instance.kind == Kind::kOver) ++score.over;
    if (instance.kind == Kind::kUnder) ++score.under;
  }
  score.missed = score.truth - static_cast<int>(used_truth.size());
  score.noise = score.machine - static_cast<int>(used_machine.size());
  return score;
}

PanopticCounts CountPanoptic(const Overlap& overlap) {
  PanopticCounts counts;
  for (const auto& [t, row] : overlap.shared) {
    for (const auto& [m, both] : row) {
      const double iou = overlap.IoU(t, m);
      if (!(iou > 0.5)) continue;
      ++counts.tp;
      counts.iou_sum += iou;
    }
  }
  counts.fn = static_cast<int>(overlap.truth_pixels.size()) - counts.tp;
  counts.fp = static_cast<int>(overlap.machine_pixels.size()) - counts.tp;
  return counts;
}

}  // namespace eval
