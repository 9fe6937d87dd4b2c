#include "slam/associate/rank_test.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "slam/base/require.h"

namespace slam {
namespace {

constexpr std::size_t kMinNormal = 9;  // of both samples; from here on the normal form holds
constexpr std::size_t kMaxExact = 60;  // larger partners of a small sample are thinned: memory

/// Both samples in one order.
struct Pooled {
  std::vector<std::int64_t> twice_ranks;  ///< 2 x mean rank of each value, ascending values
  std::vector<bool> from_c;
  double tie_sum = 0.0;  ///< sum of tau^3 - tau
};

Pooled Pool(std::span<const double> sample_c, std::span<const double> sample_w) {
  std::vector<std::pair<double, bool>> values;
  values.reserve(sample_c.size() + sample_w.size());
  for (const double v : sample_c) values.emplace_back(v, true);
  for (const double v : sample_w) values.emplace_back(v, false);
  std::sort(values.begin(), values.end());
  // Equal values are a group of size tau and share their mean rank.
  Pooled pooled;
  for (std::size_t i = 0; i < values.size();) {
    std::size_t end = i;
    while (end < values.size() && values[end].first == values[i].first) ++end;
    const double tau = static_cast<double>(end - i);
    pooled.tie_sum += tau * tau * tau - tau;
    for (std::size_t k = i; k < end; ++k) {
      pooled.twice_ranks.push_back(static_cast<std::int64_t>(i + 1 + end));
      pooled.from_c.push_back(values[k].second);
    }
    i = end;
  }
  return pooled;
}

/// Share of the ways to choose `size` of the ranks whose sum is at least `far` from the mean,
/// all counted in half ranks. Dynamic programme over (chosen, sum).
double ExactP(const std::vector<std::int64_t>& twice_ranks, std::size_t size,
              std::int64_t sum) {
  const std::int64_t n = static_cast<std::int64_t>(twice_ranks.size());
  const std::int64_t mean = static_cast<std::int64_t>(size) * (n + 1);
  const std::int64_t far = std::abs(sum - mean);
  // ways[k][s]: ways to choose k of the ranks so far with the sum s.
  std::int64_t largest = 0;
  for (std::size_t i = 0; i < size; ++i) largest += twice_ranks[twice_ranks.size() - 1 - i];
  const auto width = static_cast<std::size_t>(largest + 1);
  std::vector<double> ways((size + 1) * width, 0.0);
  ways[0] = 1.0;
  for (const std::int64_t rank : twice_ranks) {
    const auto r = static_cast<std::size_t>(rank);
    for (std::size_t k = size; k-- > 0;) {
      for (std::size_t s = width; s-- > r;)
        ways[(k + 1) * width + s] += ways[k * width + s - r];
    }
  }
  // Of all ways, those at least as far from the mean as what was observed.
  double all = 0.0, extreme = 0.0;
  for (std::size_t s = 0; s < width; ++s) {
    const double count = ways[size * width + s];
    all += count;
    if (std::abs(static_cast<std::int64_t>(s) - mean) >= far) extreme += count;
  }
  return extreme / all;
}

/// Two-sided p-value of W in the normal approximation.
double NormalP(double W, double I, double J, double tie_sum) {
  const double mean = I * J / 2;  // eq10
  const double N = I + J;
  const double variance = I * J / 12 * (N + 1 - tie_sum / (N * (N - 1)));  // eq11
  if (!(variance > 0)) return 1.0;
  const double z = (W - mean + 0.5) / std::sqrt(variance);  // eq12
  return std::min(1.0, std::erfc(-z / std::sqrt(2.0)));
}

/// Every k-th value in sorted order: keeps the distribution of a sample.
std::vector<double> Thinned(std::span<const double> sample, std::size_t size) {
  std::vector<double> sorted(sample.begin(), sample.end());
  if (sorted.size() <= size) return sorted;
  std::sort(sorted.begin(), sorted.end());
  std::vector<double> out;
  out.reserve(size);
  for (std::size_t i = 0; i < size; ++i)
    out.push_back(sorted[(2 * i + 1) * sorted.size() / (2 * size)]);
  return out;
}

}  // namespace

RankTest TestRanks(std::span<const double> sample_c, std::span<const double> sample_w) {
  for (const auto& sample : {sample_c, sample_w}) {
    for (const double v : sample) Require(!std::isnan(v), "TestRanks: a value is NaN");
  }
  RankTest out;
  if (sample_c.empty() || sample_w.empty()) return out;
  out.exact = std::min(sample_c.size(), sample_w.size()) < kMinNormal;
  std::vector<double> thin_c, thin_w;
  if (out.exact) {
    thin_c = Thinned(sample_c, kMaxExact);
    thin_w = Thinned(sample_w, kMaxExact);
    sample_c = thin_c;
    sample_w = thin_w;
  }
  const Pooled pooled = Pool(sample_c, sample_w);
  std::int64_t twice_sum_c = 0, twice_sum_w = 0;
  for (std::size_t i = 0; i < pooled.twice_ranks.size(); ++i) {
    (pooled.from_c[i] ? twice_sum_c : twice_sum_w) += pooled.twice_ranks[i];
  }
  const double I = static_cast<double>(sample_c.size()),
               J = static_cast<double>(sample_w.size());
  out.U_c = 0.5 * static_cast<double>(twice_sum_c) - I * (I + 1) / 2;  // eq9
  out.U_w = I * J - out.U_c;
  if (out.exact) {
    const bool c_smaller = sample_c.size() <= sample_w.size();
    out.p = ExactP(pooled.twice_ranks, std::min(sample_c.size(), sample_w.size()),
                   c_smaller ? twice_sum_c : twice_sum_w);
  } else {
    out.p = NormalP(std::min(out.U_c, out.U_w), I, J, pooled.tie_sum);
  }
  return out;
}

std::optional<double> TestPlaneRanks(std::span<const Eigen::Vector3d> points_c,
                                     std::span<const Eigen::Vector3d> points_w,
                                     const Eigen::Matrix3d& axes, int min_points) {
  const auto min_size = static_cast<std::size_t>(std::max(1, min_points));
  if (points_c.size() < min_size || points_w.size() < min_size) return std::nullopt;
  double p = 1.0;
  std::vector<double> along_c(points_c.size()), along_w(points_w.size());
  for (int axis = 0; axis < 3; ++axis) {
    for (std::size_t i = 0; i < points_c.size(); ++i)
      along_c[i] = axes.col(axis).dot(points_c[i]);
    for (std::size_t i = 0; i < points_w.size(); ++i)
      along_w[i] = axes.col(axis).dot(points_w[i]);
    p = std::min(p, 3 * TestRanks(along_c, along_w).p);  // Bonferroni
  }
  return p;
}

Eigen::Matrix3d PlaneAxes(const Plane& pi, std::span<const Eigen::Vector3d> points) {
  const Eigen::Matrix<double, 3, 2> E = TangentBasis(pi.n);
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : points) mean += p;
  if (!points.empty()) mean /= static_cast<double>(points.size());
  Eigen::Matrix2d scatter = Eigen::Matrix2d::Zero();
  for (const Eigen::Vector3d& p : points) {
    const Eigen::Vector2d q = E.transpose() * (p - mean);
    scatter += q * q.transpose();
  }
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(scatter);
  Eigen::Matrix3d axes;
  axes.col(0) = E * solver.eigenvectors().col(1);
  axes.col(1) = E * solver.eigenvectors().col(0);
  axes.col(2) = pi.n;
  return axes;
}

}  // namespace slam
