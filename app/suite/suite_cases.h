#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "app/suite/suite_file.h"

namespace app {

/// One run of `pas slam` and its evaluation.
struct SuiteCase {
  std::string key;    ///< SCENE-SEED/SENSOR/MOTION/VARIANT/CONFIG, unique in the suite
  std::string scene;  ///< SCENE-SEED
  std::uint64_t seed = 0;
  std::string variant;
  /// What `pas slam` is given but -o; paths are relative to the results folder where they can be.
  std::vector<std::string> slam;
  std::string
      scene_sha256;  ///< of the scene's text; of a recording, of its lists, sizes and camera
  std::string inputs_sha256;  ///< of all that decides the result, the program too
  /// Of what the suite says of it, without the program: of a family its name and parameters, not what
  /// the program makes of them, and no path. A baseline holds it.
  std::string setup_sha256 = {};
};

/// The program that runs the cases.
struct SuiteProgram {
  std::filesystem::path file;  ///< absolute
  std::filesystem::path
      run;  ///< starts it: `file`, or what this process runs, whatever its file is now
  std::string sha256;
  std::string stamp;  ///< of `run` when it was hashed: device, inode, size, time

  /// @throws InputError when another program is there now
  void RequireUnchanged() const;
};

/// @param file  empty: this program
/// @throws InputError when it cannot be run
SuiteProgram ProgramOf(const std::filesystem::path& file);

/// Keys of the cases of these many seeds, of which nothing is made; sorted.
std::vector<std::string> CaseKeys(const SuiteFile& suite, int seeds,
                                  const std::filesystem::path& recordings,
                                  const std::filesystem::path& folder);

/// Every `count`th case from `first` on, which is 0 for the first case. By default all cases.
struct SuiteShard {
  std::size_t first = 0, count = 1;
};

/// The cases of a shard with the first `seeds` seeds of the suite, in the order of their keys.
/// Writes their scenes and the suite's files into `folder`, below scenes/ and inputs/, so that a
/// case can be run again from there.
/// @param recordings  folder of recordings; empty when the suite has none
/// @throws InputError
std::vector<SuiteCase> PlanCases(const SuiteFile& suite, int seeds,
                                 const std::filesystem::path& recordings,
                                 const SuiteProgram& program,
                                 const std::filesystem::path& folder,
                                 const SuiteShard& shard = {});

}  // namespace app
