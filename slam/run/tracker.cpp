#include "slam/run/tracker.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "slam/associate/associate_planes.h"
#include "slam/associate/point_plane.h"
#include "slam/associate/recheck.h"
#include "slam/base/index.h"
#include "slam/faces/carry_to_colour.h"
#include "slam/faces/process_planes.h"
#include "slam/features/compensate_motion.h"
#include "slam/features/read_depths.h"
#include "slam/features/weigh_depths.h"
#include "slam/mapping/keyframe_planes.h"
#include "slam/mapping/local_mapping.h"
#include "slam/mapping/plane_face.h"
#include "slam/mapping/plane_fuse.h"
#include "slam/mapping/plane_update.h"
#include "slam/model/map_queries.h"
#include "slam/places/plane_place.h"
#include "slam/pose/held_directions.h"
#include "slam/pose/plane_constraints.h"
#include "slam/pose/pose_error.h"
#include "slam/run/stopwatch.h"
#include "slam/structure/plane_start.h"
#include "slam/structure/structure.h"
#include "slam/tracking/map_covariance.h"

namespace slam {
namespace {

/// The settings of the variant, with the run's seed.
Config ForVariant(Config config, Variant variant, std::uint64_t seed) {
  config.plane_processing.seed += seed;
  if (variant != Variant::kFull) config.association.rule = AssociationRule::kParameters;
  return config;
}

/// Keyframes that may wait for mapping beside tracking: balances how many are dropped against
/// how far the map lags behind.
constexpr std::size_t kMaxWaiting = 3;

}  // namespace

Tracker::Tracker(const Camera& camera, const Config& config, Variant variant,
                 std::unique_ptr<Detector> detector, std::uint64_t seed, int threads,
                 TrackerHooks hooks)
    : camera_(camera),
      config_(ForVariant(config, variant, seed)),
      variant_(variant),
      rays_(PixelRays(camera)),
      extractor_(camera, rays_, config_, variant != Variant::kPoints, std::move(detector),
                 threads),
      straightener_(camera, config_.sensor.noise, config_.depth_warp),
      registration_(camera, config_.sensor.edge_growth_px, config_.depth_registration),
      rolling_(camera, config_.point_features.scale, config_.rolling_shutter),
      points_(camera, config_.point_features.scale, config_.point_search, config_.tracking),
      hooks_(std::move(hooks)) {
  if (!config_.async_mapping) return;
  const MapTurn turn = [this](const std::function<void()>& work) {
    const MappingHold hold(gate_);
    work();
  };
  worker_ = std::make_unique<MappingWorker>(
      [this, turn](int keyframe) { MapKeyframe(keyframe, turn); }, kMaxWaiting);
}

void Tracker::StartFrom(const Tracker& other, std::optional<WarpLearner> bend) {
  // What the look does not know is learnt anew: the run meets the same frames once more.
  if (other.registration_.estimate()) {
    registration_ = other.registration_;
    registration_.Hold();
  }
  if (other.rolling_.estimate()) {
    rolling_ = other.rolling_;
    rolling_.Hold();
  }
  if (other.points_.at_start()) points_.StartAt(*other.points_.at_start());
  if (bend) straightener_.StartFrom(std::move(*bend));
}

void Tracker::Finish(MappingWorker::Waiting waiting) {
  if (worker_) worker_->Finish(waiting);
  for (MapPlane& plane : map_.planes) ForgetDoubtfulCorners(plane, config_.plane_map);
}

/// What depth and colour show is told as one camera sees it, at the time of the colour image.
void Tracker::BringTogether(Frame& frame, TrackReport& report) const {
  frame.speed = points_.Speed(frame.timestamp_s);
  frame.R_dc = registration_.R_dc();
  frame.readout = rolling_.ReadoutAt(frame.speed.mean);
  {
    const Stopwatch watch(report.times[Module::kOrb]);
    ReadDepths(frame.depth_m, camera_, config_.point_features, frame.T_dc(), frame.readout,
               frame.features);
    WeighDepths(config_.sensor, camera_, frame.speed, frame.features);
  }
  if (variant_ == Variant::kPoints) return;
  const Stopwatch watch(report.times[Module::kPp]);
  CarryToColour(camera_, rays_, frame);
}

void Tracker::ProcessFramePlanes(Frame& frame, TrackReport& report) const {
  const Stopwatch watch(report.times[Module::kPp]);
  if (variant_ != Variant::kNoProcessingNoAssociation) {
    ProcessPlanes(frame, camera_, config_.sensor, config_.plane_processing);
  }
  frame.plane_matches.assign(frame.planes.size(), {});
}

bool Tracker::TrackByPoints(Frame& frame, TrackReport& report) {
  const Stopwatch watch(report.times[Module::kDa]);
  if (worker_) {
    worker_->Check();
    points_.FollowMap(map_);
  }
  const Pose T_dc = frame.T_dc();
  report.points = points_.TrackPoints(frame, map_);
  CarryPlanesAgain(T_dc, camera_, frame);  // the pose told the speed
  const double image_px = static_cast<double>(camera_.width) * camera_.height;
  if (report.points.state == TrackState::kInitialising &&
      PlanesCanStart(frame.planes, image_px, config_.structure)) {
    points_.Start(report.points);
  }
  report.tracked = report.points.state == TrackState::kTracking;
  if (report.tracked) frame.T_cw_by_pixels = PoseByPixels(frame, map_, camera_, scale());
  if (report.tracked || report.points.started) return true;
  // Where points fail, planes are asked at the pose that motion predicts, or where they are known
  // from.
  if (variant_ == Variant::kPoints) return false;
  if (!frame.prediction) return FindByPlanes(frame, report);
  frame.T_cw = frame.prediction->T_cw;
  frame.pose_covariance = frame.prediction->covariance;
  return true;
}

/// The camera is lost: planes may know the place.
bool Tracker::FindByPlanes(Frame& frame, TrackReport& report) const {
  if (map_.keyframes.empty()) return false;
  const PlanePlace place = FindPlaceByPlanes(frame, map_, camera_, config_.tracking.plane_place,
                                             config_.point_search);
  report.points.ambiguous = place.ambiguous;
  if (!place.pose) return false;
  frame.T_cw = place.pose->T_cw;
  frame.pose_covariance = place.pose->covariance;
  // The pose problem counts the planes once more.
  frame.prediction = UncertainPose{place.pose->T_cw, place.before};
  report.points.by_relocalising = true;
  return true;
}

void Tracker::AssociateFramePlanes(Frame& frame, TrackReport& report) const {
  const Stopwatch watch(report.times[Module::kDa]);
  PlaneAssociation association = AssociatePlanes(frame, map_, camera_, config_.association);
  frame.plane_matches = std::move(association.matches);
  frame.plane_steps = std::move(association.steps);
  report.refused = association.refused;
  if (hooks_.after_association) hooks_.after_association(frame, map_);
  if (!config_.point_search.pose.use_point_planes) return;
  frame.point_planes =
      AssociatePointsToPlanes(frame, map_, camera_, config_.association.max_point_plane_m);
}

void Tracker::OptimiseWithPlanes(Frame& frame, TrackReport& report) {
  if (report.points.started) return;  // it is the world's frame
  const Stopwatch watch(report.times[Module::kPo]);
  if (!report.tracked) {
    HoldByPlanes(frame, report);
    return;
  }
  const PoseProblem by_planes = ProblemOf(frame, {});
  // The points alone were optimised before.
  if (by_planes.planes.empty() && by_planes.rotations.empty() && by_planes.point_planes.empty())
    return;
  // Once more without the matches that the pose contradicts: the better-known one, or that by points
  // where planes would have it against them.
  OptimiseByAll(frame);
  if (CompensateAtPose(frame)) OptimiseByAll(frame);  // rows, too, were read from elsewhere
  if (TakeBackContradicted(frame, map_, camera_, config_.association) > 0) OptimiseByAll(frame);
}

/// eq13 from all points and planes of the frame, from its pose.
PoseProblem Tracker::ProblemOf(const Frame& frame, const FramePoints& points) const {
  PoseProblem problem;
  problem.T_cw = frame.T_cw;
  problem.points = points.constraints;
  problem.prior = frame.prediction;
  if (const auto speed = points_.SpeedByPoseIn(frame); speed && frame.depth_late_s != 0.0) {
    problem.late = LatePlanes{frame.depth_late_s, frame.speed.mean, *speed};
  }
  AddPlaneConstraints(frame, map_, camera_, config_.plane_constraints, problem);
  AddStructure(frame, map_, config_.structure, problem);
  return problem;
}

/// Changes nothing when the outcome is not usable, or most of the points that agreed on a pose before
/// do not agree with this one: planes on wrong landmarks outweigh them.
void Tracker::OptimiseByAll(Frame& frame) const {
  const FramePoints points = PointConstraints(frame, map_, scale());
  const PoseProblem problem = ProblemOf(frame, points);
  const PoseSummary summary = OptimisePose(problem, camera_, config_.point_search.pose);
  const auto agreed = static_cast<int>(points.constraints.size());
  if (!summary.usable || 2 * summary.inlier_count < agreed) return;
  frame.T_cw = summary.T_cw;
  frame.evidence = summary.evidence;
  frame.pose_covariance = summary.covariance;
  DropOutliers(frame, points, summary.point_inliers);
}

/// Compensates the camera's motion in points and planes by the speed at the frame's pose.
/// @returns whether that moved any
bool Tracker::CompensateAtPose(Frame& frame) const {
  const std::optional<Vector6d> speed = points_.SpeedIn(frame);
  const Pose T_dc = frame.T_dc();
  if (!speed || !CompensateMotion(camera_, *speed, frame)) return false;
  CarryPlanesAgain(T_dc, camera_, frame);
  return true;
}

/// The pose by planes and the motion before, with its covariance. @returns whether planes say anything of it
bool Tracker::PoseByPlanes(Frame& frame) const {
  PoseProblem problem;
  PoseSummary summary;
  bool has_planes = false;
  // Twice: the second time with the motion compensated by the speed that the first pose said.
  for (const bool again : {true, false}) {
    problem = ProblemOf(frame, PointConstraints(frame, map_, scale()));
    has_planes = !problem.planes.empty();
    AddEdgesAlone(frame, map_, config_.structure, problem);
    // Along steps that nothing observes the camera is where motion leads (Zhang, Kaess and Singh
    // 2016), and as uncertain.
    problem.prior =
        HeldAlong(*frame.prediction, UnseenSteps(problem.planes, frame.prediction->T_cw.R));
    summary = OptimisePose(problem, camera_, config_.point_search.pose);
    frame.T_cw = summary.T_cw;
    frame.evidence = summary.evidence;
    if (!summary.usable || !again || !CompensateAtPose(frame)) break;
  }
  const std::vector<Eigen::Vector3d> unseen = UnseenSteps(problem.planes, frame.T_cw.R);
  NormalEquations at, late;
  at.H = frame.evidence.of_pose = WithoutSteps(summary.evidence.of_pose, unseen);
  late.H = frame.evidence.of_late_pose = WithoutSteps(summary.evidence.of_late_pose, unseen);
  if (problem.late) at.H += problem.late->OfPose(late).H;
  const Matrix6d& predicted = frame.prediction->covariance;
  frame.pose_covariance =
      (Matrix6d::Identity() + predicted * at.H).partialPivLu().solve(predicted);
  frame.map_covariance = MapCovarianceByPlanes(frame, map_, problem.planes);
  return has_planes && summary.usable;
}

/// Points failed: planes and the motion before hold the pose, while it is known well enough; once
/// more without the matches that it contradicts.
void Tracker::HoldByPlanes(Frame& frame, TrackReport& report) {
  bool held = PoseByPlanes(frame);
  if (held && TakeBackContradicted(frame, map_, camera_, config_.association) > 0) {
    held = PoseByPlanes(frame);
  }
  // Planes of another place may lie as those of the map do: its prints do not.
  report.tracked = held && IsKnownWell(*frame.pose_covariance, config_.tracking.motion) &&
                   !points_.DeniedByPoints(frame, map_, frame.T_cw);
  if (!report.tracked) {
    frame.ForgetPose();
    return;
  }
  if (report.points.by_relocalising) {
    // No motion led here: the prediction is what the frame's own planes say.
    frame.evidence.of_pose = frame.pose_covariance->inverse();
    points_.FoundByPlanes(frame, map_);
  } else {
    frame.degenerate = HeldByPrediction(frame.prediction->covariance, *frame.pose_covariance);
    points_.HoldByPlanes();
  }
  report.points.state = TrackState::kHeldByPlanes;
}

/// How far off the frame before was, as this one shows, if that was tracked.
FoundPlace Tracker::TellOfTheFrameBefore(const Frame& frame) const {
  if (last_place_.frame_index != frame.index - 1 || !frame.prediction) return {};
  const double dt_s = frame.timestamp_s - last_place_.timestamp_s;
  return FoundOff(Inverse(frame.T_cw).t - Inverse(frame.prediction->T_cw).t,
                  PlaceCovariance(frame.T_cw, CovarianceInWorld(frame)),
                  last_place_.covariance_w,
                  dt_s * dt_s * PlaceCovariance(frame.T_cw, frame.speed.covariance));
}

void Tracker::UpdateMap(Frame& frame, TrackReport& report) {
  // By planes it is known already, and the first frame, which is the world, has none.
  if (frame.pose_covariance && points_.state() != TrackState::kHeldByPlanes)
    frame.map_covariance = MapCovarianceAt(frame.T_cw, map_, points_.reference_keyframe());
  frame.T_lc = points_.FromLast(frame.T_cw, map_);
  {
    const Stopwatch watch(report.times[Module::kUpm]);
    UpdatePlanes(frame, map_, camera_, config_.association, config_.plane_map);
  }
  // What is tied to an older keyframe moves with it, which a frame that closes a gap must not.
  const FoundPlace found = TellOfTheFrameBefore(frame);
  report.keyframe = points_.NeedKeyframe(frame, map_) || ClosesGap(found);
  if (report.keyframe) {
    KeepFrame(frame, found);
    const Stopwatch watch(report.times[Module::kUpm]);
    FusePlanes(map_, config_.association, config_.plane_map);
  }
  last_place_ = {frame.index, frame.timestamp_s,
                 PlaceCovariance(frame.T_cw, CovarianceInWorld(frame))};
  // The pose is tied to a keyframe, which moves on when the map is adjusted.
  points_.Accept(frame, map_);
  report.reference = points_.reference_keyframe();
  report.T_cr = frame.T_cw * Inverse(KeyframePose(map_, report.reference));
  if (!report.keyframe) {
    KeepPlanes(frame, config_.plane_map, config_.structure.supposed,
               map_.keyframes[Index(report.reference)]);
  }
  LearnStructure(frame, report.keyframe ? std::optional(report.reference) : std::nullopt,
                 config_.plane_map.keep_information, config_.structure, map_);
}

/// Makes the frame a keyframe, and maps it now or has it mapped beside tracking.
void Tracker::KeepFrame(Frame& frame, const FoundPlace& found) {
  const int keyframe = InsertKeyframe(frame, map_, camera_, scale(), config_.mapping.keyframes);
  map_.keyframes.back().covariance = CovarianceInWorld(frame);
  map_.keyframes.back().found = found;
  map_.keyframes.back().by_points = points_.state() != TrackState::kHeldByPlanes;
  KeepPlanes(frame, config_.plane_map, config_.structure.supposed,
             map_.keyframes[Index(keyframe)]);
  if (worker_) {
    worker_->Submit(keyframe);
    return;
  }
  MapKeyframe(keyframe, AtOnce);
  frame.T_cw = KeyframePose(map_, keyframe);
}

/// What the depth camera bends, and how far it lies beside colour, for the frames after this one.
void Tracker::LearnSensor(const Frame& frame) {
  straightener_.Learn(frame);
  registration_.Learn(frame);
}

void Tracker::MapKeyframe(int keyframe, const MapTurn& turn) {
  if (hooks_.before_mapping) hooks_.before_mapping(keyframe);
  turn([&] { CloseGaps(map_, keyframe); });
  MapLocally(map_, keyframe, camera_, scale(), config_.mapping, turn);
  if (!config_.loop_closing.enabled) return;
  std::optional<Loop> loop;
  turn([&] {
    loop = DetectLoop(map_, points_.Places(map_), keyframe, camera_, scale(),
                      config_.point_search, config_.loop_closing.detection);
  });
  if (!loop) return;
  CloseLoop(map_, *loop, camera_, scale(), config_.mapping, config_.loop_closing, turn);
  turn([&] { ++loops_; });
}

}  // namespace slam
