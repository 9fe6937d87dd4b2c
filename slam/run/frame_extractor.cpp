#include "slam/run/frame_extractor.h"

#include <future>
#include <utility>
#include <vector>

#include "slam/features/point_features.h"
#include "slam/run/stopwatch.h"

namespace slam {

FrameExtractor::FrameExtractor(const Camera& camera, const cv::Mat2d& rays,
                               const Config& config, bool with_planes,
                               std::unique_ptr<Detector> detector, int threads)
    : camera_(camera),
      points_(config.point_features),
      detector_every_(config.detection.every),
      detector_(detector ? std::move(detector) : std::make_unique<NoDetector>()),
      threads_(threads),
      bend_meter_(rays, config.sensor),
      box_tracks_(config.box_tracks, camera.ImageBox()) {
  if (with_planes) planes_.emplace(rays, config.sensor, config.plane_extraction);
}

void FrameExtractor::Extract(const Straightening& straightening, const cv::Mat3b& bgr,
                             Frame& frame, ModuleTimes& times) {
  frame.measured.depth_m = frame.depth_m;
  frame.depth_m = Straightened(frame.depth_m, straightening);
  frame.detector_asked = frames_++ % detector_every_ == 0;
  // Boxes, planes and points side by side: none writes what another reads.
  const auto detect = [&] {
    const Stopwatch watch(times[Module::kOd]);
    return detector_->Detect(frame.timestamp_s, bgr);
  };
  const auto extract_planes = [&] {
    const Stopwatch watch(times[Module::kEpi]);
    planes_->Extract(frame);
  };
  // Deferred work is done where its outcome is asked for.
  const auto where = threads_ > 1 ? std::launch::async : std::launch::deferred;
  std::future<std::vector<Detection>> boxes;
  std::future<void> planes;
  if (planes_) {
    if (frame.detector_asked) boxes = std::async(where, detect);
    planes = std::async(where, extract_planes);
  }
  {
    const Stopwatch watch(times[Module::kOrb]);
    frame.features = ExtractPointFeatures(frame.gray, camera_, points_);
  }
  frame.map_points.assign(frame.features.size(), kNone);
  if (!planes_) {
    // What is known of the sensor beforehand.
    bend_meter_.Measure(straightening.left_ratio, frame);
    return;
  }
  planes.get();
  const auto found = frame.detector_asked ? boxes.get() : std::vector<Detection>{};
  {
    const Stopwatch watch(times[Module::kMdc]);
    frame.detections = frame.detector_asked ? box_tracks_.Update(frame.timestamp_s, found)
                                            : box_tracks_.Carry(frame.timestamp_s);
  }
  const Stopwatch watch(times[Module::kPp]);
  bend_meter_.Measure(straightening.left_ratio, frame);
  frame.measured.labels = frame.plane_labels;
}

}  // namespace slam
