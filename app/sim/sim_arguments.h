#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sim/scene/scene.h"
#include "sim/write/write_sequence.h"

namespace app {

/// The command line of `pas sim`. What is empty the scene's `capture` and `motion` say, else
/// the program's defaults.
struct SimArguments {
  std::string scene, output, sensor_report;
  std::optional<int> frames, width, height;
  std::optional<double> fps, speed_m_s, turn_deg_s;
  std::optional<std::string> sensor, motion;
  std::string trajectory;  ///< a recorded one, instead of the scene's motion
  std::string preview;     ///< a picture to write instead of a sequence
  int preview_frame = 0;
  sim::DetectorKind detector = sim::DetectorKind::kNoisy;
  std::uint64_t seed = 1;
  int threads = 0;
  std::vector<double> lens;
  /// What is left out is the sensor's.
  std::optional<double> shutter_ms, rolling_ms, exposure_drift_stops, drop_ratio, repeat_ratio,
      depth_offset_ms, stamp_jitter_ms, registration_px, intrinsics_error;
  bool resume = false, force = false, detector_report = false;
};

/// The files that a sequence is made of.
std::vector<std::filesystem::path> InputsOf(const SimArguments& arguments);

/// The scene that is named, moved as the command line says.
sim::Scene SceneOf(const SimArguments& arguments);

/// @param scene  SceneOf(arguments)
sim::SequenceOptions OptionsOf(const SimArguments& arguments, const sim::Scene& scene);

/// The recorded trajectory at the frames of `options`, whose path and motion it sets; all of it
/// when the command line does not say how many frames.
std::vector<sim::TimedPose> ReplayOf(const SimArguments& arguments,
                                     sim::SequenceOptions& options);

/// When and from where the frames are taken: along ReplayOf, or as the scene moves.
/// @param options  OptionsOf(arguments, scene); a replayed trajectory is noted in them
sim::Recording RecordingOf(const SimArguments& arguments, const sim::Scene& scene,
                           sim::SequenceOptions& options);

}  // namespace app
