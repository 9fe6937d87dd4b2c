#include "app/sim/detector_figures.h"

#include <cstdio>
#include <numeric>

#include "app/app.h"
#include "app/console/console.h"
#include "io/output_file.h"
#include "io/output_folder.h"
#include "sim/detect/detector_score.h"
#include "sim/families/families.h"
#include "sim/motion/trajectory.h"
#include "sim/write/parallel_frames.h"

namespace app {
namespace {

constexpr int kScenes = 3, kFrames = 300;

struct Preset {
  const char* name;
  sim::DetectorKind kind;
  sim::DetectorScore score;
};

std::vector<sim::FrameTruth> TruthOf(const sim::Scene& scene, const sim::Camera& camera,
                                     std::uint64_t seed) {
  const auto trajectory = sim::MakeTrajectory(scene, kFrames, camera.fps, seed);
  const sim::FrameRenderer renderer(scene, camera);
  const sim::TruthMaker maker(renderer);
  std::vector<sim::FrameTruth> truth(trajectory.size());
  std::vector<int> frames(trajectory.size());
  std::iota(frames.begin(), frames.end(), 0);
  sim::RenderOptions view;
  view.colour = false;
  sim::ForEachFrame(frames, 0,
                    [&](int frame) {
                      const auto i = static_cast<std::size_t>(frame);
                      const sim::Pose& T_wc = trajectory[i].T_wc;
                      truth[i] = maker.Describe(renderer.Render(T_wc, view), T_wc);
                    },
                    {});
  return truth;
}

}  // namespace

int ReportDetectors(const std::filesystem::path& output, bool force, bool quiet) {
  io::MakeFolder(output);
  const io::OutputFile file(output / "detectors.txt", {.force = force});
  std::vector<Preset> presets{{"perfect", sim::DetectorKind::kPerfect, {}},
                              {"noisy", sim::DetectorKind::kNoisy, {}},
                              {"poor", sim::DetectorKind::kPoor, {}}};
  const sim::Camera camera;
  Progress progress("scenes", kScenes, quiet);
  for (std::uint64_t seed = 1; seed <= kScenes; ++seed) {
    const sim::Scene scene = sim::MakeScene("desk", seed);
    const std::vector<sim::FrameTruth> truth = TruthOf(scene, camera, seed);
    const sim::Detector all(scene, camera, sim::DetectorKind::kPerfect, seed);
    for (Preset& preset : presets) {
      const sim::Detector detector(scene, camera, preset.kind, seed);
      preset.score.NextRecording();
      for (std::size_t i = 0; i < truth.size(); ++i) {
        preset.score.Add(all.VisibleTargets(truth[i]),
                         detector.Detect(static_cast<int>(i), truth[i]));
      }
    }
    progress.Update(static_cast<int>(seed));
  }
  std::string text;
  for (const Preset& preset : presets) {
    text += std::string(preset.name) + "\n" + sim::ScoreTable(preset.score);
  }
  file.Write(text);
  if (!quiet) std::printf("%s", text.c_str());
  return kDone;
}

}  // namespace app
