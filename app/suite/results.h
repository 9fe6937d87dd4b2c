#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "app/suite/database.h"
#include "app/suite/run_case.h"

namespace app {

/// The file of all rows in a results folder.
inline constexpr const char* kResultsFile = "results.sqlite";

/// @throws InputError for a folder that is not to hold results: neither empty, nor with some already
void RequireResultsFolder(const std::filesystem::path& folder);

/// @throws InputError for a folder without results
void RequireResults(const std::filesystem::path& folder);

/// A case as it stands in the results.
struct ResultRow {
  std::string inputs_sha256;
  std::string command;  ///< line of a shell that runs it again from the results folder
  CaseResult result;
};

/// The results of a suite: tables `cases`, `figures` and `times` (docs/suites.md). Each case is
/// there whole or not at all, whenever the process ends.
class Results {
 public:
  /// @throws InputError when the file holds something else
  explicit Results(const std::filesystem::path& folder);
  ~Results();  ///< leaves one file

  /// Puts the case in, over an older one.
  void Put(const SuiteCase& one, const CaseResult& result, const std::string& program,
           const std::string& command);
  /// Key -> row.
  std::map<std::string, ResultRow> Rows();
  /// Takes in the cases of another folder's results.
  /// @throws InputError when both have a case and its inputs differ
  void Merge(const std::filesystem::path& folder);

 private:
  void ReadNumbers(const std::string& table, eval::Figures CaseResult::*into,
                   std::map<std::string, ResultRow>& rows);
  Database database_;
};

}  // namespace app
