#pragma once

#include <memory>
#include <opencv2/core/mat.hpp>
#include <optional>

#include "slam/calibrate/depth_warp.h"
#include "slam/detect/box_tracks.h"
#include "slam/detect/detections.h"
#include "slam/faces/bend_meter.h"
#include "slam/geometry/camera.h"
#include "slam/model/frame.h"
#include "slam/model/module_times.h"
#include "slam/run/config.h"
#include "slam/segment/plane_segments.h"

namespace slam {

/// (B): what each frame of a stream shows by itself, whatever the camera did: points, planes with
/// their edge points, boxes. So the next frame may be extracted while this one is tracked.
class FrameExtractor {
 public:
  /// @param rays      PixelRays(camera)
  /// @param detector  may be null: no detections
  /// @param threads   1, or more: points, planes and boxes are then extracted side by side
  FrameExtractor(const Camera& camera, const cv::Mat2d& rays, const Config& config,
                 bool with_planes, std::unique_ptr<Detector> detector, int threads);

  /// Takes the frames in order, each with timestamp, gray and depth set. Depth is straightened;
  /// features are as they were read, without depth (ReadDepths); planes, labels and depth are as
  /// the depth camera saw them (CarryToColour).
  /// @param bgr  for the detector; same size
  void Extract(const Straightening& straightening, const cv::Mat3b& bgr, Frame& frame,
               ModuleTimes& times);

 private:
  Camera camera_;
  PointFeatureConfig points_;
  int detector_every_;
  std::unique_ptr<Detector> detector_;
  int threads_;
  std::optional<PlaneExtractor> planes_;  ///< none: no planes
  BendMeter bend_meter_;
  BoxTracks box_tracks_;
  int frames_ = 0;  ///< begun: every so many the detector is asked
};

}  // namespace slam
