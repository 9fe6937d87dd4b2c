#include "eval/planes/evops_score.h"

#include <algorithm>
#include <array>
#include <set>
#include <vector>

#include "eval/planes/association.h"

namespace eval {
namespace {

constexpr double kMatchIoU = 0.75, kPartnerIoU = 0.2;  // EVOPS 1.0

/// What the regions of one side have on the other.
struct Side {
  std::map<int, std::vector<int>> partners;  ///< of every region
  std::set<int> matched;
};

double ShareOf(std::ptrdiff_t part, std::size_t whole) {
  return whole > 0 ? static_cast<double>(part) / static_cast<double>(whole) : 0.0;
}

double WithSeveral(const Side& side) {
  const auto several = [](const auto& region) { return region.second.size() > 1; };
  return ShareOf(std::count_if(side.partners.begin(), side.partners.end(), several),
                 side.partners.size());
}

/// Regions that the other side does not have: one is left whose only partner is taken to pieces
/// of which it is one.
double WithoutCounterpart(const Side& side, const Side& other) {
  const auto without = [&](const auto& region) {
    const auto& [id, partners] = region;
    if (partners.empty()) return true;
    return partners.size() == 1 && side.matched.count(id) == 0 &&
           other.partners.at(partners.front()).size() == 1;
  };
  return ShareOf(std::count_if(side.partners.begin(), side.partners.end(), without),
                 side.partners.size());
}

constexpr std::array kFigures{&EvopsScore::precision,   &EvopsScore::recall,
                              &EvopsScore::f1,          &EvopsScore::mean_iou,
                              &EvopsScore::mean_dice,   &EvopsScore::panoptic,
                              &EvopsScore::under_ratio, &EvopsScore::over_ratio,
                              &EvopsScore::noise_ratio, &EvopsScore::missed_ratio};

}  // namespace

EvopsScore& EvopsScore::operator+=(const EvopsScore& other) {
  for (const auto figure : kFigures) this->*figure += other.*figure;
  return *this;
}

EvopsScore& EvopsScore::operator/=(double divisor) {
  for (const auto figure : kFigures) this->*figure /= divisor;
  return *this;
}

EvopsScore ScoreEvops(const Overlap& overlap) {
  EvopsScore score;
  Side truth, machine;
  for (const auto& [t, pixels] : overlap.truth_pixels) truth.partners[t] = {};
  for (const auto& [m, pixels] : overlap.machine_pixels) machine.partners[m] = {};
  double matches = 0.0;  // one to one, as IoU is above a half
  for (const auto& [t, row] : overlap.shared) {
    for (const auto& [m, pixels] : row) {
      const double iou = overlap.IoU(t, m);
      if (!(iou >= kPartnerIoU)) continue;
      truth.partners[t].push_back(m);
      machine.partners[m].push_back(t);
      if (!(iou >= kMatchIoU)) continue;
      truth.matched.insert(t);
      machine.matched.insert(m);
      matches += 1.0;
      score.mean_iou += iou;
      score.mean_dice += 2.0 * iou / (1.0 + iou);
    }
  }
  if (matches > 0.0) score.mean_iou /= matches, score.mean_dice /= matches;
  const PrecisionRecall found =
      MakeScores(matches, static_cast<double>(machine.partners.size()),
                 static_cast<double>(truth.partners.size()));
  score.precision = found.precision, score.recall = found.recall, score.f1 = found.f1;
  score.panoptic = score.mean_iou * score.f1;
  score.under_ratio = WithSeveral(machine);
  score.over_ratio = WithSeveral(truth);
  score.noise_ratio = WithoutCounterpart(machine, truth);
  score.missed_ratio = WithoutCounterpart(truth, machine);
  return score;
}

}  // namespace eval
