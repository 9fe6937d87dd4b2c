#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "eval/regression/gate.h"

namespace app {

/// One value of a dimension of the suite: a built-in, or a file of the user's.
struct SuiteChoice {
  std::string name;
  std::filesystem::path file;  ///< empty: the built-in of that name
  std::string estimator = {};  ///< of a sensor: what `pas slam --sensor` takes it for
};

/// Where the frames of some cases come from.
struct SuiteScene {
  enum class Source {
    kFamily,      ///< a scene a seed
    kTwin,        ///< likewise, the counterpart of a recorded sequence
    kFile,        ///< a scene file; the seed is that of the recording alone
    kRecordings,  ///< every sequence folder in the folder that the command line names
  };
  Source source = Source::kFamily;
  std::string name;  ///< begins the key of its cases; of recordings, their own names do
  std::string of;    ///< the family or twin
  std::map<std::string, double> parameters;  ///< of the family
  std::filesystem::path file;
  std::optional<int> frames;  ///< instead of the suite's
  SuiteChoice camera;         ///< of recordings without camera.yaml
  std::string sensor;         ///< of recordings, as `pas slam --sensor` takes it
};

struct SuiteLimits {
  double seconds = 600;  ///< of one process, wall time
  int memory_mb = 4000;  ///< data of one process, 2^20 bytes
};

struct SuiteSeeds {
  std::uint64_t first = 1;
  int count = 1;
  int max_count = 1;  ///< up to which the gate adds seeds while it cannot tell
};

/// A suite: every scene with every sensor, motion, seed, variant and config.
struct SuiteFile {
  std::string name;
  std::optional<int> frames, width, height;  ///< else as the scene says
  SuiteLimits limits;
  SuiteSeeds seeds;
  std::vector<SuiteScene> scenes;
  std::vector<SuiteChoice> sensors, configs;
  std::vector<std::string> motions, variants;
  eval::GateRules gate;
  std::vector<std::string> gated_variants;  ///< empty: all
};

/// Names of a motion and of settings that the suite does not change.
inline constexpr const char* kOwnMotion = "own";
inline constexpr const char* kDefaultConfig = "default";

/// Reads a suite (docs/suites.md describes it); paths in it are relative to it.
/// @throws InputError with file:line for everything that is not as it should be
SuiteFile ReadSuite(const std::filesystem::path& file);

}  // namespace app
