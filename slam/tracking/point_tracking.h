#pragma once

#include <vector>

#include "slam/base/field_visitor.h"
#include "slam/model/local_map.h"
#include "slam/model/map.h"
#include "slam/model/map_queries.h"
#include "slam/places/place_guesses.h"
#include "slam/pose/point_constraints.h"
#include "slam/pose/pose_problem.h"
#include "slam/tracking/keyframe_decision.h"
#include "slam/tracking/last_frame.h"
#include "slam/tracking/look_alike.h"
#include "slam/tracking/motion_filter.h"
#include "slam/tracking/motion_model.h"
#include "slam/tracking/points_deny.h"
#include "slam/tracking/relocalise.h"

namespace slam {

/// Whether the camera's place is known.
enum class TrackState {
  kInitialising,  ///< no map yet: waiting for a frame with enough depth
  kTracking,
  kHeldByPlanes,  ///< points failed; planes and the camera's own motion hold the pose
  kLost           ///< the frame has no pose; relocalisation is tried with every frame
};

struct PointTrackReport;

/// "initialising", "tracking", "planes", "relocalised" for the frame that was found again, "lost", or
/// "ambiguous" where the camera is lost because more than one place fits.
const char* StateName(const PointTrackReport& report);

/// Settings of tracking by points.
struct PointTrackingConfig {
  KeyframeDecisionConfig decision;
  LookAlikeConfig look_alike;
  MotionFilterConfig motion;
  PlanePlaceConfig plane_place;
  // Distances and ratios: ORB-SLAM2's.
  PointMatchConfig match_last{100, 0.9};
  PointMatchConfig match_local{100, 0.8};
  PointMatchConfig match_reference{50, 0.7};
  int min_start_points = 100;        // balances a bare start against a late one; ORB-SLAM2: 500
  double last_radius_px = 15.0;      // ORB-SLAM2
  int min_last_matches = 20;         // ORB-SLAM2
  int min_reference_matches = 15;    // ORB-SLAM2
  int min_first_inliers = 10;        // ORB-SLAM2
  int min_inliers = 30;              // ORB-SLAM2
  int min_relocalised_inliers = 50;  // ORB-SLAM2
  int max_temporary_points = 200;    // ORB-SLAM2: 100
  int max_local_keyframes = 20;      // bounds the work a frame; ORB-SLAM2: 80
  double local_radius_factor = 3.0;  // ORB-SLAM2, for cameras with depth
};

inline void VisitFields(PointTrackingConfig& c, FieldVisitor& v) {
  v.Section("motion", "where the camera can be while points fail", c.motion);
  v.Section("plane_place", "finding a lost camera by the planes of its frame", c.plane_place);
  v.Section("match_last", "matching with the last frame, by projection", c.match_last);
  v.Section("match_local", "matching with the local map, by projection", c.match_local);
  v.Section("match_reference", "matching with the reference keyframe, by descriptors",
            c.match_reference);
  v.Integer("min_start_points", c.min_start_points, "[1, 100000]",
            "features with depth that start the map, in an image of 640 x 480");
  v.Number("last_radius_px", c.last_radius_px, "(0, inf)",
           "search radius around the prediction, at octave 0");
  v.Integer("min_last_matches", c.min_last_matches, "[0, 100000]",
            "with fewer matches the search is repeated with twice the radius");
  v.Integer("min_reference_matches", c.min_reference_matches, "[0, 100000]",
            "matches with the reference keyframe, at least");
  v.Integer("min_first_inliers", c.min_first_inliers, "[0, 100000]",
            "inliers after the first optimisation, at least");
  v.Integer("min_inliers", c.min_inliers, "[0, 100000]",
            "inliers after the second optimisation for a pose to be believed");
  v.Integer("min_relocalised_inliers", c.min_relocalised_inliers, "[0, 100000]",
            "the same for a pose that was found without a prediction");
  v.Integer("max_temporary_points", c.max_temporary_points, "[0, 100000]",
            "largest number of points taken from the last frame's depth alone");
  v.Integer("max_local_keyframes", c.max_local_keyframes, "[1, 100000]",
            "largest number of keyframes in the local map");
  v.Number("local_radius_factor", c.local_radius_factor, "(0, inf)",
           "factor on the search radius of the projection");
}

/// What tracking did with a frame.
struct PointTrackReport {
  TrackState state = TrackState::kInitialising;
  bool started = false;          ///< this frame becomes the map's first keyframe
  bool by_motion = false;        ///< found by the motion model
  bool by_relocalising = false;  ///< found without a prediction
  bool ambiguous = false;        ///< not found: its planes fit more than one place
  int followed = 0;              ///< features that agree with the last frame's on one motion
  int inliers = 0;               ///< matches with the map after the last optimisation
};

/// Tracks the camera by points, as ORB-SLAM2 does with RGB-D (Mur-Artal and Tardos 2017):
/// prediction, matching with the last frame, pose; local map, matching, pose.
///
/// For each frame, in this order: TrackPoints; whatever else improves frame.T_cw; if wanted,
/// InsertKeyframe and mapping; Accept.
class PointTracking {
 public:
  /// @param vocabulary  must outlive the tracking
  PointTracking(const Camera& camera, const FeatureScale& scale,
                const PointSearchConfig& search, const PointTrackingConfig& config,
                const Vocabulary& vocabulary = Vocabulary::Shipped());

  /// How the camera moves in the frame that the map begins with; see MotionFilter.
  void StartAt(const StartSpeed& start) { motion_filter_.StartAt(start); }
  const std::optional<StartSpeed>& at_start() const { return motion_filter_.at_start(); }
  /// The camera's speed at the time of a frame that comes, as Frame::speed.
  UncertainSpeed Speed(double timestamp_s) const { return motion_filter_.Speed(timestamp_s); }
  /// The speed in a frame by where it is found to be; none where no motion led to it.
  std::optional<SpeedByPose> SpeedByPoseIn(const Frame& frame) const {
    return frame.prediction ? motion_filter_.SpeedAt(frame.timestamp_s) : std::nullopt;
  }
  /// The same at the frame's pose.
  std::optional<Vector6d> SpeedIn(const Frame& frame) const;

  /// Sets frame.T_cw and frame.map_points (inliers alone). When the state is not kTracking
  /// afterwards, the frame has no pose: T_cw is the identity and nothing is matched; where the
  /// frame before had one, frame.prediction says where motion leads.
  /// Counts sightings in the map's points; changes nothing else of the map.
  PointTrackReport TrackPoints(Frame& frame, Map& map);

  /// The frame has too few points to start a map, but planes can hold the camera from it on: to be
  /// called right after TrackPoints, with its report.
  void Start(PointTrackReport& report);
  /// Planes hold a pose in the frame in which points failed; to be called before NeedKeyframe.
  void HoldByPlanes() { state_ = TrackState::kHeldByPlanes; }
  /// The same where planes found a lost camera: points are looked for there next.
  void FoundByPlanes(const Frame& frame, const Map& map) {
    HoldByPlanes();
    reference_ = NearestKeyframe(map, frame.T_cw);
  }
  /// Whether the prints in sight are not those of the map at this pose; see PointsDeny.
  bool DeniedByPoints(const Frame& frame, const Map& map, const Pose& T_cw) const {
    return PointsDeny(frame, map, T_cw, NearestKeyframe(map, T_cw), camera_, scale_,
                      search_.projection, config_.match_reference);
  }

  /// The map was adjusted since the last frame: the last pose is what it has become. Not
  /// needed when mapping runs between TrackPoints and Accept.
  void FollowMap(const Map& map);

  /// Whether the tracked frame should become a keyframe.
  bool NeedKeyframe(const Frame& frame, const Map& map) const;

  /// From a camera at T_cw to that of the frame accepted last, in the map as it is now; none
  /// before the first.
  std::optional<Pose> FromLast(const Pose& T_cw, const Map& map) const;

  /// Takes over the frame as it is after all optimisation and mapping; last call of each frame.
  /// Frames without a pose must not be given.
  void Accept(const Frame& frame, const Map& map);

  /// The map's keyframes by their words.
  const KeyframeIndex& Places(const Map& map) {
    places_.Update(map);
    return places_;
  }

  TrackState state() const { return state_; }
  /// Keyframe that sees the most of the last frame's points; kNone before the first.
  int reference_keyframe() const { return reference_; }

 private:
  bool PointsCanStart(const Frame& frame) const;
  bool TrackOn(Frame& frame, const FeatureGrid& grid, Map& map, PointTrackReport& report);
  bool FindAgain(Frame& frame, const FeatureGrid& grid, Map& map, PointTrackReport& report);
  void ForgetMotion();
  bool TrackByMotion(Frame& frame, const FeatureGrid& grid, const Map& map,
                     PointTrackReport& report) const;
  bool TrackByReference(Frame& frame, const Map& map) const;
  bool TrackByRelocalising(Frame& frame, const Map& map, PointTrackReport& report);
  bool TrackLocalMap(Frame& frame, const FeatureGrid& grid, Map& map, int min_inliers,
                     double radius_factor, PointTrackReport& report);
  std::vector<int> SureMatches(const Frame& frame, const FeatureGrid& grid,
                               const Map& map) const;
  bool CompensateAtPose(Frame& frame) const;
  int Optimise(Frame& frame, const Map& map) const;

  Camera camera_;
  FeatureScale scale_;
  PointSearchConfig search_;
  PointTrackingConfig config_;
  TrackState state_ = TrackState::kInitialising;
  int followed_ = 0;  ///< see PointTrackReport
  MotionModel motion_;
  MotionFilter motion_filter_;  ///< the same with what is known of it, for when points fail
  LastFrame last_;
  int reference_ = kNone;
  KeyframeIndex places_;  ///< brought up to date when it is asked
};

}  // namespace slam
