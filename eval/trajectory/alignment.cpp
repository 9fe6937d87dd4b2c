#include "eval/trajectory/alignment.h"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>
#include <variant>

namespace eval {
namespace {

/// Positions closer together than this share of their distance from the origin are one position
/// and its round-off.
constexpr double kMinSpreadRatio = 1e-13;

Eigen::Vector3d MeanOf(const std::vector<Eigen::Vector3d>& points) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : points) sum += p;
  return sum / static_cast<double>(points.size());
}

std::variant<Alignment, NoAlignment> Align(const std::vector<Eigen::Vector3d>& x_w,
                                           const std::vector<Eigen::Vector3d>& y_g,
                                           bool with_scale) {
  if (x_w.size() != y_g.size()) {
    throw std::invalid_argument("AlignUmeyama: the lists differ in length");
  }
  if (x_w.size() < 3) return NoAlignment::kFewPoses;
  const double n = static_cast<double>(x_w.size());
  const Eigen::Vector3d mean_x = MeanOf(x_w), mean_y = MeanOf(y_g);
  Eigen::Matrix3d sigma = Eigen::Matrix3d::Zero();
  double variance_x = 0.0, variance_y = 0.0;
  for (std::size_t i = 0; i < x_w.size(); ++i) {
    sigma += (y_g[i] - mean_y) * (x_w[i] - mean_x).transpose() / n;
    variance_x += (x_w[i] - mean_x).squaredNorm() / n;
    variance_y += (y_g[i] - mean_y).squaredNorm() / n;
  }
  const auto stands_still = [](double variance, const Eigen::Vector3d& mean) {
    return !(std::sqrt(variance) > kMinSpreadRatio * mean.norm());
  };
  if (stands_still(variance_x, mean_x) || stands_still(variance_y, mean_y)) {
    return NoAlignment::kStandsStill;
  }
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(sigma, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Eigen::Vector3d& d = svd.singularValues();
  if (!(d[0] > 0.0) || !(d[1] >= kMinSingularRatio * d[0])) return NoAlignment::kLine;
  Eigen::Vector3d s = Eigen::Vector3d::Ones();
  if (svd.matrixU().determinant() * svd.matrixV().determinant() < 0.0) s[2] = -1.0;
  Alignment alignment;
  alignment.T_gw.R = svd.matrixU() * s.asDiagonal() * svd.matrixV().transpose();
  if (with_scale) alignment.scale = d.dot(s) / variance_x;
  alignment.T_gw.t = mean_y - alignment.scale * (alignment.T_gw.R * mean_x);
  return alignment;
}

// A drifting estimate fits somewhat better with a scale, and a nearly flat path with a mirror. A
// wrong unit or a mirror explains nearly all that is wrong.
constexpr double kMinGain = 4.0;
// A depth factor that is wrong is wrong by more: 5000 for 6553.5, 1000 for 5000.
constexpr double kMinScaleChange = 1.1;
// Below this share of the path's extent nothing of the kind is wrong.
constexpr double kMinErrorShare = 0.01;

double RmseOf(const Alignment& alignment, const std::vector<Eigen::Vector3d>& x_w,
              const std::vector<Eigen::Vector3d>& y_g) {
  double sse = 0.0;
  for (std::size_t i = 0; i < x_w.size(); ++i) {
    const Pose T_wc{Eigen::Matrix3d::Identity(), x_w[i]};
    sse += ((alignment * T_wc).t - y_g[i]).squaredNorm();
  }
  return std::sqrt(sse / static_cast<double>(x_w.size()));
}

}  // namespace

std::optional<Alignment> AlignUmeyama(const std::vector<Eigen::Vector3d>& x_w,
                                      const std::vector<Eigen::Vector3d>& y_g,
                                      bool with_scale) {
  const auto found = Align(x_w, y_g, with_scale);
  const auto* alignment = std::get_if<Alignment>(&found);
  return alignment != nullptr ? std::optional(*alignment) : std::nullopt;
}

std::optional<NoAlignment> WhyNotAligned(const std::vector<Eigen::Vector3d>& x_w,
                                         const std::vector<Eigen::Vector3d>& y_g) {
  const auto found = Align(x_w, y_g, false);
  const auto* reason = std::get_if<NoAlignment>(&found);
  return reason != nullptr ? std::optional(*reason) : std::nullopt;
}

std::string TextOf(NoAlignment reason, const std::string& what, std::size_t count) {
  switch (reason) {
    case NoAlignment::kFewPoses:
      return "only " + std::to_string(count) + " " + what + ", 3 are needed";
    case NoAlignment::kStandsStill:
      return "the " + what + " stand still";
    case NoAlignment::kLine:
      break;
  }
  return "the " + what + " lie on a line to working precision, about which any turn fits";
}

std::optional<BetterFit> FindBetterFit(const std::vector<Eigen::Vector3d>& x_w,
                                       const std::vector<Eigen::Vector3d>& y_g) {
  const auto rigid = AlignUmeyama(x_w, y_g);
  if (!rigid) return std::nullopt;
  const double rigid_rmse_m = RmseOf(*rigid, x_w, y_g);
  double variance_m2 = 0.0;
  const Eigen::Vector3d mean = MeanOf(y_g);
  for (const Eigen::Vector3d& y : y_g) variance_m2 += (y - mean).squaredNorm();
  const double extent_m = std::sqrt(variance_m2 / static_cast<double>(y_g.size()));
  if (!(rigid_rmse_m > kMinErrorShare * extent_m)) return std::nullopt;
  std::vector<Eigen::Vector3d> mirrored = x_w;
  for (Eigen::Vector3d& x : mirrored) x.x() = -x.x();
  // The simplest explanation that does first.
  for (const auto& [mirror, scaled] : {std::pair(false, true), {true, false}, {true, true}}) {
    const std::vector<Eigen::Vector3d>& positions = mirror ? mirrored : x_w;
    const auto fit = AlignUmeyama(positions, y_g, scaled);
    if (!fit) continue;
    const double rmse_m = RmseOf(*fit, positions, y_g);
    const double change = std::max(fit->scale, 1.0 / fit->scale);
    if (scaled && !(change > kMinScaleChange)) continue;
    if (kMinGain * rmse_m < rigid_rmse_m) {
      return BetterFit{fit->scale, mirror, rigid_rmse_m, rmse_m};
    }
  }
  return std::nullopt;
}

std::vector<Eigen::Vector3d> PositionsOf(const std::vector<Pose>& poses) {
  std::vector<Eigen::Vector3d> positions;
  positions.reserve(poses.size());
  for (const Pose& pose : poses) positions.push_back(pose.t);
  return positions;
}

std::vector<Pose> Apply(const Alignment& alignment, const std::vector<Pose>& poses) {
  std::vector<Pose> aligned;
  aligned.reserve(poses.size());
  for (const Pose& pose : poses) aligned.push_back(alignment * pose);
  return aligned;
}

std::optional<Alignment> AlignByPoses(const std::vector<Pose>& T_wc,
                                      const std::vector<Pose>& T_gc) {
  if (T_wc.size() != T_gc.size()) {
    throw std::invalid_argument("AlignByPoses: the lists differ in length");
  }
  if (T_wc.empty()) return std::nullopt;
  Eigen::Matrix3d sum_R = Eigen::Matrix3d::Zero();
  Eigen::Vector3d sum_w = Eigen::Vector3d::Zero(), sum_g = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < T_wc.size(); ++i) {
    sum_R += T_gc[i].R * T_wc[i].R.transpose();
    sum_w += T_wc[i].t;
    sum_g += T_gc[i].t;
  }
  // The rotation nearest to the sum; it is the only one unless the two lesser axes cancel.
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(sum_R, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Eigen::Vector3d& d = svd.singularValues();
  Eigen::Vector3d s = Eigen::Vector3d::Ones();
  if (svd.matrixU().determinant() * svd.matrixV().determinant() < 0.0) s[2] = -1.0;
  if (!(d[1] + s[2] * d[2] > kMinSingularRatio * d[0])) return std::nullopt;
  Alignment alignment;
  alignment.T_gw.R = svd.matrixU() * s.asDiagonal() * svd.matrixV().transpose();
  const double n = static_cast<double>(T_wc.size());
  alignment.T_gw.t = sum_g / n - alignment.T_gw.R * (sum_w / n);
  return alignment;
}

Alignment AlignOrigin(const Pose& first_T_wc, const Pose& first_T_gc) {
  return {1.0, first_T_gc * Inverse(first_T_wc)};
}

}  // namespace eval
