#pragma once

#include <span>
#include <vector>

/// Statistics of paired differences, candidate minus baseline, one pair a seed.
namespace eval {

/// Most pairs for which SignFlipP visits every assignment of signs.
inline constexpr std::size_t kMaxSignFlipPairs = 20;  // 2^20 sums: some milliseconds, 8 MB

/// Probability that signs drawn by chance give a mean at least as large as that of the
/// differences; one-sided and exact. 1 without pairs.
/// @throws std::invalid_argument for more than kMaxSignFlipPairs
double SignFlipP(std::span<const double> differences);

/// Sums of the ranks of |difference| by sign; zeros are left out, ties share their mean rank.
struct SignedRanks {
  double plus = 0.0, minus = 0.0;
  std::vector<double> ranks;  ///< of the differences that are not zero, in their order
};
SignedRanks RankDifferences(std::span<const double> differences);

/// Wilcoxon's signed rank test, one-sided: are the differences larger than zero? Exact, with ties
/// too. 1 when all are zero.
double WilcoxonExactP(std::span<const double> differences);

/// The same by the normal approximation, its variance corrected for ties.
/// @param continuity  take half a rank off before dividing, so that p errs on the safe side
double WilcoxonNormalP(std::span<const double> differences, bool continuity);

/// Median of the means of all pairs of differences, each with itself too: the shift that the
/// differences speak for. 0 without pairs.
double HodgesLehmannShift(std::span<const double> differences);

/// Holm's adjusted p-values, in the order given: those below alpha are rejected together with a
/// chance of at most alpha that any is rejected wrongly.
std::vector<double> HolmAdjusted(std::span<const double> p_values);

struct ConfidenceInterval {
  double low = 0.0, high = 0.0;
};

/// Interval of the mean by the percentile bootstrap: quantiles are interpolated linearly.
/// @param resamples  lists of indices into the differences, see DrawResamples
/// @param coverage   share of the resampled means inside, 0.95
ConfidenceInterval BootstrapMeanInterval(std::span<const double> differences,
                                         const std::vector<std::vector<std::size_t>>& resamples,
                                         double coverage);

/// `count` lists of `size` indices below `size`; the same arguments give the same lists.
std::vector<std::vector<std::size_t>> DrawResamples(std::size_t size, std::size_t count);

}  // namespace eval
