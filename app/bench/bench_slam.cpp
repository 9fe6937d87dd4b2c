#include "app/bench/bench_slam.h"

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>

#include "app/bench/bench_sequences.h"
#include "eval/formats/run/run.h"
#include "slam/input/camera_reader.h"
#include "slam/input/sequence_reader.h"
#include "slam/run/run_sequence.h"

namespace app {
namespace {

bool Covered(int frame, int every, int count) {
  return every > 0 && frame >= every && frame % every < count;
}

/// A sequence whose lens is covered again and again, to see how the camera is found.
class CoveredCamera : public slam::FrameSource {
 public:
  CoveredCamera(slam::FrameSource& frames, const BenchOptions& bench)
      : frames_(frames),
        every_(bench.black_every),
        count_(bench.black_frames),
        blind_(bench.blind_frames) {}
  int size() const override { return frames_.size(); }
  slam::RecordedFrame Read(int i) override {
    slam::RecordedFrame frame = frames_.Read(i);
    if (Covered(i, every_, count_)) {
      frame.bgr = cv::Mat3b(frame.bgr.size(), cv::Vec3b(0, 0, 0));
      frame.gray = cv::Mat1b(frame.gray.size(), 0);
    }
    if (Covered(i, every_, blind_)) frame.depth_m = cv::Mat1f(frame.depth_m.size(), 0.0f);
    return frame;
  }

 private:
  slam::FrameSource& frames_;
  int every_, count_, blind_;
};

/// A sequence played to and fro, the clock going on.
class PendulumCamera : public slam::FrameSource {
 public:
  PendulumCamera(slam::FrameSource& frames, int laps, double fps)
      : frames_(frames), laps_(laps), fps_(fps) {}
  int size() const override { return laps_ * frames_.size(); }
  slam::RecordedFrame Read(int i) override {
    const int lap = i / frames_.size(), at = i % frames_.size();
    slam::RecordedFrame frame = frames_.Read(lap % 2 == 0 ? at : frames_.size() - 1 - at);
    frame.index = i;
    frame.timestamp_s = i / fps_;
    if (lap % 2 != 0) frame.depth_late_s = -frame.depth_late_s;
    return frame;
  }

 private:
  slam::FrameSource& frames_;
  int laps_;
  double fps_;
};

/// A sequence, and then another: the camera was carried elsewhere with the lens covered.
class CarriedCamera : public slam::FrameSource {
 public:
  CarriedCamera(slam::FrameSource& first, slam::FrameSource& then, double fps)
      : first_(first), then_(then), fps_(fps) {}
  int size() const override { return first_.size() + kCovered + then_.size(); }
  slam::RecordedFrame Read(int i) override {
    if (i < first_.size()) return first_.Read(i);
    const int at = i - first_.size() - kCovered;
    slam::RecordedFrame frame = then_.Read(std::max(0, at));
    frame.index = i;
    frame.timestamp_s = first_.Read(first_.size() - 1).timestamp_s + (at + kCovered + 1) / fps_;
    if (at >= 0) return frame;
    frame.bgr = cv::Mat3b(frame.bgr.size(), cv::Vec3b(0, 0, 0));
    frame.gray = cv::Mat1b(frame.gray.size(), 0);
    frame.depth_m = cv::Mat1f(frame.depth_m.size(), 0.0f);
    return frame;
  }

 private:
  static constexpr int kCovered = 2;
  slam::FrameSource &first_, &then_;
  double fps_;
};

slam::RunOutcome RunOn(const slam::RunOptions& options, const BenchOptions& bench) {
  if (bench.black_every == 0 && bench.laps == 1 && bench.then.empty())
    return slam::RunSequence(options);
  const slam::Camera camera = slam::ChooseCamera("", options.sequence).camera;
  slam::SequenceReader reader(options.sequence, camera);
  CoveredCamera covered(reader, bench);
  if (!bench.then.empty()) {
    slam::SequenceReader elsewhere(bench.then, camera);
    CarriedCamera carried(covered, elsewhere, camera.fps);
    return slam::RunLive({carried, camera, nullptr}, options);
  }
  if (bench.laps == 1) return slam::RunLive({covered, camera, nullptr}, options);
  PendulumCamera pendulum(covered, bench.laps, camera.fps);
  return slam::RunLive({pendulum, camera, nullptr}, options);
}

double ResidentKib() {
  std::ifstream statm("/proc/self/statm");
  double whole = 0, resident = 0;
  statm >> whole >> resident;
  return resident * static_cast<double>(::sysconf(_SC_PAGESIZE)) / 1024;
}

constexpr double kSeenAgain_m = 0.15, kSeenAgain_rad = 0.26;  // 15 degrees
bool Near(const eval::Pose& a, const eval::Pose& b) {
  const Eigen::AngleAxisd turn((a.R.transpose() * b.R).eval());
  return (a.t - b.t).norm() < kSeenAgain_m && std::abs(turn.angle()) < kSeenAgain_rad;
}

/// @param estimate, truth  by frame
/// @param covered  whether the lens is covered in a frame: it sees nothing then
std::vector<Comeback> Comebacks(const std::vector<std::optional<eval::Pose>>& estimate,
                                const std::vector<std::optional<eval::Pose>>& truth,
                                const std::optional<eval::Alignment>& gauge,
                                const std::function<bool(int)>& covered) {
  std::vector<Comeback> out;
  std::vector<eval::Pose> seen;
  std::optional<int> lost_since;  // ... seeing the map
  bool lost = false;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (!truth[i]) continue;
    if (!estimate[i]) {
      lost = !seen.empty();
      const bool again = !covered(static_cast<int>(i)) &&
                         std::any_of(seen.begin(), seen.end(), [&](const eval::Pose& pose) {
                           return Near(pose, *truth[i]);
                         });
      if (lost && again && !lost_since) lost_since = static_cast<int>(i);
      continue;
    }
    if (lost) {
      const int waited = lost_since ? static_cast<int>(i) - *lost_since : 0;
      const double error_m = gauge ? ((*gauge * *estimate[i]).t - truth[i]->t).norm() : 0.0;
      out.push_back({waited, error_m});
      lost = false;
      lost_since.reset();
    }
    seen.push_back(*truth[i]);
  }
  if (lost_since) out.push_back({-1, 0.0});
  return out;
}

/// What has drifted: the error of the last pose where the first is laid on the truth; 0 without poses.
double EndError(const std::vector<std::optional<eval::Pose>>& estimate,
                const std::vector<std::optional<eval::Pose>>& truth) {
  std::optional<std::size_t> first, last;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (!truth[i] || !estimate[i]) continue;
    if (!first) first = i;
    last = i;
  }
  if (!first) return 0.0;
  const eval::Pose& e0 = *estimate[*first];
  const eval::Pose& g0 = *truth[*first];
  const Eigen::Vector3d moved = g0.R * (e0.R.transpose() * (estimate[*last]->t - e0.t)) + g0.t;
  return (moved - truth[*last]->t).norm();
}

void Score(const eval::Run& run, const eval::Sequence& sequence, const BenchOptions& bench,
           BenchRow& row) {
  row.score = eval::ScoreTrajectory(run, sequence);
  std::vector<double> stamps_s;
  for (const eval::SequenceFrame& frame : sequence.frames) stamps_s.push_back(frame.stamp_s);
  const auto truth =
      eval::TruePosesOfFrames(*sequence.groundtruth, stamps_s, sequence.synthetic);
  const auto estimate = eval::TruePosesOfFrames(run.trajectory, stamps_s, true);
  row.comebacks = Comebacks(estimate, truth, row.score.gauge, [&](int i) {
    return Covered(i, bench.black_every,
                   bench.blind_frames > 0 ? bench.blind_frames : bench.black_frames);
  });
  row.end_error_m = EndError(estimate, truth);
}

}  // namespace

BenchRow MeasureSlam(const std::string& folder, const BenchOptions& bench) {
  const ScratchFolder scratch("slam");
  const std::filesystem::path& run = scratch.path();
  slam::RunOptions options;
  options.sequence = folder;
  options.run = run;
  options.variant = slam::VariantOf(bench.variant);
  options.config = bench.config;
  options.config.first_look.frames = 0;  // times are of frames that come once
  options.threads = bench.threads;
  options.force = true;
  double half_kib = 0, end_kib = 0;
  int half = 0, frames = 0;
  options.progress = [&](const char*, int done, int total) {
    if (done == (total + 1) / 2) half_kib = ResidentKib(), half = done;
    if (done == total) end_kib = ResidentKib(), frames = total;
  };
  const slam::RunOutcome outcome = RunOn(options, bench);

  BenchRow row;
  row.name = std::filesystem::path(folder).filename().string();
  if (row.name.empty()) row.name = std::filesystem::path(folder).parent_path().filename();
  row.frames = outcome.frames, row.tracked = outcome.tracked;
  row.keyframes = outcome.keyframes, row.points = outcome.map_points;
  row.run_ms = 1e3 * outcome.wall_time_s / std::max(outcome.frames, 1);
  row.kib_a_frame = frames > half ? (end_kib - half_kib) / (frames - half) : 0.0;
  eval::Run result = eval::ReadRun(run);
  const eval::Sequence sequence = eval::ReadSequence(folder);
  if (!bench.then.empty()) {
    // After the sequence every pose is wrong.
    row.elsewhere = static_cast<int>(eval::ReadSequence(bench.then).frames.size());
    row.taken = static_cast<int>(std::erase_if(result.trajectory, [&](const auto& pose) {
      return pose.stamp_s > sequence.frames.back().stamp_s;
    }));
  }
  if (result.timing) row.modules_ms = result.timing->rows_ms;
  if (sequence.groundtruth && bench.laps == 1) Score(result, sequence, bench, row);
  return row;
}

}  // namespace app
