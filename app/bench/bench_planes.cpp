#include "app/bench/bench_planes.h"

#include <algorithm>
#include <ctime>
#include <memory>
#include <optional>

#include "app/bench/bench_planes_score.h"
#include "app/options/surfaces_option.h"
#include "eval/formats/sequence/sequence.h"
#include "eval/planes/united_faces.h"
#include "eval/surfaces/label_surfaces.h"
#include "eval/trajectory/score_trajectory.h"
#include "io/folder_kind.h"
#include "slam/detect/box_tracks.h"
#include "slam/detect/detections.h"
#include "slam/faces/process_planes.h"
#include "slam/input/camera_reader.h"
#include "slam/input/sequence_reader.h"
#include "slam/segment/plane_segments.h"

namespace app {
namespace {

/// Processor time of this thread: other programs on the machine do not count.
double ThreadTime_ms() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

template <typename Work>
double TimeOf(const Work& work) {
  const double start = ThreadTime_ms();
  work();
  return ThreadTime_ms() - start;
}

/// The yardstick: reads the depth image once and writes the points.
void BackProject(const cv::Mat1f& depth_m, const slam::Camera& camera, cv::Mat3f& points_c) {
  points_c.create(depth_m.size());
  const auto fx = static_cast<float>(1.0 / camera.fx), fy = static_cast<float>(1.0 / camera.fy);
  const auto cx = static_cast<float>(camera.cx), cy = static_cast<float>(camera.cy);
  for (int v = 0; v < depth_m.rows; ++v) {
    const float* z = depth_m[v];
    cv::Vec3f* point = points_c[v];
    const float y = (static_cast<float>(v) - cy) * fy;
    for (int u = 0; u < depth_m.cols; ++u) {
      const float x = (static_cast<float>(u) - cx) * fx;
      point[u] = {x * z[u], y * z[u], z[u]};
    }
  }
}

slam::Frame FrameOf(const slam::RecordedFrame& recorded) {
  slam::Frame frame;
  frame.index = recorded.index;
  frame.timestamp_s = recorded.timestamp_s;
  frame.gray = recorded.gray;
  frame.depth_m = recorded.depth_m;
  return frame;
}

std::unique_ptr<slam::Detector> DetectorOf(const std::filesystem::path& sequence,
                                           const slam::Camera& camera,
                                           const slam::Config& config) {
  const bool replay = std::filesystem::exists(sequence / "detections.jsonl");
  return slam::MakeDetector(replay ? "replay" : "none", sequence, camera, config.classes);
}

/// Runs (B) for planes and (C) as the tracker does.
class PlaneFrontEnd {
 public:
  PlaneFrontEnd(const std::filesystem::path& sequence, const slam::Camera& camera,
                const slam::Config& config)
      : camera_(camera),
        config_(config),
        extractor_(slam::PixelRays(camera), config.sensor, config.plane_extraction),
        boxes_(config.box_tracks, camera.ImageBox()),
        detector_(DetectorOf(sequence, camera, config)) {}

  slam::Frame Run(const slam::RecordedFrame& recorded, PlaneTimes& times) {
    slam::Frame frame = FrameOf(recorded);
    frame.detections =
        boxes_.Update(frame.timestamp_s, detector_->Detect(frame.timestamp_s, recorded.bgr));
    times.plain_pass_ms.push_back(
        TimeOf([&] { BackProject(frame.depth_m, camera_, points_c_); }));
    times.extraction_ms.push_back(TimeOf([&] { extractor_.Extract(frame); }));
    times.processing_ms.push_back(TimeOf([&] {
      slam::ProcessPlanes(frame, camera_, config_.sensor, config_.plane_processing);
    }));
    return frame;
  }

 private:
  slam::Camera camera_;
  slam::Config config_;
  slam::PlaneExtractor extractor_;
  slam::BoxTracks boxes_;
  std::unique_ptr<slam::Detector> detector_;
  cv::Mat3f points_c_;
};

/// Scores segments on the large surfaces of a recording (docs/surfaces.md).
class SurfaceBench {
 public:
  SurfaceBench(const std::string& file, const eval::Sequence& truth,
               const std::string& camera_choice)
      : views_(ViewsOf(truth, eval::Run{}, DepthCamera{camera_choice, ""})),
        labeller_(eval::ReadSurfaces(file)) {
    for (std::size_t k = 0; k < views_.size(); ++k) stamps_s_.push_back(views_.StampOf(k));
  }
  void Add(const slam::Frame& frame) {
    const auto view = eval::FindStamp(stamps_s_, frame.timestamp_s);
    if (!view) return;
    cv::Mat1w segments;
    frame.plane_labels.convertTo(segments, CV_16U);
    scorer_.Add(*view, labeller_.Label(views_.Read(*view), views_.rays()), segments, {});
  }
  eval::SurfaceFigures Figures() const { return scorer_.Score().total; }

 private:
  eval::DepthViews views_;
  eval::SurfaceLabeller labeller_;
  eval::SurfaceScorer scorer_;
  std::vector<double> stamps_s_;
};

template <typename T>
void Append(const std::vector<T>& from, std::vector<T>& to) {
  to.insert(to.end(), from.begin(), from.end());
}

}  // namespace

void PlaneBench::Add(const PlaneBench& o) {
  frames += o.frames, scored_frames += o.scored_frames, segments += o.segments;
  Append(o.times.extraction_ms, times.extraction_ms);
  Append(o.times.processing_ms, times.processing_ms);
  Append(o.times.plain_pass_ms, times.plain_pass_ms);
  hoover += o.hoover, panoptic += o.panoptic;
  Append(o.normal_deg, normal_deg);
  Append(o.offset_mm, offset_mm);
  corners += o.corners;
  thin_tops.found += o.thin_tops.found, thin_tops.all += o.thin_tops.all;
  for (const auto& [bin, share] : o.steps) {
    steps[bin].found += share.found, steps[bin].all += share.all;
  }
  Append(o.level_normals_w, level_normals_w);
  Append(o.level_shares, level_shares);
}

PlaneBench BenchPlanes(const std::filesystem::path& sequence, const std::string& camera_choice,
                       const slam::Config& config, const BenchChoice& choice) {
  io::RequireSequence(sequence);
  const slam::Camera camera = slam::ChooseCamera(camera_choice, sequence).camera;
  const eval::Sequence truth = eval::WithUnitedFaces(eval::ReadSequence(sequence));
  slam::SequenceReader reader(sequence, camera);
  PlaneFrontEnd front_end(sequence, camera, config);
  const int count =
      choice.at_most > 0 ? std::min(choice.at_most, reader.size()) : reader.size();
  std::vector<double> stamps_s;
  for (int i = 0; i < count; ++i) {
    const slam::SequenceEntry& entry = reader.entry(i);
    // A recording's depth was measured beside its colour; the simulator's truth is the frame's.
    stamps_s.push_back(truth.scene ? entry.timestamp_s
                                   : entry.depth_timestamp_s - 1e-3 * choice.depth_delay_ms);
  }
  std::vector<std::optional<eval::Pose>> poses(stamps_s.size());
  if (truth.groundtruth) {
    poses = eval::TruePosesOfFrames(*truth.groundtruth, stamps_s, truth.synthetic);
  }
  std::optional<SurfaceBench> surfaces;
  if (!choice.surfaces.empty()) surfaces.emplace(choice.surfaces, truth, camera_choice);
  PlaneBench bench;
  for (int i = 0; i < count; i += choice.every) {
    const slam::RecordedFrame recorded = reader.Read(i);
    const slam::Frame frame = front_end.Run(recorded, bench.times);
    ++bench.frames;
    bench.segments += static_cast<int>(frame.planes.size());
    if (surfaces) surfaces->Add(frame);
    const std::optional<eval::Pose>& pose = poses[static_cast<std::size_t>(i)];
    if (!pose) continue;
    if (truth.scene && !truth.plane_id_files.empty()) {
      eval::TrueFrame seen = eval::ReadTrueFrame(truth, frame.timestamp_s, *pose);
      if (!choice.unmeasured) LeaveOutUnmeasured(frame.depth_m, camera, seen);
      ScoreFrame(frame, seen, *truth.scene, bench);
    } else {
      AddLevelPlane(frame, *pose, bench);
    }
  }
  if (surfaces) bench.surfaces = surfaces->Figures();
  return bench;
}

}  // namespace app
