#include "slam/tracking/point_tracking.h"

#include <algorithm>

#include "slam/base/index.h"
#include "slam/base/require.h"
#include "slam/features/compensate_motion.h"
#include "slam/model/map_queries.h"

namespace slam {
namespace {

int CountMatches(const std::vector<int>& matches) {
  return static_cast<int>(matches.size()) -
         static_cast<int>(std::count(matches.begin(), matches.end(), kNone));
}

/// A bound meant for `full` features, less in proportion for images that have fewer, but not
/// below `lowest`.
int Scaled(int bound, double have, double full, int lowest) {
  return std::clamp(static_cast<int>(bound * have / full), std::min(lowest, bound), bound);
}

constexpr double kFullImage_px2 = 640.0 * 480.0;
constexpr double kRichFeatures = 300.0;  // a frame with fewer cannot be asked for all inliers
constexpr int kMinInliers = 15;      // balances images with few features against wrong poses
constexpr int kMinStartPoints = 40;  // balances a bare start against none
constexpr int kManySure = 50;        // balances rooms with little print against walls with none
constexpr double kWiderSearch = 2.0;       // where few points are found; ORB-SLAM2
constexpr double kLostRadiusFactor = 2.0;  // a pose without prediction is less exact

/// Inliers that can be asked of a frame. @param bound  for one with many features
int MinInliers(const Frame& frame, int bound) {
  return Scaled(bound, static_cast<double>(frame.features.size()), kRichFeatures, kMinInliers);
}

}  // namespace

const char* StateName(const PointTrackReport& report) {
  switch (report.state) {
    case TrackState::kInitialising:
      return "initialising";
    case TrackState::kLost:
      return report.ambiguous ? "ambiguous" : "lost";
    case TrackState::kHeldByPlanes:
      return report.by_relocalising ? "relocalised" : "planes";
    case TrackState::kTracking:
      break;
  }
  return report.by_relocalising ? "relocalised" : "tracking";
}

PointTracking::PointTracking(const Camera& camera, const FeatureScale& scale,
                             const PointSearchConfig& search, const PointTrackingConfig& config,
                             const Vocabulary& vocabulary)
    : camera_(camera),
      scale_(scale),
      search_(search),
      config_(config),
      motion_filter_(config.motion),
      places_(vocabulary) {}

PointTrackReport PointTracking::TrackPoints(Frame& frame, Map& map) {
  PointTrackReport report;
  frame.ForgetPose();
  if (map.keyframes.empty()) {
    if (PointsCanStart(frame)) Start(report);
    report.state = state_;
    return report;
  }
  if (state_ == TrackState::kLost) ForgetMotion();
  const std::optional<UncertainPose> prediction = motion_filter_.Predict(frame.timestamp_s);
  frame.prediction = prediction;
  const int reference = reference_;
  const FeatureGrid grid(frame.features, camera_);
  const bool found = (state_ != TrackState::kLost && TrackOn(frame, grid, map, report)) ||
                     FindAgain(frame, grid, map, report);
  if (!found) {
    frame.ForgetPose();
    frame.prediction = prediction;
    report.by_relocalising = false;
    reference_ = reference;
  } else if (!report.by_motion) {
    ForgetMotion();  // found elsewhere than it led: a jump is no speed
  }
  state_ = found ? TrackState::kTracking : TrackState::kLost;
  followed_ = report.followed;
  report.state = state_;
  return report;
}

/// From a prediction, by motion or by the reference keyframe; then with the local map.
bool PointTracking::TrackOn(Frame& frame, const FeatureGrid& grid, Map& map,
                            PointTrackReport& report) {
  const int min_inliers = MinInliers(frame, config_.min_inliers);
  const Vector6d predicted_speed = frame.speed.mean;
  bool found = TrackByMotion(frame, grid, map, report) || TrackByReference(frame, map);
  // The pose tells the speed, and that where the features are; but a jump is no speed.
  if (report.by_motion) CompensateAtPose(frame);
  found = found && TrackLocalMap(frame, FeatureGrid(frame.features, camera_), map, min_inliers,
                                 config_.local_radius_factor, report);
  // The local map's pose tells it better.
  if (found && report.by_motion && CompensateAtPose(frame)) {
    report.inliers = Optimise(frame, map);
    found = report.inliers >= min_inliers;
  }
  if (!found && report.by_motion) CompensateMotion(camera_, predicted_speed, frame);
  return found;
}

/// From the places that look like the frame, unless the map looks so elsewhere too.
/// @param grid  of the features as they are predicted
bool PointTracking::FindAgain(Frame& frame, const FeatureGrid& grid, Map& map,
                              PointTrackReport& report) {
  frame.prediction.reset();  // it did not help: the camera may be anywhere
  const int min_inliers = MinInliers(frame, config_.min_relocalised_inliers);
  return TrackByRelocalising(frame, map, report) &&
         TrackLocalMap(frame, grid, map, min_inliers,
                       kLostRadiusFactor * config_.local_radius_factor, report) &&
         !FindLookAlike(frame, map, config_.look_alike);
}

void PointTracking::ForgetMotion() {
  motion_.Forget();
  motion_filter_.Forget();
}

void PointTracking::Start(PointTrackReport& report) {
  report.started = true;
  report.state = state_ = TrackState::kTracking;
}

bool PointTracking::PointsCanStart(const Frame& frame) const {
  const auto with_depth =
      std::count_if(frame.features.begin(), frame.features.end(),
                    [](const PointFeature& feature) { return feature.depth_m > 0; });
  const double area = static_cast<double>(camera_.width) * camera_.height;
  return with_depth >= Scaled(config_.min_start_points, area, kFullImage_px2, kMinStartPoints);
}

bool PointTracking::TrackByMotion(Frame& frame, const FeatureGrid& grid, const Map& map,
                                  PointTrackReport& report) const {
  const Pose predicted_T_cw = motion_.Predict(frame.timestamp_s).value_or(LastPose(last_, map));
  const std::vector<SeenPoint> seen = SeenPoints(
      last_, map, camera_, scale_.CloseDepth_m(camera_.fx), config_.max_temporary_points);
  // Match with what the last frame saw, in a wider square when few are found.
  std::vector<int> matches;
  std::vector<PointQuery> queries;
  for (const double factor : {1.0, kWiderSearch}) {
    queries = QueriesOf(seen, last_, predicted_T_cw, camera_, scale_,
                        factor * config_.last_radius_px);
    matches = MatchQueries(queries, frame.features, grid, {}, config_.match_last);
    if (CountMatches(matches) >= config_.min_last_matches) break;
  }

  // Pose from these matches; only inliers that are in the map stay matched.
  PoseProblem problem;
  problem.T_cw = predicted_T_cw;
  problem.prior = frame.prediction;
  std::vector<std::pair<int, int>> feature_and_point;
  for (std::size_t f = 0; f < matches.size(); ++f) {
    if (matches[f] == kNone) continue;
    const SeenPoint& point = seen[Index(queries[Index(matches[f])].point)];
    problem.points.push_back(ConstraintOf(frame.features[f], point.p_w, scale_));
    feature_and_point.emplace_back(static_cast<int>(f), point.map_point);
  }
  const PoseSummary summary = OptimisePose(problem, camera_, search_.pose);
  report.followed = summary.inlier_count;
  if (!summary.usable) return false;
  frame.ForgetPose();
  frame.T_cw = summary.T_cw;
  for (std::size_t i = 0; i < feature_and_point.size(); ++i) {
    const auto& [feature, point] = feature_and_point[i];
    if (summary.point_inliers[i]) frame.map_points[Index(feature)] = point;
  }
  report.by_motion = CountMatches(frame.map_points) >= config_.min_first_inliers;
  return report.by_motion;
}

bool PointTracking::TrackByReference(Frame& frame, const Map& map) const {
  frame.ForgetPose();
  const Keyframe& reference = map.keyframes[Index(reference_)];
  std::vector<bool> has_point(reference.features.size());
  for (std::size_t f = 0; f < has_point.size(); ++f) {
    has_point[f] = reference.map_points[f] != kNone;
  }
  const auto pairs =
      MatchDescriptors(frame.features, reference.features, has_point, config_.match_reference);
  if (static_cast<int>(pairs.size()) < config_.min_reference_matches) return false;
  for (const FeaturePair& pair : pairs) {
    frame.map_points[Index(pair.first)] = reference.map_points[Index(pair.second)];
  }
  frame.T_cw = LastPose(last_, map);
  frame.prediction.reset();  // the camera may have jumped: points alone say where it is
  return Optimise(frame, map) >= config_.min_first_inliers;
}

bool PointTracking::TrackByRelocalising(Frame& frame, const Map& map,
                                        PointTrackReport& report) {
  report.by_motion = false;
  places_.Update(map);
  const auto found = Relocalise(frame, map, places_, camera_, scale_, search_);
  if (!found) return false;
  frame.T_cw = found->T_cw;
  frame.map_points = found->map_points;
  report.by_relocalising = true;
  return true;
}

/// The frame's matches whose place and descriptor leave no doubt; kNone for all others.
std::vector<int> PointTracking::SureMatches(const Frame& frame, const FeatureGrid& grid,
                                            const Map& map) const {
  const int alike = config_.match_reference.max_distance;
  const double reach_px = kWiderSearch * config_.last_radius_px;
  std::vector<int> sure(frame.map_points.size(), kNone);
  for (std::size_t f = 0; f < sure.size(); ++f) {
    const int id = frame.map_points[f];
    const PointFeature& feature = frame.features[f];
    if (id == kNone || feature.on_edge) continue;
    const int distance =
        DescriptorDistance(feature.descriptor, map.points[Index(id)].descriptor);
    if (distance > alike) continue;
    if (!HasDouble(feature, frame.features, grid, scale_, reach_px, alike)) sure[f] = id;
  }
  return sure;
}

bool PointTracking::TrackLocalMap(Frame& frame, const FeatureGrid& grid, Map& map,
                                  int min_inliers, double radius_factor,
                                  PointTrackReport& report) {
  // Points matched so far; some may have been replaced in the map.
  const LocalMap local = GatherLocalMap(frame, map, config_.max_local_keyframes);
  std::vector<bool> taken(frame.features.size());
  std::vector<int> sighted;  // points that should be in the image
  for (std::size_t f = 0; f < taken.size(); ++f) {
    frame.map_points[f] = CurrentPoint(map, frame.map_points[f]);
    taken[f] = frame.map_points[f] != kNone;
    if (taken[f]) sighted.push_back(frame.map_points[f]);
  }
  std::sort(sighted.begin(), sighted.end());
  const std::vector<int> matched = sighted;

  // Look for the other points of the local map that should be in the image.
  std::vector<PointQuery> queries;
  for (const int id : local.points) {
    if (std::binary_search(matched.begin(), matched.end(), id)) continue;
    const PointQuery query = QueryOf(map.points[Index(id)], frame.T_cw, camera_, scale_,
                                     radius_factor, search_.projection);
    if (query.point == kNone) continue;
    queries.push_back(query);
    sighted.push_back(id);
  }
  const std::vector<int> matches =
      MatchQueries(queries, frame.features, grid, taken, config_.match_local);
  for (std::size_t f = 0; f < matches.size(); ++f) {
    if (matches[f] != kNone) frame.map_points[f] = queries[Index(matches[f])].point;
  }
  report.inliers = Optimise(frame, map);
  if (report.inliers < min_inliers) return false;

  // Where few points tell their place, those that slide along edges or were matched by chance
  // would outvote them.
  std::vector<int> sure = SureMatches(frame, grid, map);
  if (CountMatches(sure) < kManySure) {
    frame.map_points = std::move(sure);
    report.inliers = Optimise(frame, map);
    if (report.inliers < min_inliers) return false;
  }

  // Mapping culls points that are seldom found where they should be.
  for (const int id : sighted) ++map.points[Index(id)].visible_count;
  for (const int id : frame.map_points) {
    if (id != kNone) ++map.points[Index(id)].found_count;
  }
  if (local.reference != kNone) reference_ = local.reference;
  return true;
}

/// Compensates the camera's motion in the features by the speed at the frame's pose.
/// @returns whether that moved any
bool PointTracking::CompensateAtPose(Frame& frame) const {
  const std::optional<Vector6d> speed = SpeedIn(frame);
  return speed && CompensateMotion(camera_, *speed, frame);
}

std::optional<Vector6d> PointTracking::SpeedIn(const Frame& frame) const {
  const std::optional<SpeedByPose> by_pose = SpeedByPoseIn(frame);
  if (!by_pose) return std::nullopt;
  return frame.evidence.speed ? *frame.evidence.speed : by_pose->At(frame.T_cw);
}

int PointTracking::Optimise(Frame& frame, const Map& map) const {
  return OptimiseByPoints(frame, map, camera_, scale_, search_.pose);
}

void PointTracking::FollowMap(const Map& map) {
  if (last_.reference == kNone) return;
  motion_.Correct(LastPose(last_, map));
  motion_filter_.Correct(LastPose(last_, map));
}

std::optional<Pose> PointTracking::FromLast(const Pose& T_cw, const Map& map) const {
  if (last_.reference == kNone) return std::nullopt;
  return LastPose(last_, map) * Inverse(T_cw);
}

bool PointTracking::NeedKeyframe(const Frame& frame, const Map& map) const {
  if (state_ == TrackState::kInitialising || state_ == TrackState::kLost) return false;
  if (map.keyframes.empty()) return true;
  const Keyframe& newest = map.keyframes.back();
  const KeyframeEvidence evidence =
      DecideKeyframe(frame, map, reference_, frame.index - newest.frame_index,
                     scale_.CloseDepth_m(camera_.fx), config_.decision);
  return evidence.wanted || (state_ == TrackState::kHeldByPlanes &&
                             KeepViewOfPlanes(frame, newest, followed_, config_.decision));
}

void PointTracking::Accept(const Frame& frame, const Map& map) {
  Require(state_ != TrackState::kLost, "PointTracking::Accept: the frame was not tracked");
  Require(!map.keyframes.empty(), "PointTracking::Accept: the first frame must be a keyframe");
  const Keyframe& newest = map.keyframes.back();
  Pose T_cw = frame.T_cw;
  if (newest.frame_index == frame.index) {
    reference_ = newest.id;
    T_cw = newest.T_cw;  // as mapping left it
  }
  // The speed is that between two poses of one map: the last pose as the map has it by now.
  FollowMap(map);
  motion_.Observe(frame.timestamp_s, T_cw);
  motion_filter_.Observe(frame.timestamp_s, T_cw, frame.evidence);
  last_ = {frame.features, frame.map_points, reference_,
           T_cw * Inverse(KeyframePose(map, reference_))};
}

}  // namespace slam
