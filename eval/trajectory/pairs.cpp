#include "eval/trajectory/pairs.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace eval {
namespace {

double RelativeAngle(const Pose& a, const Pose& b) { return AngleOf(a.R.transpose() * b.R); }

/// Index from `first` on whose rising value is nearest to `target`; the first on ties.
std::size_t Nearest(const std::vector<double>& rising, std::size_t first, double target) {
  const auto begin = rising.begin() + static_cast<std::ptrdiff_t>(first);
  const auto above = std::lower_bound(begin, rising.end(), target);
  if (above == begin) return first;
  const auto below = std::lower_bound(begin, rising.end(), *(above - 1));
  const bool take_below =
      above == rising.end() || std::abs(*below - target) <= std::abs(*above - target);
  return static_cast<std::size_t>((take_below ? below : above) - rising.begin());
}

std::vector<double> PathLengths(const std::vector<Pose>& poses) {
  std::vector<double> lengths_m(poses.size(), 0.0);
  for (std::size_t i = 1; i < poses.size(); ++i) {
    lengths_m[i] = lengths_m[i - 1] + (poses[i].t - poses[i - 1].t).norm();
  }
  return lengths_m;
}

/// Each place but the last with the later one that is nearest to `delta` further on, if it is within
/// the tolerance. `places` rise.
std::vector<PosePair> PairsAlong(const std::vector<double>& places, double delta,
                                 double tolerance) {
  std::vector<PosePair> pairs;
  for (std::size_t i = 0; i + 1 < places.size(); ++i) {
    const std::size_t j = Nearest(places, i + 1, places[i] + delta);
    if (std::abs(places[j] - places[i] - delta) <= tolerance) pairs.emplace_back(i, j);
  }
  return pairs;
}

std::vector<PosePair> PairsOfMarks(const std::vector<Pose>& poses, double delta_m) {
  std::vector<PosePair> pairs;
  double path_m = 0.0;
  std::size_t last_mark = 0;
  bool has_mark = false;
  for (std::size_t i = 1; i < poses.size(); ++i) {
    path_m += (poses[i].t - poses[i - 1].t).norm();
    if (!(path_m >= delta_m)) continue;
    if (has_mark) pairs.emplace_back(last_mark, i);
    last_mark = i;
    has_mark = true;
    path_m = 0.0;
  }
  return pairs;
}

}  // namespace

std::vector<PosePair> PairsByFrames(std::size_t count, std::size_t delta, PairMode mode) {
  if (delta == 0) throw std::invalid_argument("PairsByFrames: the distance is 0");
  std::vector<PosePair> pairs;
  const std::size_t step = mode == PairMode::kAll ? 1 : delta;
  for (std::size_t i = 0; i + delta < count; i += step) pairs.emplace_back(i, i + delta);
  return pairs;
}

std::vector<PosePair> PairsByPath(const std::vector<Pose>& poses, double delta_m,
                                  double tolerance_m, PairMode mode) {
  if (mode == PairMode::kConsecutive) return PairsOfMarks(poses, delta_m);
  return PairsAlong(PathLengths(poses), delta_m, tolerance_m);
}

std::vector<PosePair> PairsByAngle(const std::vector<Pose>& poses, double delta_rad,
                                   double tolerance_rad, PairMode mode) {
  std::vector<PosePair> pairs;
  if (mode == PairMode::kConsecutive) {
    double turned_rad = 0.0;
    std::size_t start = 0;
    for (std::size_t i = 1; i < poses.size(); ++i) {
      turned_rad += RelativeAngle(poses[i - 1], poses[i]);
      if (!(turned_rad >= delta_rad)) continue;
      pairs.emplace_back(start, i);
      start = i;
      turned_rad = 0.0;
    }
    return pairs;
  }
  for (std::size_t i = 0; i < poses.size(); ++i) {
    for (std::size_t j = i + 1; j < poses.size(); ++j) {
      const double angle_rad = RelativeAngle(poses[i], poses[j]);
      if (angle_rad >= delta_rad - tolerance_rad && angle_rad <= delta_rad + tolerance_rad) {
        pairs.emplace_back(i, j);
      }
    }
  }
  return pairs;
}

std::vector<PosePair> PairsByTime(const std::vector<double>& stamps_s, double delta_s,
                                  double tolerance_s, PairMode mode) {
  std::vector<PosePair> all = PairsAlong(stamps_s, delta_s, tolerance_s);
  if (mode == PairMode::kAll) return all;
  std::vector<PosePair> chain;
  for (const PosePair& pair : all) {
    if (chain.empty() || pair.first >= chain.back().second) chain.push_back(pair);
  }
  return chain;
}

}  // namespace eval
