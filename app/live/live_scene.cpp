#include "app/live/live_scene.h"

#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <utility>

#include "io/json_field.h"
#include "sim/write/sequence_text.h"
#include "slam/input/image_file.h"

namespace app {
namespace {

/// Says what the simulated detector said of the frame that was read last.
class LiveDetector : public slam::Detector {
 public:
  LiveDetector(const std::string& line, slam::Camera camera, slam::ClassTable classes)
      : line_(line), camera_(camera), classes_(std::move(classes)) {}

  std::vector<slam::Detection> Detect(double timestamp_s, const cv::Mat3b&) override {
    const nlohmann::json json = io::ParseJson(line_, "simulated detections");
    slam::DetectionRecord record =
        slam::ReadDetections(io::JsonField(json, "simulated detections"), camera_, classes_);
    if (record.timestamp_s != timestamp_s) {
      throw std::logic_error("LiveDetector: asked for another frame than was read");
    }
    return std::move(record.detections);
  }

 private:
  const std::string& line_;
  slam::Camera camera_;
  slam::ClassTable classes_;
};

}  // namespace

LiveScene::LiveScene(const sim::Scene& scene, const sim::RigOptions& rig,
                     sim::Recording recording, int ahead)
    : simulator_(scene, rig), recording_(std::move(recording)), ahead_count_(ahead) {}

LiveScene::Made LiveScene::Make(int i) const {
  sim::SimulatedFrame simulated = sim::Record(simulator_, recording_, i);
  Made made;
  made.frame.index = i;
  const sim::Shot& shot = recording_.shots[static_cast<std::size_t>(i)];
  made.frame.timestamp_s = sim::PrintedTime(shot.colour_stamp_s);
  made.frame.depth_late_s = sim::PrintedTime(shot.depth_stamp_s) - made.frame.timestamp_s;
  made.frame.bgr = std::move(simulated.colour);
  cv::cvtColor(made.frame.bgr, made.frame.gray, cv::COLOR_BGR2GRAY);
  made.frame.depth_m =
      slam::DepthInMetres(simulated.depth, simulator_.options().camera.depth_factor);
  made.detections = sim::DetectionsJson(made.frame.timestamp_s, simulated.detections);
  if (truth_) made.truth = EncodeTruth(made.frame.timestamp_s, simulated);
  return made;
}

slam::LiveTruth& LiveScene::KeepTruth(const sim::Scene& scene,
                                      const sim::SequenceOptions& options) {
  if (next_ > 0) throw std::logic_error("LiveScene::KeepTruth: frames were read already");
  truth_ = std::make_unique<TruthFolder>(scene, simulator_.planes(), recording_, options);
  return *truth_;
}

slam::RecordedFrame LiveScene::Read(int i) {
  if (i != next_ - static_cast<int>(ahead_.size())) {
    throw std::logic_error("LiveScene::Read: frames come once each, in order");
  }
  while (next_ < size() && next_ <= i + ahead_count_) {
    ahead_.push_back(std::async(ahead_count_ > 0 ? std::launch::async : std::launch::deferred,
                                [this, frame = next_] { return Make(frame); }));
    ++next_;
  }
  Made made = ahead_.front().get();
  ahead_.pop_front();
  detections_ = std::move(made.detections);
  if (truth_) truth_->Add(made.truth, detections_);
  return std::move(made.frame);
}

slam::Camera LiveScene::camera() const {
  const sim::Camera from = simulator_.options().CameraAsTold();
  slam::Camera camera;
  camera.width = from.width, camera.height = from.height;
  camera.fx = from.fx, camera.fy = from.fy, camera.cx = from.cx, camera.cy = from.cy;
  const sim::Lens& lens = from.lens;
  camera.k1 = lens.k1, camera.k2 = lens.k2, camera.k3 = lens.k3;
  camera.p1 = lens.p1, camera.p2 = lens.p2;
  camera.fps = from.fps, camera.depth_factor = from.depth_factor;
  return camera;
}

std::unique_ptr<slam::Detector> LiveScene::MakeDetector(const slam::ClassTable& classes) const {
  if (simulator_.options().detector == sim::DetectorKind::kNone) return nullptr;
  return std::make_unique<LiveDetector>(detections_, camera(), classes);
}

}  // namespace app
