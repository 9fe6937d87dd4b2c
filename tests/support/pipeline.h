#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "sim/write/write_sequence.h"
#include "slam/run/run_sequence.h"
#include "tests/support/file_contents.h"
#include "tests/support/temporary_folder.h"

/// The whole way in one process: scene -> sequence -> run -> metrics.
namespace pipeline {

using test_support::Contents;
using test_support::TemporaryFolder;

/// What is simulated.
struct Recording {
  int frames = 60;
  int width = 320, height = 240;
  sim::Sensor sensor = sim::SensorKind::kKinect1Clean;
  sim::DetectorKind detector = sim::DetectorKind::kNoisy;
  std::uint64_t seed = 1;
  int threads = 2;
};

/// Writes the sequence of a scene to `folder`.
void Record(const sim::Scene& scene, const Recording& recording,
            const std::filesystem::path& folder);

/// Runs the system on a sequence; the segmentation is saved.
slam::RunOutcome Run(const std::filesystem::path& sequence, const std::filesystem::path& run,
                     slam::Variant variant = slam::Variant::kFull, int threads = 2);

/// metrics.json of a run against its sequence.
nlohmann::json Score(const std::filesystem::path& run, const std::filesystem::path& sequence);

/// The commands by which a person repeats a case: the scene is written to `scene_file`.
std::string Replay(const sim::Scene& scene, const Recording& recording,
                   const std::filesystem::path& scene_file);

}  // namespace pipeline
