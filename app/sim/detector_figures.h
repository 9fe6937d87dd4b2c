#pragma once

#include <filesystem>

namespace app {

/// Scores the detector presets on desks of known truth: seeds 1 to 3 of the desk family, 300
/// frames each of 640 x 480. Prints the table and writes it to OUTPUT/detectors.txt.
/// @returns the program's exit code
int ReportDetectors(const std::filesystem::path& output, bool force, bool quiet);

}  // namespace app
