#include "slam/places/close_gap.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <vector>

#include "slam/base/index.h"
#include "slam/places/carry_map.h"

namespace slam {
namespace {

/// Along one direction of the world.
struct Gap {
  Eigen::Vector3d axis_w;
  double off_m = 0.0;
  double before_m2 = 0.0, after_m2 = 0.0;  ///< variances of the camera's place
};

constexpr double kMuchLess = 0.25;  // of the variance: half of the standard deviation
constexpr double kClear = 3.0, kCredible = 5.0;  // standard deviations after and before

Eigen::Matrix3d PlaceCovariance(const Keyframe& keyframe) {
  const Eigen::Matrix3d& R_cw = keyframe.T_cw.R;
  return R_cw.transpose() * keyframe.covariance.topLeftCorner<3, 3>() * R_cw;
}

/// The newest keyframe older than `id` that counts. Null: none.
const Keyframe* Before(const Map& map, std::size_t id) {
  while (id-- > 0)
    if (!map.keyframes[id].culled) return &map.keyframes[id];
  return nullptr;
}

/// Along the axes of what the older keyframe does not know.
std::vector<Gap> GapsSince(const Keyframe& older, const FoundPlace& found) {
  std::vector<Gap> gaps;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(PlaceCovariance(older));
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d axis_w = axes.eigenvectors().col(i);
    const Gap gap{axis_w, axis_w.dot(found.off_w), axes.eigenvalues()[i],
                  axis_w.dot(found.covariance_w * axis_w)};
    if (gap.after_m2 < kMuchLess * gap.before_m2 &&
        std::abs(gap.off_m) > kClear * std::sqrt(gap.after_m2) &&
        std::abs(gap.off_m) < kCredible * std::sqrt(gap.before_m2))
      gaps.push_back(gap);
  }
  return gaps;
}

/// Moves the keyframe by its share of the gap, and takes what it has learnt so out of its covariance.
void Shift(const Gap& gap, double share, Keyframe& keyframe) {
  Vector6d along = Vector6d::Zero();
  along.head<3>() = keyframe.T_cw.R * gap.axis_w;
  keyframe.T_cw.t -= share * gap.off_m * along.head<3>();
  const Vector6d shared = keyframe.covariance * along;
  const double own_m2 = along.dot(shared);
  const double learnt_m2 = share * share * (gap.before_m2 - gap.after_m2);
  keyframe.covariance -= learnt_m2 / (own_m2 * own_m2) * shared * shared.transpose();
}

/// The same for what is known of a surface that was first seen in that frame.
void Learn(const Gap& gap, const Map& map, const std::vector<Pose>& before, int first_frame,
           const Eigen::Vector3d& n_w, PlaneEstimate& estimate) {
  const double share = CarriageSince(map, before, first_frame).t.dot(gap.axis_w) / gap.off_m;
  const double along = n_w.dot(gap.axis_w);
  estimate.world_variance_m2 =
      std::max(0.0, estimate.world_variance_m2 -
                        share * share * along * along * (gap.before_m2 - gap.after_m2));
}

void Close(const Gap& gap, int keyframe, Map& map) {
  const std::vector<Pose> before = KeyframePoses(map);
  double share = 1.0;
  for (int id = keyframe - 1; id > 0; --id) {
    Keyframe& older = map.keyframes[Index(id)];
    if (older.culled) continue;
    const double own_m2 = gap.axis_w.dot(PlaceCovariance(older) * gap.axis_w);
    share = std::min(share, own_m2 / gap.before_m2);
    if (share > 0) Shift(gap, share, older);
  }
  for (MapPlane& plane : map.planes) {
    Learn(gap, map, before, plane.first_frame, plane.pi_w.n, plane.estimate);
    for (SupposedPlane& supposed : plane.supposed)
      Learn(gap, map, before, supposed.first_frame, supposed.pi_w.n, supposed.estimate);
  }
  CarryPoints(map, before);
  CarryPlanes(map, before);
}

}  // namespace

FoundPlace FoundOff(const Eigen::Vector3d& off_w, const Eigen::Matrix3d& covariance_w,
                    const Eigen::Matrix3d& before_w, const Eigen::Matrix3d& motion_w) {
  const Eigen::Matrix3d led_w = before_w + motion_w;
  if (!(led_w.determinant() > 0)) return {};
  return {before_w * led_w.inverse() * off_w, covariance_w + motion_w};
}

bool ClosesGap(const Map& map, const FoundPlace& found) {
  const Keyframe* older = Before(map, map.keyframes.size());
  return older != nullptr && !GapsSince(*older, found).empty();
}

bool CloseGaps(Map& map, int keyframe) {
  const Keyframe* older = Before(map, Index(keyframe));
  if (older == nullptr) return false;
  const Keyframe& newest = map.keyframes[Index(keyframe)];
  const std::vector<Gap> gaps = GapsSince(*older, {newest.off_w, PlaceCovariance(newest)});
  for (const Gap& gap : gaps) Close(gap, keyframe, map);
  return !gaps.empty();
}

}  // namespace slam
