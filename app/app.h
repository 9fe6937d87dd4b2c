#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <memory>
#include <string>
#include <vector>

/// The `pas` program: a file a subcommand, each registering itself.
namespace app {

/// What every subcommand is told.
struct Globals {
  bool quiet = false;  ///< no progress, no summary; errors still go to stderr
};

/// Exit codes of the program.
inline constexpr int kDone = 0;     ///< it did what was asked
inline constexpr int kFailure = 1;  ///< it ran, and the result is a failure
/// Bad input or usage; one line on stderr says how to mend it.
inline constexpr int kBadInput = 2;

/// Adds a subcommand to `pas`; the callback that CLI11 runs stores its exit code in
/// `exit_code`.
using AddCommand = void (*)(CLI::App& pas, const Globals& globals, int& exit_code);

/// One per file command_<name>.cpp, listed in main.cpp in the order of the data flow.
void AddSceneCommand(CLI::App& pas, const Globals& globals, int& exit_code);
void AddSimCommand(CLI::App& pas, const Globals& globals, int& exit_code);
void AddImportCommand(CLI::App& pas, const Globals& globals, int& exit_code);
void AddSlamCommand(CLI::App& pas, const Globals& globals, int& exit_code);
void AddConfigCommand(CLI::App& pas, const Globals& globals, int& exit_code);
void AddEvalCommand(CLI::App& pas, const Globals& globals, int& exit_code);
void AddPlotCommand(CLI::App& pas, const Globals& globals, int& exit_code);
void AddDrawCommand(CLI::App& pas, const Globals& globals, int& exit_code);
void AddExportCommand(CLI::App& pas, const Globals& globals, int& exit_code);
/// Its children are one per file command_bench_<part>.cpp.
void AddBenchCommand(CLI::App& pas, const Globals& globals, int& exit_code);
void AddBenchPlanes(CLI::App& bench, const Globals& globals, int& exit_code);
void AddBenchSim(CLI::App& bench, const Globals& globals, int& exit_code);
void AddBenchSlam(CLI::App& bench, const Globals& globals, int& exit_code);
void AddBenchWarp(CLI::App& bench, const Globals& globals, int& exit_code);
void AddBenchFactors(CLI::App& bench, const Globals& globals, int& exit_code);
void AddBenchEpipolar(CLI::App& bench, const Globals& globals, int& exit_code);
void AddBenchStructure(CLI::App& bench, const Globals& globals, int& exit_code);
void AddBenchWrongPlanes(CLI::App& bench, const Globals& globals, int& exit_code);
void AddSuiteCommand(CLI::App& pas, const Globals& globals, int& exit_code);
void AddCheckCommand(CLI::App& pas, const Globals& globals, int& exit_code);
void AddCalibrateCommand(CLI::App& pas, const Globals& globals, int& exit_code);
void AddSurfacesCommand(CLI::App& pas, const Globals& globals, int& exit_code);
void AddVocabularyCommand(CLI::App& pas, const Globals& globals, int& exit_code);

}  // namespace app
