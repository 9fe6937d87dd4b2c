#include "eval/planes/corners.h"

#include "eval/planes/hungarian.h"

namespace eval {
namespace {

constexpr double kMinTopNormalZ = 0.9;

/// Outweighs any sum of distances, so that the number of matches comes first.
constexpr double kMatchWeight = 1e3;

bool IsRegularTop(const SeenPlane& seen) {
  return seen.object->role == Role::kRegular && seen.plane->pi_g.n.z() > kMinTopNormalZ &&
         seen.corners_c.size() == 4;
}

}  // namespace

std::vector<int> MatchCorners(const std::vector<Eigen::Vector3d>& claimed,
                              const std::vector<Eigen::Vector3d>& truth, double max_error_m) {
  Eigen::MatrixXd weight(Eigen::Index(claimed.size()), Eigen::Index(truth.size()));
  for (std::size_t i = 0; i < claimed.size(); ++i) {
    for (std::size_t j = 0; j < truth.size(); ++j) {
      const double error_m = (claimed[i] - truth[j]).norm();
      weight(Eigen::Index(i), Eigen::Index(j)) =
          error_m <= max_error_m ? kMatchWeight - error_m / max_error_m : 0.0;
    }
  }
  std::vector<int> match = AssignMaxWeight(weight);
  for (std::size_t i = 0; i < match.size(); ++i) {
    if (match[i] >= 0 && !(weight(Eigen::Index(i), match[i]) > 0.0)) match[i] = -1;
  }
  return match;
}

CornerCounts& CornerCounts::operator+=(const CornerCounts& other) {
  claimed += other.claimed, matched += other.matched;
  true_in_view += other.true_in_view, found_in_view += other.found_in_view;
  faces_in_view += other.faces_in_view, faces_with_4 += other.faces_with_4;
  errors_mm.insert(errors_mm.end(), other.errors_mm.begin(), other.errors_mm.end());
  return *this;
}

void CornerCounts::AddPlane(const SeenPlane& seen,
                            const std::vector<Eigen::Vector3d>& claimed_c) {
  std::vector<bool> found(seen.corners_c.size(), false);
  const std::vector<int> match = MatchCorners(claimed_c, seen.corners_c, kMaxCornerError_m);
  int matches = 0;
  for (std::size_t i = 0; i < match.size(); ++i) {
    if (match[i] < 0) continue;
    const auto j = static_cast<std::size_t>(match[i]);
    found[j] = true;
    ++matches;
    errors_mm.push_back((claimed_c[i] - seen.corners_c[j]).norm() * 1e3);
  }
  claimed += static_cast<int>(claimed_c.size());
  matched += matches;
  if (!seen.counted) return;
  bool all_in_view = true;
  for (std::size_t j = 0; j < found.size(); ++j) {
    all_in_view = all_in_view && seen.corner_in_view[j];
    if (!seen.corner_in_view[j]) continue;
    ++true_in_view;
    if (found[j]) ++found_in_view;
  }
  if (!IsRegularTop(seen) || !all_in_view) return;
  ++faces_in_view;
  if (matches == 4) ++faces_with_4;
}

}  // namespace eval
