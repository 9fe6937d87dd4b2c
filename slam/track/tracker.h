#pragma once

#include <cstdint>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <optional>

#include "slam/base/camera.h"
#include "slam/config/config.h"
#include "slam/extract/box_tracks.h"
#include "slam/extract/detections.h"
#include "slam/localise/point_tracking.h"
#include "slam/loop/close_loop.h"
#include "slam/model/frame.h"
#include "slam/model/map.h"
#include "slam/model/module_times.h"

namespace slam {

/// What is left out, as in the paper's ablation.
enum class Variant {
  kFull,
  kNoAssociation,              ///< w/o (D): planes are associated by their parameters alone
  kNoProcessingNoAssociation,  ///< w/o (C)(D): nor are planes re-fitted, labelled or selected
  kPoints                      ///< no planes at all
};

/// What tracking one frame came to.
struct TrackReport {
  PointTrackReport points;
  ModuleTimes times;
  bool tracked = false;
  bool keyframe = false;           ///< the frame was kept
  int reference = kNone;           ///< keyframe that the pose is tied to, when tracked ...
  Pose T_cr;                       ///< ... and the camera as seen from it
  std::optional<LoopReport> loop;  ///< when the frame closed one
  int plane_constraints = 0;       ///< frame planes that constrained the pose
};

/// PAS-SLAM: follows a camera by points and planes and maps both. One frame after the other,
/// from the first; deterministic for any number of threads.
class Tracker {
 public:
  /// @param detector  may be null: no detections
  /// @param threads   1, or more: points, planes and detections are then extracted side by side
  Tracker(const Camera& camera, const Config& config, Variant variant,
          std::unique_ptr<Detector> detector, std::uint64_t seed, int threads);

  /// Takes one frame, with index, timestamp, gray and depth set, through the stages (A) to (F)
  /// of the paper's framework; fills the rest of it. An untracked frame has no pose: T_cw is
  /// the identity, nothing is matched, and the map is as before.
  /// @param bgr  for the detector; same size
  TrackReport TrackFrame(Frame& frame, const cv::Mat3b& bgr);

  const Map& map() const { return map_; }

 private:
  bool uses_planes() const { return variant_ != Variant::kPoints; }

  void ExtractInformation(Frame& frame, const cv::Mat3b& bgr, ModuleTimes& times);
  void ProcessFramePlanes(Frame& frame);
  bool TrackByPoints(Frame& frame, TrackReport& report);
  void AssociateFramePlanes(Frame& frame);
  void OptimiseWithPlanes(Frame& frame, TrackReport& report);
  void UpdateMap(Frame& frame, TrackReport& report);
  void CloseLoopAt(int keyframe, TrackReport& report);

  Camera camera_;
  Config config_;
  Variant variant_;
  std::unique_ptr<Detector> detector_;
  int threads_;

  cv::Mat2d rays_;  ///< of every pixel, planes only
  BoxTracks box_tracks_;
  PointTracking points_;
  Map map_;
};

}  // namespace slam
