#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <optional>

#include "slam/associate/refusals.h"
#include "slam/calibrate/registration_learner.h"
#include "slam/calibrate/rolling_learner.h"
#include "slam/calibrate/straightener.h"
#include "slam/detect/detections.h"
#include "slam/geometry/camera.h"
#include "slam/model/frame.h"
#include "slam/model/map.h"
#include "slam/model/module_times.h"
#include "slam/places/close_gap.h"
#include "slam/places/close_loop.h"
#include "slam/pose/point_constraints.h"
#include "slam/pose/pose_problem.h"
#include "slam/run/config.h"
#include "slam/run/frame_extractor.h"
#include "slam/run/map_gate.h"
#include "slam/run/mapping_worker.h"
#include "slam/tracking/point_tracking.h"

namespace slam {

/// What is left out, as in the paper's ablation.
enum class Variant {
  kFull,
  kNoAssociation,              ///< w/o (D): planes are associated by their parameters alone
  kNoProcessingNoAssociation,  ///< w/o (C)(D): nor are planes re-fitted, labelled or selected
  kPoints                      ///< no planes at all
};

/// What is called while a frame is tracked; each may be empty.
struct TrackerHooks {
  /// Before each keyframe is mapped, where it is mapped.
  std::function<void(int keyframe)> before_mapping;
  /// When a frame's planes were associated. It may change Frame::plane_matches: so tests and
  /// benches see what wrong matches do.
  std::function<void(Frame& frame, const Map& map)> after_association;
};

/// What tracking one frame came to.
struct TrackReport {
  PointTrackReport points;
  ModuleTimes times;
  bool tracked = false;
  bool keyframe = false;  ///< the frame was kept
  int reference = kNone;  ///< keyframe that the pose is tied to, when tracked ...
  Pose T_cr;              ///< ... and the camera as seen from it
  PairRefusals refused;   ///< pairs of frame and map planes, by what refused them
};

/// PAS-SLAM: follows a camera by points and planes and maps both. One frame after the other,
/// from the first.
///
/// Keyframes are mapped (points, bundle adjustment, loops) before the next frame is taken:
/// deterministic for any number of threads. With config.async_mapping they are mapped by a
/// thread of its own instead: tracking waits at most for a piece of that work without any
/// adjustment in it, and no two runs are quite the same.
class Tracker {
 public:
  /// @param detector  may be null: no detections
  /// @param threads   1, or more: points, planes and boxes are then extracted side by side
  /// @throws InputError when config.depth_warp names a file that is no warp of this camera
  Tracker(const Camera& camera, const Config& config, Variant variant,
          std::unique_ptr<Detector> detector, std::uint64_t seed, int threads,
          TrackerHooks hooks = {});

  /// Takes one frame, with index, timestamp, gray and depth set, through the paper's stages (A)
  /// to (F); fills the rest of it, and takes out of the depth what the device bends. An untracked frame has no pose: T_cw is
  /// the identity, nothing is matched, and the map is as before.
  /// @param bgr  for the detector; same size
  /// @throws what mapping beside tracking threw meanwhile
  TrackReport TrackFrame(Frame& frame, const cv::Mat3b& bgr);

  /// The same in two steps: a frame may be extracted, on another thread, while the one before is
  /// tracked. Each takes the frames in order.
  /// @param straightening  HowToStraighten(), from before either
  void Extract(const Straightening& straightening, const cv::Mat3b& bgr, Frame& frame,
               ModuleTimes& times);
  /// @param times  of Extract
  TrackReport Track(Frame& frame, const ModuleTimes& times);
  /// What is known by now of how the device bends depth; see DepthStraightener.
  const Straightening& HowToStraighten() const { return straightener_.straightening(); }

  /// Starts from what another tracker has learnt of the same recording: how far depth lies beside
  /// colour, how long an image is read, and how the camera moved in the frame that the map begins
  /// with. What that one knows of the device is not learnt any further: the map is made with it
  /// throughout. Before the first frame.
  /// @param bend  what was learnt of the bend of depth from the same frames; it is gone on with by
  ///              frames after them. None: it is learnt from the first frame on
  void StartFrom(const Tracker& other, std::optional<WarpLearner> bend = std::nullopt);

  /// Ends mapping beside tracking, after all or none of the keyframes that wait; last call
  /// before the map is looked at. @throws what mapping threw
  void Finish(MappingWorker::Waiting waiting);

  const Map& map() const { return map_; }
  /// Whether depth was straightened, and why or why not.
  const StraighteningReport& straightening() const { return straightener_.report(); }
  const std::optional<RegistrationEstimate>& registration() const {
    return registration_.estimate();
  }
  const std::optional<RollingEstimate>& rolling_shutter() const { return rolling_.estimate(); }
  /// Number of loops closed.
  int loops() const { return loops_; }
  /// Keyframes that mapping beside tracking had no time for.
  int unmapped_keyframes() const { return worker_ ? worker_->dropped() : 0; }

 private:
  const FeatureScale& scale() const { return config_.point_features.scale; }

  // The stages, in order. A frame without planes passes through all of them.
  void BringTogether(Frame& frame, TrackReport& report) const;
  void ProcessFramePlanes(Frame& frame, TrackReport& report) const;
  /// @returns whether there is a pose to go on from, found or predicted
  bool TrackByPoints(Frame& frame, TrackReport& report);
  /// @returns whether planes alone found the lost camera
  bool FindByPlanes(Frame& frame, TrackReport& report) const;
  void AssociateFramePlanes(Frame& frame, TrackReport& report) const;
  void OptimiseWithPlanes(Frame& frame, TrackReport& report);
  bool CompensateAtPose(Frame& frame) const;
  bool PoseByPlanes(Frame& frame) const;
  void HoldByPlanes(Frame& frame, TrackReport& report);
  void OptimiseByAll(Frame& frame) const;
  PoseProblem ProblemOf(const Frame& frame, const FramePoints& points) const;
  FoundPlace TellOfTheFrameBefore(const Frame& frame) const;
  void UpdateMap(Frame& frame, TrackReport& report);
  void KeepFrame(Frame& frame, const FoundPlace& found);
  void MapKeyframe(int keyframe, const MapTurn& turn);
  void LearnSensor(const Frame& frame);
  MapGate* gate() { return worker_ ? &gate_ : nullptr; }

  Camera camera_;
  Config config_;
  Variant variant_;
  cv::Mat2d rays_;  ///< PixelRays(camera_)
  FrameExtractor extractor_;
  DepthStraightener straightener_;
  RegistrationLearner registration_;
  RollingLearner rolling_;
  PointTracking points_;
  Map map_;
  int loops_ = 0;
  struct KnownPlace {
    int frame_index = kNone;
    double timestamp_s = 0.0;
    Eigen::Matrix3d covariance_w = Eigen::Matrix3d::Zero();  ///< of the place in the world
  };
  KnownPlace last_place_;  ///< of the frame that was tracked last

  TrackerHooks hooks_;
  MapGate gate_;                           ///< to map_, points_ and loops_
  std::unique_ptr<MappingWorker> worker_;  ///< last: its thread uses the rest
};

}  // namespace slam
