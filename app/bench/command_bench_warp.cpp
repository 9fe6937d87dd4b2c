#include <fmt/core.h>

#include <cmath>
#include <filesystem>
#include <map>
#include <vector>

#include "app/app.h"
#include "app/bench/unevenness.h"
#include "app/options/surfaces_option.h"
#include "io/folder_kind.h"
#include "io/input_error.h"
#include "sim/sensor/depth/depth_bend.h"
#include "sim/sensor/read_sensor.h"
#include "slam/calibrate/warp_estimate.h"
#include "slam/calibrate/warp_file.h"
#include "slam/input/camera_reader.h"

namespace app {
namespace {

struct WarpBenchArguments {
  std::string sequence, surfaces = "true", warp, device;
  DepthCamera camera;
  double min_area_m2 = 0.15;
  std::uint64_t seed = 1;
  int first = 0, last = 0;
};

/// Blocks before and after a warp was taken out, by their distance.
class BlocksByDistance {
 public:
  /// @param before, after  the same blocks; those count that are on their plane in both
  void Add(const std::vector<BlockResidual>& before, const std::vector<BlockResidual>& after) {
    for (std::size_t i = 0; i < before.size(); ++i) {
      if (!before[i].on_plane || !after[i].on_plane) continue;
      const int bin = static_cast<int>(before[i].depth_m / kBin_m);
      for (Sums* sums : {&bins_[bin], &all_}) {
        const double b = before[i].steps, a = after[i].steps;
        ++sums->blocks;
        sums->before += b * b, sums->after += a * a;
        sums->both += b * (b - a), sums->taken += (b - a) * (b - a);
      }
    }
  }
  void Print() const {
    fmt::print("  {:>10} {:>8} {:>7} {:>7} {:>8} {:>6}\n", "from m", "blocks", "before",
               "after", "change", "best");
    for (const auto& [bin, sums] : bins_) Print(fmt::format("{:.1f}", bin * kBin_m), sums);
    Print("all", all_);
  }

 private:
  static constexpr double kBin_m = 0.4;
  struct Sums {
    int blocks = 0;
    double before = 0, after = 0, both = 0, taken = 0;
  };
  /// `best` is what the warp should be multiplied with to take out most.
  static void Print(const std::string& name, const Sums& sums) {
    const double before = std::sqrt(sums.before / sums.blocks);
    const double after = std::sqrt(sums.after / sums.blocks);
    fmt::print("  {:>10} {:8} {:7.3f} {:7.3f} {:+7.0f}% {:6.2f}\n", name, sums.blocks, before,
               after, 100 * (after / before - 1), sums.both / sums.taken);
  }
  std::map<int, Sums> bins_;
  Sums all_;
};

/// How much of the pattern of a simulated device a warp leaves, as a part of it; both without
/// what is linear in the pixel, which nothing can tell.
double PatternLeft(const slam::DepthWarp& warp, const slam::Camera& camera,
                   const sim::DepthBend& bend, std::uint64_t seed) {
  sim::Camera simulated;
  simulated.width = camera.width, simulated.height = camera.height;
  simulated.fx = camera.fx, simulated.fy = camera.fy;
  simulated.cx = camera.cx, simulated.cy = camera.cy;
  const cv::Mat1f pattern = sim::DevicePattern(bend, simulated, seed);
  const slam::WarpCells& cells = warp.cells;
  Eigen::VectorXd truth(cells.count());
  for (int cell = 0; cell < cells.count(); ++cell) {
    const int row = cell / cells.cols, col = cell % cells.cols;
    const cv::Rect pixels(cells.Left(col), cells.Top(row),
                          cells.Left(col + 1) - cells.Left(col),
                          cells.Top(row + 1) - cells.Top(row));
    truth[cell] = cv::mean(pattern(pixels))[0];
  }
  const Eigen::VectorXd seen = slam::WithoutLinearPart(cells, truth);
  return (warp.pattern - seen).norm() / seen.norm();
}

int RunWarpBench(const WarpBenchArguments& arguments) {
  io::RequireSequence(arguments.sequence);
  const std::string name =
      std::filesystem::path(arguments.sequence).lexically_normal().filename();
  const slam::Camera camera =
      slam::ChooseCamera(arguments.camera.camera, arguments.sequence).camera;
  const slam::DepthWarp warp = slam::ReadWarp(arguments.warp, camera);
  fmt::print("{}: warp of {:.2f} mm/m rms", name, 1e3 * warp.Rms());
  if (!arguments.device.empty()) {
    const sim::Sensor sensor = sim::SensorByName(arguments.device);
    const auto* kinect = std::get_if<sim::KinectModel>(&sensor.depth);
    if (kinect != nullptr && kinect->bend.rms > 0 && warp.law != slam::BendLaw::kDepth) {
      fmt::print(", goes with disparity: no pattern of a simulated device does");
    } else if (kinect != nullptr && kinect->bend.rms > 0) {
      fmt::print(", leaves {:.3f} of the device's pattern",
                 PatternLeft(warp, camera, kinect->bend, arguments.seed));
    }
  }
  const eval::Sequence sequence = eval::ReadSequence(arguments.sequence);
  const eval::DepthViews views = ViewsOf(sequence, {}, arguments.camera);
  const eval::LabelView label =
      LabelsOf(arguments.surfaces, arguments.min_area_m2, sequence, views);
  const slam::Straightening straightening = slam::StraighteningBy(warp);
  const int end =
      arguments.last > 0 ? std::min<int>(arguments.last, int(views.size())) : int(views.size());
  if (arguments.first >= end) {
    throw io::InputError(fmt::format("--from {}", arguments.first),
                         fmt::format("leaves no frame of {} before the end, {}", name, end));
  }
  BlocksByDistance blocks;
  for (int i = arguments.first; i < end; ++i) {
    const eval::DepthView view = views.Read(static_cast<std::size_t>(i));
    const cv::Mat1w labels = label(view);
    blocks.Add(
        BlockResiduals(view.depth_m, labels, views.rays()),
        BlockResiduals(slam::Straightened(view.depth_m, straightening), labels, views.rays()));
  }
  fmt::print("\nframes {} to {}; rms of blocks in steps\n", arguments.first, end);
  blocks.Print();
  return kDone;
}

}  // namespace

void AddBenchWarp(CLI::App& bench, const Globals&, int& exit_code) {
  CLI::App* command = bench.add_subcommand(
      "warp", "How much flatter a warp makes the large surfaces of a recording");
  auto arguments = std::make_shared<WarpBenchArguments>();
  command->add_option("SEQ", arguments->sequence, "Sequence folder with groundtruth.txt")
      ->required();
  command->add_option("--warp", arguments->warp, "File of pas calibrate")->required();
  command
      ->add_option("--surfaces", arguments->surfaces,
                   "File of pas surfaces; true: the true planes of a simulated sequence")
      ->capture_default_str();
  command->add_option("--camera", arguments->camera.camera, "As of pas slam");
  AddRegistrationOption(*command, arguments->camera.registration);
  command
      ->add_option("--device", arguments->device,
                   "Sensor of the simulated sequence: also compare with its true pattern")
      ->type_name("FILE.yaml");
  command->add_option("--seed", arguments->seed, "Of the simulated sequence")
      ->capture_default_str();
  command->add_option("--from", arguments->first, "First frame that counts")
      ->check(CLI::Range(0, 1000000));
  command->add_option("--to", arguments->last, "Frame after the last; 0 = all")
      ->check(CLI::Range(0, 1000000));
  command->callback([arguments, &exit_code] { exit_code = RunWarpBench(*arguments); });
}

}  // namespace app
