#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "eval/regression/gated_metrics.h"

namespace eval {

/// What the gate knows of a case of a suite.
struct GateCase {
  bool done = false;  ///< false: it crashed, ran out of time or memory, or refused its input
  Figures figures;    ///< those of GatedMetrics and of the coverage
  std::string inputs = {};  ///< hash of what the suite says of it: scene, sensor, settings
};

/// By key, "SCENE/ARM": cases of one arm differ in their scene and seed alone, and those of two
/// programs are paired by key.
using GateCases = std::map<std::string, GateCase>;

/// The part of a key after its first '/'.
std::string ArmOfKey(const std::string& key);

/// Figures that the gate looks at, out of all of a case.
Figures FiguresForGate(const Figures& all);

/// A baseline that another one took the place of.
struct PastBaseline {
  std::string program;  ///< version that made it
  std::string reason;   ///< why it was accepted
  /// By arm and figure: by how much the next baseline is worse, the shift of the gate; left out: 0.
  std::map<std::string, std::map<std::string, double>> harm;
};

/// Cases that later ones are compared with, as a file that can be read and reviewed.
struct Baseline {
  std::string suite;
  std::string plan;       ///< number and size of frames: what has to be equal
  std::string program;    ///< version that made it
  std::string processor;  ///< times are compared on the same one only
  std::string reason;     ///< why it was accepted
  GateCases cases;
  std::vector<PastBaseline> history = {};  ///< the oldest first
};

/// @throws InputError for what is no baseline
Baseline ReadBaseline(const std::filesystem::path& file);

/// JSON, a line a case; ends in a newline.
std::string BaselineText(const Baseline& baseline);

}  // namespace eval
