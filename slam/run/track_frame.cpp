// The page to read first: one frame through the framework of the paper, (A) to (F), once. What
// a stage does is said in the folder of its name; how the stages are wired is in tracker.cpp.
#include "slam/run/stopwatch.h"
#include "slam/run/tracker.h"

namespace slam {

TrackReport Tracker::TrackFrame(Frame& frame, const cv::Mat3b& bgr) {
  ModuleTimes times;
  Extract(HowToStraighten(), bgr, frame, times);
  return Track(frame, times);
}

// What a frame shows by itself. (A) is the caller's: slam/input reads the frame.
void Tracker::Extract(const Straightening& straightening, const cv::Mat3b& bgr, Frame& frame,
                      ModuleTimes& times) {
  const Stopwatch whole(times[Module::kMt]);
  // (B) points, planes, edge points, boxes
  extractor_.Extract(straightening, bgr, frame, times);
}

// What it says of the camera and of the map.
TrackReport Tracker::Track(Frame& frame, const ModuleTimes& times) {
  TrackReport report;
  report.times = times;
  const Stopwatch whole(report.times[Module::kMt]);

  straightener_.See(frame);
  BringTogether(frame, report);            // (B) depth is told where colour was taken
  ProcessFramePlanes(frame, report);       // (C) re-fit, box link, lines, vertices, selection
  const TrackingHold map_is_ours(gate());  // mapping beside tracking gives it away in between
  if (!TrackByPoints(frame, report)) return report;  // (D) point to point, and a first pose
  AssociateFramePlanes(frame, report);  // (D) plane to plane with boxes, point to plane
  OptimiseWithPlanes(frame, report);    // (E) each factor that is on, and structure
  if (!report.tracked) return report;
  // A pose that planes hold says nothing of the sensor that saw them.
  const bool by_points = report.points.state == TrackState::kTracking;
  if (by_points) rolling_.Learn(frame, map_);
  UpdateMap(frame, report);  // (F) planes; keyframe, points, bundle adjustment
  if (by_points) LearnSensor(frame);
  return report;
}

}  // namespace slam
