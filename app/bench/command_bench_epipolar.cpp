#include <fmt/core.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "app/app.h"
#include "app/bench/epipolar.h"
#include "app/bench/quantile.h"
#include "eval/formats/pose/pose_file.h"
#include "io/folder_kind.h"
#include "io/input_error.h"
#include "slam/input/camera_reader.h"
#include "slam/input/sequence_reader.h"

namespace app {
namespace {

constexpr const char* kAboutBenchEpipolar =
    "How well trajectories agree with the images of a recording, without truth: distances of\n"
    "matched pixels from the epipolar lines on which each trajectory has them, pixels, over\n"
    "the same matches of all. Where a recording's truth is doubtful, this says which of two\n"
    "trajectories is the camera's. Scale and drift over a longer way are not seen.";

struct EpipolarArguments {
  std::string sequence, camera;
  std::vector<std::string> trajectories;
  EpipolarRules rules;
};

int RunEpipolarBench(const EpipolarArguments& arguments) {
  io::RequireRecording(arguments.sequence);
  const slam::CameraFile camera = slam::ChooseCamera(arguments.camera, arguments.sequence);
  slam::SequenceReader frames(arguments.sequence, camera.camera);
  std::vector<eval::Trajectory> trajectories;
  for (const std::string& file : arguments.trajectories)
    trajectories.push_back(eval::ReadPoseFile(file).poses);
  const std::vector<std::vector<double>> distances =
      EpipolarDistances(frames, camera.camera, trajectories, arguments.rules);
  if (distances.front().empty()) {
    throw io::InputError(
        arguments.sequence,
        "no two images that are compared have a pose in every trajectory and a match; are the "
        "stamps those of the images, and does the camera move?");
  }
  std::size_t width = std::string("trajectory").size();
  for (const std::string& file : arguments.trajectories) width = std::max(width, file.size());
  fmt::print("{:<{}} {:>8} {:>8} {:>8}\n", "trajectory", width, "matches", "median", "p75");
  for (std::size_t k = 0; k < distances.size(); ++k) {
    fmt::print("{:<{}} {:8} {:8.3f} {:8.3f}\n", arguments.trajectories[k], width,
               distances[k].size(), QuantileOrZero(distances[k], 0.5),
               QuantileOrZero(distances[k], 0.75));
  }
  return kDone;
}

}  // namespace

void AddBenchEpipolar(CLI::App& bench, const Globals& /*globals*/, int& exit_code) {
  CLI::App* command = bench.add_subcommand("epipolar", kAboutBenchEpipolar);
  const auto arguments = std::make_shared<EpipolarArguments>();
  command->add_option("SEQ", arguments->sequence, "Sequence folder or RECORDING.bag")
      ->required();
  command
      ->add_option("--trajectory", arguments->trajectories,
                   "Files of poses by the stamps of the images: TUM or EuRoC csv")
      ->required();
  command->add_option("--camera", arguments->camera, "As of pas slam");
  command->add_option("--apart", arguments->rules.apart, "Frames between the images of a pair")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  command->add_option("--every", arguments->rules.every, "A pair begins at every Nth frame")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  command->callback([arguments, &exit_code] { exit_code = RunEpipolarBench(*arguments); });
}

}  // namespace app
