#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sqlite3.h>

#include <algorithm>
#include <fstream>
#include <iterator>

#include "tests/support/program.h"

// `pas suite` as a process, whose cases are run by a script in place of pas, which takes
// milliseconds.

namespace program {

using Rows = std::vector<std::string>;

/// Rows of a query, columns separated by '|'.
inline Rows Query(const fs::path& folder, const std::string& sql) {
  sqlite3* database = nullptr;
  Rows rows;
  sqlite3_open((folder / "results.sqlite").c_str(), &database);
  const auto add = [](void* into, int count, char** values, char**) {
    std::string row;
    for (int i = 0; i < count; ++i)
      row += (i > 0 ? "|" : "") + std::string(values[i] ? values[i] : "null");
    static_cast<Rows*>(into)->push_back(row);
    return 0;
  };
  const int status = sqlite3_exec(database, sql.c_str(), add, &rows, nullptr);
  EXPECT_EQ(status, SQLITE_OK) << sqlite3_errmsg(database);
  sqlite3_close(database);
  return rows;
}

class SuiteProgram : public testing::Test {
 protected:
  void SetUp() override {
    WriteSuite("seeds: {first: 1, count: 5, max_count: 18}\n");
    WriteProgram("");
  }
  void WriteSuite(const std::string& more) const {
    std::ofstream(folder_ / "suite.yaml") << "format: pas-suite/1\nname: fake\nframes: "
                                             "10\nscenes: [{family: plates}, {family: wall}]\n"
                                          << more;
  }
  /// A program that makes figures of the seed; `before` is run first, with the arguments in "$*".
  void WriteProgram(const std::string& before) const {
    const fs::path file = folder_ / "fake";
    std::ofstream(file)
        << "#!/bin/sh\nset -e\ncase \"$*\" in *--seed*)\n"
           "  seed=${*##*--seed }; seed=${seed%% *};; esac\n"
           "factor=1.00\n"
        << before
        << "\nif [ \"$2\" = slam ]; then\n"
           "  echo $3 $4 >> log\n"
           "  run=${*##*-o }; run=${run%% *}; mkdir -p $run\n"
           "  awk \"BEGIN { print 0.001 * $seed * $factor }\" > $run/ate\n"
           "else\n"
           "  echo '{\"trajectory\": {\"frames\": 10, \"tracked\": 10, \"ate_se3\": "
           "{\"rmse_m\": '$(cat $3/ate)'}, \"rpe_1m\": null}, \"timing_ms\": {\"mt\": "
           "{\"mean\": 5}}, \"reasons\": {}}' > $3/metrics.json\nfi\n";
    fs::permissions(file, fs::perms::owner_all);
  }
  std::vector<std::string> Command(const std::string& results,
                                   const std::vector<std::string>& more = {}) const {
    std::vector<std::string> command{Pas(),       "-q",
                                     "suite",     folder_ / "suite.yaml",
                                     "-o",        folder_ / results,
                                     "--program", folder_ / "fake"};
    command.insert(command.end(), more.begin(), more.end());
    return command;
  }
  Outcome Suite(const std::string& results, const std::vector<std::string>& more = {}) const {
    return Process(Command(results, more), {}, folder_ / "errors").Wait();
  }
  /// All that does not tell of time.
  Rows Content(const std::string& results) const {
    Rows rows = Query(folder_ / results, "SELECT * FROM cases ORDER BY key");
    for (const std::string& row :
         Query(folder_ / results, "SELECT * FROM figures ORDER BY key, figure")) {
      rows.push_back(row);
    }
    return rows;
  }
  Rows Statuses(const std::string& results) const {
    return Query(
        folder_ / results,
        "SELECT scene, status, message FROM cases WHERE status <> 'done' ORDER BY key");
  }
  /// How many runs there were since the last call.
  std::size_t Runs(const std::string& results) const {
    std::ifstream log(folder_ / results / "log");
    const auto lines = std::count(std::istreambuf_iterator<char>(log), {}, '\n');
    fs::remove(folder_ / results / "log");
    return static_cast<std::size_t>(lines);
  }

  TemporaryFolder folder_;
};

}  // namespace program
