#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <opencv2/core/utility.hpp>

#include "app/app.h"
#include "eval/read/run.h"
#include "eval/trajectory/score_trajectory.h"
#include "slam/config/config_file.h"
#include "slam/input/camera_reader.h"
#include "slam/input/sequence_reader.h"
#include "slam/track/run_sequence.h"

namespace app {
namespace {

constexpr const char* kAbout =
    "Accuracy, time and memory of pas slam on sequences with truth: frames tracked, ATE, time\n"
    "of each module, whether time and memory stay flat, and how soon a lost camera is found.";

struct Arguments {
  std::vector<std::string> sequences;
  std::string variant = "points", config_file;
  int threads = 1;
  bool loop_closing = false;
  int black_every = 0, black_frames = 12;
};

bool Covered(int frame, int every, int count) {
  return every > 0 && frame >= every && frame % every < count;
}

/// A sequence whose lens is covered again and again, to see how the camera is found.
class CoveredCamera : public slam::FrameSource {
 public:
  CoveredCamera(slam::FrameSource& frames, int every, int count)
      : frames_(frames), every_(every), count_(count) {}
  int size() const override { return frames_.size(); }
  slam::RecordedFrame Read(int i) override {
    slam::RecordedFrame frame = frames_.Read(i);
    if (Covered(i, every_, count_)) {
      frame.bgr = cv::Mat3b(frame.bgr.size(), cv::Vec3b(0, 0, 0));
      frame.gray = cv::Mat1b(frame.gray.size(), 0);
    }
    return frame;
  }

 private:
  slam::FrameSource& frames_;
  int every_, count_;
};

slam::RunOutcome RunOn(const slam::RunOptions& options, const Arguments& arguments) {
  if (arguments.black_every == 0) return slam::RunSequence(options);
  const slam::Camera camera = slam::ChooseCamera("", options.sequence);
  slam::SequenceReader reader(options.sequence, camera);
  CoveredCamera covered(reader, arguments.black_every, arguments.black_frames);
  return slam::RunLive({covered, camera, nullptr}, options);
}

double ResidentKib() {
  std::ifstream statm("/proc/self/statm");
  double whole = 0, resident = 0;
  statm >> whole >> resident;
  return resident * static_cast<double>(::sysconf(_SC_PAGESIZE)) / 1024;
}

double MeanOf(const std::vector<double>& values) {
  return values.empty() ? 0.0
                        : std::accumulate(values.begin(), values.end(), 0.0) /
                              static_cast<double>(values.size());
}

double Quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

/// A time without pose, from when the camera sees again what it saw while it was tracked.
struct Comeback {
  int waited = 0;      ///< frames until it was found; -1: never
  double error_m = 0;  ///< of the first pose, the run laid on the truth
};

constexpr double kSeenAgain_m = 0.15, kSeenAgain_rad = 0.26;  // 15 degrees
constexpr double kWrong_m = 0.05;

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

/// What one sequence came to.
struct Row {
  std::string name;
  eval::TrajectoryScore score;
  int keyframes = 0;
  double end_error_m = 0;  ///< of the last pose, the first ones laid on the truth
  std::vector<std::vector<double>> modules_ms;
  double kib_a_frame = 0;  ///< resident memory, over the second half
  std::vector<Comeback> comebacks;
};

std::vector<std::optional<eval::Pose>> ByFrame(const eval::Trajectory& trajectory,
                                               const std::vector<double>& stamps_s) {
  return eval::TruePosesOfFrames(trajectory, stamps_s, true);
}

Row Measure(const std::string& folder, const Arguments& arguments, const slam::Config& config) {
  const auto run =
      std::filesystem::temp_directory_path() / ("pas_bench_slam_" + std::to_string(::getpid()));
  slam::RunOptions options;
  options.sequence = folder;
  options.run = run;
  options.variant = slam::VariantOf(arguments.variant);
  options.config = config;
  options.threads = arguments.threads;
  options.force = true;
  double half_kib = 0, end_kib = 0;
  int half = 0, frames = 0;
  options.progress = [&](int done, int total) {
    if (done == (total + 1) / 2) half_kib = ResidentKib(), half = done;
    if (done == total) end_kib = ResidentKib(), frames = total;
  };
  const slam::RunOutcome outcome = RunOn(options, arguments);

  Row row;
  row.name = std::filesystem::path(folder).filename().string();
  if (row.name.empty()) row.name = std::filesystem::path(folder).parent_path().filename();
  row.keyframes = outcome.keyframes;
  row.kib_a_frame = frames > half ? (end_kib - half_kib) / (frames - half) : 0.0;
  const eval::Run result = eval::ReadRun(run);
  const eval::Sequence sequence = eval::ReadSequence(folder);
  if (result.timing) row.modules_ms = result.timing->rows_ms;
  if (sequence.groundtruth) {
    row.score = eval::ScoreTrajectory(result, sequence);
    std::vector<double> stamps_s;
    for (const eval::SequenceFrame& frame : sequence.frames) stamps_s.push_back(frame.stamp_s);
    const auto truth =
        eval::TruePosesOfFrames(*sequence.groundtruth, stamps_s, sequence.synthetic);
    const auto estimate = ByFrame(result.trajectory, stamps_s);
    row.comebacks = Comebacks(estimate, truth, row.score.gauge, [&](int i) {
      return Covered(i, arguments.black_every, arguments.black_frames);
    });
    std::optional<std::size_t> first, last;
    for (std::size_t i = 0; i < truth.size(); ++i) {
      if (!truth[i] || !estimate[i]) continue;
      if (!first) first = i;
      last = i;
    }
    if (first) {
      // Laid on the truth at the first pose: what has drifted since.
      const eval::Pose& e0 = *estimate[*first];
      const eval::Pose& g0 = *truth[*first];
      const Eigen::Vector3d moved =
          g0.R * (e0.R.transpose() * (estimate[*last]->t - e0.t)) + g0.t;
      row.end_error_m = (moved - truth[*last]->t).norm();
    }
  }
  std::filesystem::remove_all(run);
  return row;
}

std::vector<double> Column(const Row& row, std::size_t module) {
  std::vector<double> values;
  for (const auto& frame : row.modules_ms) values.push_back(frame[module]);
  return values;
}

void Print(const Row& row) {
  constexpr std::size_t kWhole = slam::kModuleCount - 1;
  const std::vector<double> ms = Column(row, kWhole);
  const std::size_t third = ms.size() / 3;
  const std::vector<double> middle(ms.begin() + static_cast<long>(third),
                                   ms.begin() + static_cast<long>(2 * third)),
      last(ms.begin() + static_cast<long>(2 * third), ms.end());
  fmt::print("{:<20} {:>6} {:>7} {:>4} {:>8} {:>8} {:>5} {:>7.2f} {:>7.2f} {:>6.2f} {:>8.2f}\n",
             row.name, row.score.frames, row.score.tracked, row.score.lost_events,
             row.score.ate_se3 ? fmt::format("{:.2f}", 1e3 * row.score.ate_se3->rmse) : "-",
             fmt::format("{:.2f}", 1e3 * row.end_error_m), row.keyframes, MeanOf(ms),
             Quantile(ms, 0.99), MeanOf(middle) > 0 ? MeanOf(last) / MeanOf(middle) : 0.0,
             row.kib_a_frame);
}

void PrintModules(const std::vector<Row>& rows) {
  fmt::print("\nmodule, ms a frame    mean  median     p99\n");
  for (std::size_t m = 0; m < slam::kModuleCount; ++m) {
    std::vector<double> all;
    for (const Row& row : rows) {
      const std::vector<double> some = Column(row, m);
      all.insert(all.end(), some.begin(), some.end());
    }
    fmt::print("{:<18} {:>7.2f} {:>7.2f} {:>7.2f}\n", slam::kModuleNames[m], MeanOf(all),
               Quantile(all, 0.5), Quantile(all, 0.99));
  }
}

void PrintComebacks(const std::vector<Row>& rows) {
  int all = 0, soon = 0, wrong = 0;
  for (const Row& row : rows) {
    for (const Comeback& comeback : row.comebacks) {
      ++all;
      soon += comeback.waited >= 0 && comeback.waited <= 10;
      wrong += comeback.error_m > kWrong_m;
    }
  }
  fmt::print(
      "\nlost {} times; found within 10 frames of seeing the map again: {}; "
      "wrong by more than {:.0f} cm: {}\n",
      all, soon, 100 * kWrong_m, wrong);
}

int Run(const Arguments& arguments) {
  slam::Config config;
  if (!arguments.config_file.empty()) config = slam::ReadConfig(arguments.config_file);
  config.loop_closing.enabled = config.loop_closing.enabled || arguments.loop_closing;
  fmt::print("{:<20} {:>6} {:>7} {:>4} {:>8} {:>8} {:>5} {:>7} {:>7} {:>6} {:>8}\n", "sequence",
             "frames", "tracked", "lost", "ate mm", "end mm", "kf", "ms", "p99 ms", "late",
             "KiB/fr");
  std::vector<Row> rows;
  for (const std::string& sequence : arguments.sequences) {
    rows.push_back(Measure(sequence, arguments, config));
    Print(rows.back());
    std::fflush(stdout);
  }
  std::vector<double> ate_mm;
  for (const Row& row : rows) {
    if (row.score.ate_se3) ate_mm.push_back(1e3 * row.score.ate_se3->rmse);
  }
  if (!ate_mm.empty()) {
    fmt::print("ATE rmse: median {:.2f} mm, worst {:.2f} mm\n", Quantile(ate_mm, 0.5),
               Quantile(ate_mm, 1.0));
  }
  PrintModules(rows);
  PrintComebacks(rows);
  fmt::print(
      "late: mean time of the last third over that of the middle third; end: error of "
      "the last pose\nwhen the first is laid on the truth; KiB/fr: growth of memory over "
      "the second half\n");
  return kDone;
}

}  // namespace

void AddBenchSlam(CLI::App& bench, const Globals& /*globals*/, int& exit_code) {
  CLI::App* command = bench.add_subcommand("slam", kAbout);
  const auto arguments = std::make_shared<Arguments>();
  command->add_option("SEQ", arguments->sequences, "Sequences to run on")->required();
  command->add_option("--variant", arguments->variant, "As of pas slam")->capture_default_str();
  command->add_option("--config", arguments->config_file, "As of pas slam");
  command->add_option("--threads", arguments->threads, "Of tracking; 0: one a core")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  command
      ->add_option("--black-every", arguments->black_every,
                   "Cover the lens every so many frames, to see how the camera is found again; "
                   "detections are not replayed then")
      ->check(CLI::Range(2, 1000000));
  command->add_option("--black-frames", arguments->black_frames, "For so many frames")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  command->add_flag("--loop-closing", arguments->loop_closing, "As of pas slam");
  command->callback([arguments, &exit_code] { exit_code = Run(*arguments); });
}

}  // namespace app
