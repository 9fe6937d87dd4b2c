// The page to read first: one frame through the framework of the paper, (A) to (F). What a
// stage does is said in the folder of its name; how the stages are wired is in tracker.cpp.
#include "slam/run/stopwatch.h"
#include "slam/run/tracker.h"

namespace slam {

TrackReport Tracker::TrackFrame(Frame& frame, const cv::Mat3b& bgr) {
  TrackReport report;
  const Stopwatch whole(report.times[Module::kMt]);

  // (A) is the caller's: slam/input reads the frame.
  ExtractInformation(frame, bgr, report.times);  // (B) points, planes, edges, boxes

  if (uses_planes()) {
    const Stopwatch watch(report.times[Module::kPp]);
    ProcessFramePlanes(frame);  // (C) re-fit, box link, edge lines, vertices, selection
  }

  if (worker_) worker_->Check();
  const TrackingHold hold(gate());  // mapping beside tracking gives the map away in between

  report.tracked = TrackByPoints(frame, report);  // (D) point-point, and a first pose
  if (!report.tracked) return report;

  if (uses_planes()) {
    const Stopwatch watch(report.times[Module::kDa]);
    AssociateFramePlanes(frame);  // (D) box-plane, plane-plane, point-plane
  }
  if (uses_planes()) {
    const Stopwatch watch(report.times[Module::kPo]);
    OptimiseWithPlanes(frame, report);  // (E) all six kinds of factor
  }

  UpdateMap(frame,
            report);  // (F) planes updated and fused; keyframe, points, bundle adjustment
  return report;
}

}  // namespace slam
