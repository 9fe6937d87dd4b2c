#include "eval/regression/paired_tests.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <stdexcept>
#include <utility>

namespace eval {
namespace {

/// Sums of differences that are equal but for rounding count as equal: some thousand ulps, far below
/// any figure's digits.
constexpr double kSumTolerance_ratio = 1e-12;

double MeanOf(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0) /
         static_cast<double>(values.size());
}

/// Quantile with linear interpolation (type 7) of sorted values.
double QuantileOfSorted(const std::vector<double>& sorted, double share) {
  const double place = share * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(std::floor(place));
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return std::lerp(sorted[below], sorted[above], place - std::floor(place));
}

/// Sizes of the groups of equal ranks.
std::vector<double> TieSizes(std::vector<double> ranks) {
  std::sort(ranks.begin(), ranks.end());
  std::vector<double> sizes;
  for (std::size_t i = 0; i < ranks.size(); ++i) {
    if (i == 0 || ranks[i] != ranks[i - 1]) sizes.push_back(0.0);
    sizes.back() += 1.0;
  }
  return sizes;
}

}  // namespace

double SignFlipP(std::span<const double> differences) {
  if (differences.size() > kMaxSignFlipPairs) {
    throw std::invalid_argument("SignFlipP: too many pairs for every assignment of signs");
  }
  // Every assignment of signs, one difference after the other.
  std::vector<double> sums{0.0};
  double scale = 0.0;
  for (const double difference : differences) {
    const std::size_t before = sums.size();
    for (std::size_t i = 0; i < before; ++i) {
      sums.push_back(sums[i] - difference);
      sums[i] += difference;
    }
    scale += std::abs(difference);
  }
  // The first sum is that of the differences as they are.
  const double limit = sums.front() - kSumTolerance_ratio * scale;
  const auto count =
      std::count_if(sums.begin(), sums.end(), [&](double sum) { return sum >= limit; });
  return static_cast<double>(count) / static_cast<double>(sums.size());
}

SignedRanks RankDifferences(std::span<const double> differences) {
  std::vector<double> nonzero;
  std::copy_if(differences.begin(), differences.end(), std::back_inserter(nonzero),
               [](double d) { return d != 0.0; });
  std::vector<std::size_t> order(nonzero.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::abs(nonzero[a]) < std::abs(nonzero[b]);
  });

  SignedRanks result;
  result.ranks.resize(nonzero.size());
  for (std::size_t from = 0, to = 0; from < order.size(); from = to) {
    while (to < order.size() &&
           std::abs(nonzero[order[to]]) == std::abs(nonzero[order[from]])) {
      ++to;
    }
    // Ties share the mean of the ranks from + 1 to `to`.
    const double rank = 0.5 * static_cast<double>(from + 1 + to);
    for (std::size_t i = from; i < to; ++i) {
      result.ranks[order[i]] = rank;
      (nonzero[order[i]] > 0.0 ? result.plus : result.minus) += rank;
    }
  }
  return result;
}

double WilcoxonExactP(std::span<const double> differences) {
  const SignedRanks ranked = RankDifferences(differences);
  // Twice a mean rank is whole, so the distribution of the sum lives on whole numbers.
  std::vector<double> chance{1.0};
  for (const double rank : ranked.ranks) {
    const auto step = static_cast<std::size_t>(std::lround(2.0 * rank));
    std::vector<double> next(chance.size() + step, 0.0);
    for (std::size_t sum = 0; sum < chance.size(); ++sum) {
      next[sum] += 0.5 * chance[sum];
      next[sum + step] += 0.5 * chance[sum];
    }
    chance = std::move(next);
  }
  const auto observed = std::lround(2.0 * ranked.plus);
  return std::min(1.0, std::accumulate(chance.begin() + observed, chance.end(), 0.0));
}

double WilcoxonNormalP(std::span<const double> differences, bool continuity) {
  const SignedRanks ranked = RankDifferences(differences);
  if (ranked.ranks.empty()) return 1.0;
  const auto n = static_cast<double>(ranked.ranks.size());
  double ties = 0.0;
  for (const double size : TieSizes(ranked.ranks)) ties += size * size * size - size;
  const double variance = (n * (n + 1) * (2 * n + 1) - 0.5 * ties) / 24;
  const double lead = ranked.plus - n * (n + 1) / 4 - (continuity ? 0.5 : 0.0);
  return 0.5 * std::erfc(lead / std::sqrt(2 * variance));
}

double HodgesLehmannShift(std::span<const double> differences) {
  std::vector<double> means;
  means.reserve(differences.size() * (differences.size() + 1) / 2);
  for (std::size_t i = 0; i < differences.size(); ++i) {
    for (std::size_t j = i; j < differences.size(); ++j) {
      means.push_back(0.5 * (differences[i] + differences[j]));
    }
  }
  if (means.empty()) return 0.0;
  std::sort(means.begin(), means.end());
  return QuantileOfSorted(means, 0.5);
}

std::vector<double> HolmAdjusted(std::span<const double> p_values) {
  std::vector<std::pair<double, std::size_t>> rising;
  for (std::size_t i = 0; i < p_values.size(); ++i) rising.emplace_back(p_values[i], i);
  std::sort(rising.begin(), rising.end());
  std::vector<double> adjusted(p_values.size());
  double largest = 0.0;
  auto hypotheses_left = static_cast<double>(rising.size());
  for (const auto& [p, i] : rising) {
    largest = std::max(largest, std::min(1.0, hypotheses_left * p));
    adjusted[i] = largest;
    hypotheses_left -= 1.0;
  }
  return adjusted;
}

ConfidenceInterval BootstrapMeanInterval(std::span<const double> differences,
                                         const std::vector<std::vector<std::size_t>>& resamples,
                                         double coverage) {
  if (differences.empty() || resamples.empty()) return {};
  std::vector<double> means;
  std::vector<double> drawn(differences.size());
  for (const std::vector<std::size_t>& resample : resamples) {
    drawn.resize(resample.size());
    std::transform(resample.begin(), resample.end(), drawn.begin(),
                   [&](std::size_t i) { return differences[i]; });
    means.push_back(MeanOf(drawn));
  }
  std::sort(means.begin(), means.end());
  const double outside = 0.5 * (1.0 - coverage);
  return {QuantileOfSorted(means, outside), QuantileOfSorted(means, 1.0 - outside)};
}

std::vector<std::vector<std::size_t>> DrawResamples(std::size_t size, std::size_t count) {
  std::mt19937_64 random(size);  // its numbers are the same on every machine
  std::vector<std::vector<std::size_t>> resamples(count, std::vector<std::size_t>(size));
  for (std::vector<std::size_t>& resample : resamples) {
    for (std::size_t& index : resample) index = random() % size;
  }
  return resamples;
}

}  // namespace eval
