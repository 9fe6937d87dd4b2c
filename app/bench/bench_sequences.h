#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "eval/formats/run/frame_planes.h"
#include "eval/report/evaluate.h"
#include "slam/run/tracker.h"

namespace app {

/// On what a bench runs, and with which settings.
struct BenchSequenceArguments {
  std::vector<std::string> folders;  ///< sequences with truth; empty: scenes are drawn
  int seeds = 4, frames = 60;
  std::uint64_t first_seed = 1;
  std::string sim_sensor = "kinect1", sensor = "kinect1", config_file;
};
void AddBenchSequenceOptions(CLI::App& command, BenchSequenceArguments& arguments);

/// A folder for what is drawn or run meanwhile; gone with the object, also by an error.
class ScratchFolder {
 public:
  explicit ScratchFolder(const char* name);
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// A sequence of a bench.
struct BenchSequence {
  std::string kind;  ///< what it stands for; rows of a table
  std::filesystem::path folder;
};

/// The sequences that are named; or, in a folder that is gone with the object, desks with prints
/// (textured), nearly without (texture-poor), and stacks of boards (ambiguous).
class BenchSequences {
 public:
  explicit BenchSequences(const BenchSequenceArguments& arguments);

  const std::vector<BenchSequence>& all() const { return all_; }

 private:
  std::optional<ScratchFolder> drawn_;
  std::vector<BenchSequence> all_;
};

/// A run whose folder is gone again, scored.
struct ScoredRun {
  eval::Evaluation evaluation;
  std::vector<eval::RunFrame> frames;
  double cpu_s = 0.0;  ///< of the run
};

/// @param hooks  of the tracker
ScoredRun RunAndScore(const BenchSequence& sequence, const slam::Config& config,
                      const slam::TrackerHooks& hooks = {});

/// What a bench compares, all of them errors; what is not defined is empty.
struct BenchErrors {
  std::optional<double> ate_m;                              ///< missing frames charged
  std::optional<double> plane_offset_mm, plane_normal_deg;  ///< of map planes, medians
  std::optional<double> vertex_mm;                          ///< of the map's corners, median
};
BenchErrors ErrorsOf(const ScoredRun& run);

/// Ratio of two runs on each of several sequences: the geometric mean, and the 95 % interval of it
/// by the bootstrap over sequences. "1.012 [0.990, 1.035]"; "-" without a pair.
struct PairedRatio {
  std::vector<double> logs;
  void Add(const std::optional<double>& value, const std::optional<double>& base);
  double Mean() const;
  std::string Text() const;
};

}  // namespace app
