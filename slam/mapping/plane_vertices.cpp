#include "slam/mapping/plane_vertices.h"

#include <algorithm>
#include <array>
#include <limits>

#include "slam/model/map_queries.h"

namespace slam {
namespace {

// An extrapolated corner has twice the standard deviation of one that was seen.
constexpr double kSeenWeight = 1.0, kExtrapolatedWeight = 0.25;
constexpr double kMaxWeight = 40.0;  // so that a wrong start can still be left

/// The order around the face that moves the corners least: observed[order[i]] belongs to
/// known[i].
std::array<std::size_t, kFaceCorners> Order(const std::vector<Eigen::Vector3d>& known_w,
                                            const std::vector<Eigen::Vector3d>& observed_w) {
  std::array<std::size_t, kFaceCorners> best{0, 1, 2, 3};
  double min_sum = std::numeric_limits<double>::infinity();
  for (const bool reversed : {false, true}) {
    for (std::size_t shift = 0; shift < kFaceCorners; ++shift) {
      std::array<std::size_t, kFaceCorners> order{};
      double sum = 0.0;
      for (std::size_t i = 0; i < kFaceCorners; ++i) {
        order[i] = (reversed ? shift + kFaceCorners - i : shift + i) % kFaceCorners;
        sum += (known_w[i] - observed_w[order[i]]).squaredNorm();
      }
      if (sum < min_sum) {
        min_sum = sum;
        best = order;
      }
    }
  }
  return best;
}

/// Variance of a corner that is known to lie on the plane, mean of its two directions there.
double VarianceOnPlane(const Eigen::Vector3d& n, const Eigen::Matrix3d& covariance) {
  const Eigen::Vector3d spread = covariance * n;
  const double across = n.dot(spread);
  const double explained = across > 0 ? spread.squaredNorm() / across : 0.0;
  return 0.5 * (covariance.trace() - explained);
}

/// Weight of an observed corner: 1 for one that was seen and is known exactly.
double Weight(const Vertex& vertex, const Eigen::Vector3d& n_c) {
  return (vertex.extrapolated ? kExtrapolatedWeight : kSeenWeight) * kOtherVertexVariance_m2 /
         (kOtherVertexVariance_m2 + VarianceOnPlane(n_c, vertex.covariance_c));
}

/// Averages an observation of one corner into the known one.
void Average(MapPlane& m, std::size_t i, const Eigen::Vector3d& observed_w, double weight) {
  double& known = m.vertex_weights[i];
  const double sum = known + weight;
  m.vertices_w[i] = ProjectOnto(m.pi_w, (known * m.vertices_w[i] + weight * observed_w) / sum);
  known = std::min(sum, kMaxWeight);
}

/// A face seen in part: corners that were seen, not extrapolated, are averaged into the known
/// ones that they are at.
void ConfirmCorners(MapPlane& m, const std::vector<Vertex>& vertices_c, const Pose& T_wc,
                    const PlaneMapConfig& config) {
  const Eigen::Vector3d n_c = T_wc.R.transpose() * m.pi_w.n;
  for (const Vertex& vertex : vertices_c) {
    if (vertex.extrapolated || !vertex.p_c.allFinite()) continue;
    const Eigen::Vector3d observed_w = ProjectOnto(m.pi_w, T_wc * vertex.p_c);
    const auto at = NearestVertex(m, observed_w, config.max_vertex_jump_m);
    if (at) Average(m, *at, observed_w, Weight(vertex, n_c));
  }
}

}  // namespace

void FuseVertices(MapPlane& m, const std::vector<Vertex>& vertices_c, const Pose& T_wc,
                  const PlaneMapConfig& config) {
  const bool known =
      m.vertices_w.size() == kFaceCorners && m.vertex_weights.size() == kFaceCorners;
  if (vertices_c.size() != kFaceCorners) {
    if (known) ConfirmCorners(m, vertices_c, T_wc, config);
    return;
  }
  // The four corners of a whole face, on the map plane.
  std::vector<Eigen::Vector3d> observed_w;
  for (const Vertex& vertex : vertices_c) {
    if (!vertex.p_c.allFinite()) return;
    observed_w.push_back(ProjectOnto(m.pi_w, T_wc * vertex.p_c));
  }
  const Eigen::Vector3d n_c = T_wc.R.transpose() * m.pi_w.n;
  const auto weight = [&](std::size_t i) { return Weight(vertices_c[i], n_c); };
  if (!known) {
    m.vertices_w = observed_w;
    m.vertex_weights.clear();
    for (std::size_t i = 0; i < kFaceCorners; ++i) m.vertex_weights.push_back(weight(i));
    return;
  }
  // Near ones are averaged; a far one uses up the evidence for the known one, then replaces it.
  const auto order = Order(m.vertices_w, observed_w);
  for (std::size_t i = 0; i < kFaceCorners; ++i) {
    const std::size_t k = order[i];
    double& evidence = m.vertex_weights[i];
    if ((m.vertices_w[i] - observed_w[k]).norm() < config.max_vertex_jump_m) {
      Average(m, i, observed_w[k], weight(k));
      continue;
    }
    if (evidence > weight(k)) {
      evidence -= weight(k);
    } else {
      m.vertices_w[i] = observed_w[k];
      evidence = weight(k);
    }
    m.vertices_w[i] = ProjectOnto(m.pi_w, m.vertices_w[i]);
  }
}

}  // namespace slam
