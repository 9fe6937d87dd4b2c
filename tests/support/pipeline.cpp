#include "tests/support/pipeline.h"

#include <sstream>

#include "eval/formats/run/run.h"
#include "eval/formats/sequence/sequence.h"
#include "eval/report/evaluate.h"
#include "eval/report/metrics_json.h"
#include "sim/scene/write_scene.h"

namespace pipeline {
namespace fs = std::filesystem;

void Record(const sim::Scene& scene, const Recording& recording, const fs::path& folder) {
  sim::SequenceOptions options;
  options.rig.sensor = recording.sensor;
  options.rig.camera = sim::WithLens(
      sim::Resize(sim::Camera{}, recording.width, recording.height), options.rig.sensor.lens);
  options.rig.detector = recording.detector;
  options.rig.seed = recording.seed;
  options.frames = recording.frames;
  options.threads = recording.threads;
  options.version = "test";
  sim::WriteSequence(scene, options, folder);
}

slam::RunOutcome Run(const fs::path& sequence, const fs::path& run, slam::Variant variant,
                     int threads) {
  slam::RunOptions options;
  options.sequence = sequence;
  options.run = run;
  options.variant = variant;
  options.threads = threads;
  options.save_segmentation = true;
  options.version = "test";
  return slam::RunSequence(options);
}

nlohmann::json Score(const fs::path& run, const fs::path& sequence) {
  const eval::Evaluation evaluation =
      eval::Evaluate(eval::ReadRun(run), eval::ReadSequence(sequence));
  return nlohmann::json::parse(eval::MetricsText(evaluation));
}

std::string Replay(const sim::Scene& scene, const Recording& recording,
                   const fs::path& scene_file) {
  fs::create_directories(scene_file.parent_path());
  sim::WriteScene(scene, scene_file);
  const char* detector = recording.detector == sim::DetectorKind::kPerfect ? "perfect"
                         : recording.detector == sim::DetectorKind::kNoisy ? "noisy"
                                                                           : "none";
  std::ostringstream text;
  text << "repeat with: pas sim " << scene_file.string() << " -o seq --frames "
       << recording.frames << " --width " << recording.width << " --height " << recording.height
       << " --sensor " << recording.sensor.name << " --detector " << detector << " --seed "
       << recording.seed << " && pas slam seq -o run --save-segmentation && pas eval run";
  return text.str();
}

}  // namespace pipeline
