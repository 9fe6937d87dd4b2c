#include "slam/places/close_gap.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <vector>

#include "slam/base/index.h"
#include "slam/places/carry_map.h"
#include "slam/pose/pose_error.h"

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

/// Along the axes of what was not known.
std::vector<Gap> GapsIn(const FoundPlace& found) {
  std::vector<Gap> gaps;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(found.before_w);
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d axis_w = axes.eigenvectors().col(i);
    const Gap gap{axis_w, axis_w.dot(found.off_w), axes.eigenvalues()[i],
                  axis_w.dot(found.after_w * axis_w)};
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
    const Eigen::Matrix3d place_w = PlaceCovariance(older.T_cw, older.covariance);
    share = std::min(share, gap.axis_w.dot(place_w * gap.axis_w) / gap.before_m2);
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

FoundPlace FoundOff(const Eigen::Vector3d& off_w, const Eigen::Matrix3d& now_w,
                    const Eigen::Matrix3d& before_w, const Eigen::Matrix3d& motion_w) {
  const Eigen::Matrix3d led_w = before_w + motion_w;
  if (!(led_w.determinant() > 0)) return {};
  return {before_w * led_w.inverse() * off_w, before_w, now_w + motion_w};
}

bool ClosesGap(const FoundPlace& found) { return !GapsIn(found).empty(); }

bool CloseGaps(Map& map, int keyframe) {
  const std::vector<Gap> gaps = GapsIn(map.keyframes[Index(keyframe)].found);
  for (const Gap& gap : gaps) Close(gap, keyframe, map);
  return !gaps.empty();
}

}  // namespace slam
