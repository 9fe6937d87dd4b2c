// `pas suite` as a process: what its rows hold when cases fail, when it is killed, split and merged;
// and what its gate says. The cases are run by a script in place of pas, which takes milliseconds.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sqlite3.h>

#include <chrono>
#include <fstream>
#include <set>
#include <thread>

#include "tests/support/program.h"

namespace {

using namespace program;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;

using Rows = std::vector<std::string>;

/// Rows of a query, columns separated by '|'.
Rows Query(const fs::path& folder, const std::string& sql) {
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

TEST_F(SuiteProgram, FailsWhereACaseIsBeyondABoundOfTheSuite) {
  // ATE is a millimetre times the seed.
  const std::string bound = "gate: {worst: {/trajectory/ate_se3/rmse_m: 0.0035}}\n";
  WriteSuite("seeds: {first: 1, count: 3}\n" + bound);
  EXPECT_EQ(Suite("out").exit_code, 0);
  WriteSuite("seeds: {first: 1, count: 4}\n" + bound);
  EXPECT_EQ(Suite("out").exit_code, 1);
}

TEST_F(SuiteProgram, PutsFiguresNullsAndTimesIntoRows) {
  EXPECT_EQ(Suite("out").exit_code, 0);
  EXPECT_THAT(Query(folder_ / "out", "SELECT key FROM cases"), SizeIs(10));
  const std::string one = " WHERE key = 'wall-3/kinect1/own/full/default'";
  EXPECT_THAT(Query(folder_ / "out", "SELECT figure, value FROM figures" + one),
              ElementsAre("/trajectory/ate_se3/rmse_m|0.003", "/trajectory/frames|10.0",
                          "/trajectory/rpe_1m|null", "/trajectory/tracked|10.0"));
  EXPECT_THAT(
      Query(folder_ / "out", "SELECT time FROM times" + one),
      ElementsAre("/timing_ms/mt/mean", "evaluation_s", "peak_mb", "rendering_s", "slam_s"));
  EXPECT_THAT(Query(folder_ / "out", "SELECT command FROM cases" + one).front(),
              HasSubstr("pas -q slam --live scenes/wall-3.yaml --frames 10"));
}

TEST_F(SuiteProgram, MakesTheSameRowsWhateverTheNumberOfJobs) {
  Suite("one", {"-j", "1"});
  Suite("four", {"-j", "4"});
  EXPECT_EQ(Content("one"), Content("four"));
}

TEST_F(SuiteProgram, RunsNothingTwiceUnlessItsInputsChanged) {
  Suite("out");
  EXPECT_EQ(Runs("out"), 10u);
  Suite("out");
  EXPECT_EQ(Runs("out"), 0u);
  WriteSuite("seeds: {first: 1, count: 6}\n");
  Suite("out");
  EXPECT_EQ(Runs("out"), 2u);
  WriteProgram("true");
  Suite("out");
  EXPECT_EQ(Runs("out"), 12u);
}

TEST_F(SuiteProgram, RunsARecordingAgainWhoseListsOrCameraChanged) {
  std::ofstream(folder_ / "suite.yaml")
      << "format: pas-suite/1\nname: real\nscenes: [{recordings: all}]\n";
  fs::create_directories(folder_ / "all/one");
  const auto put = [&](const char* name, const char* text) {
    std::ofstream(folder_ / "all/one" / name) << text;
  };
  put("rgb.txt", "1.0 rgb/1.png\n");
  put("depth.txt", "1.0 depth/1.png\n");
  put("camera.yaml", "fx: 525\n");
  const auto runs = [&] {
    const Outcome outcome = Suite("out", {"--recordings", folder_ / "all"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
    return fs::exists(folder_ / "out/log") ? Runs("out") : 0;
  };
  EXPECT_EQ(runs(), 1u);
  EXPECT_EQ(runs(), 0u);
  put("camera.yaml", "fx: 517\n");  // as long as before
  EXPECT_EQ(runs(), 1u);
  put("depth.txt", "1.5 depth/1.png\n");
  EXPECT_EQ(runs(), 1u);
}

TEST_F(SuiteProgram, ACrashAHangHungerAndARefusalAreRows) {
  WriteSuite("seeds: {first: 1, count: 5}\nlimits: {seconds: 3, memory_mb: 200}\n");
  WriteProgram(
      "case \"$*\" in\n"
      "  *wall-2*) kill -SEGV $$;;\n"
      "  *wall-3*) sleep 60;;\n"
      "  *wall-4*) python3 -c 'a = bytearray(500 << 20)' || { echo 'pas: out of memory' >&2; "
      "exit 2; };;\n"
      "  *wall-5*) echo 'pas: the camera was lost' >&2; echo more >&2; exit 1;;\n"
      "esac");
  EXPECT_EQ(Suite("out").exit_code, 1);
  EXPECT_THAT(
      Statuses("out"),
      ElementsAre("wall-2|crashed|ended by Segmentation fault",
                  "wall-3|timeout|not done after 3 s", "wall-4|memory|needs more than 200 MB",
                  "wall-5|failed|exit code 1: pas: the camera was lost"));
  EXPECT_THAT(Query(folder_ / "out", "SELECT key FROM cases WHERE status = 'done'"), SizeIs(6));
  // A failure is a result: it is not tried again.
  Runs("out");
  EXPECT_EQ(Suite("out").exit_code, 1);
  EXPECT_EQ(Runs("out"), 0u);
}

TEST_F(SuiteProgram, KilledInTheMiddleItGoesOnWhereItWas) {
  Suite("whole");
  WriteProgram("sleep 0.2");
  Suite("slow");
  const Process killed(Command("out", {"-j", "1"}), {}, folder_ / "errors");
  while (Runs("out") == 0) std::this_thread::sleep_for(std::chrono::milliseconds(20));
  std::this_thread::sleep_for(std::chrono::milliseconds(600));
  killed.Kill();
  killed.Wait();
  const std::size_t done = Query(folder_ / "out", "SELECT key FROM cases").size();
  EXPECT_GT(done, 0u);
  EXPECT_LT(done, 10u);
  Runs("out");
  EXPECT_EQ(Suite("out", {"-j", "2"}).exit_code, 0);
  EXPECT_EQ(Runs("out"), 10 - done);
  EXPECT_EQ(Content("out"), Content("slow"));
  EXPECT_THAT(Contents(folder_ / "out/work"), IsEmpty());
}

TEST_F(SuiteProgram, InterruptedItKeepsWhatIsDoneAndSaysSo) {
  WriteProgram("sleep 0.2");
  const Process process(Command("out", {"-j", "1"}), {}, folder_ / "errors");
  while (Runs("out") == 0) std::this_thread::sleep_for(std::chrono::milliseconds(20));
  std::this_thread::sleep_for(std::chrono::milliseconds(600));
  process.Send(SIGINT);
  const Outcome outcome = process.Wait();
  EXPECT_EQ(outcome.exit_code, 128 + SIGINT);
  EXPECT_THAT(outcome.errors, HasSubstr("keeps what was done"));
  EXPECT_THAT(Query(folder_ / "out", "SELECT key FROM cases"), Not(IsEmpty()));
  EXPECT_THAT(Query(folder_ / "out", "SELECT key FROM cases WHERE status <> 'done'"),
              IsEmpty());
}

TEST_F(SuiteProgram, ShardsMergeToWhatOneRunMakes) {
  Suite("whole");
  for (const char* i : {"1", "2", "3"}) {
    EXPECT_EQ(Suite("part" + std::string(i), {"--shard", i + std::string("/3")}).exit_code, 0);
  }
  const Outcome merged =
      Process({Pas(), "-q", "suite", "merge", folder_ / "part3", folder_ / "part1",
               folder_ / "part2", "-o", folder_ / "merged"},
              {}, folder_ / "errors")
          .Wait();
  EXPECT_EQ(merged.exit_code, 0) << merged.errors;
  EXPECT_EQ(Content("merged"), Content("whole"));
  EXPECT_EQ(Suite("merged").exit_code, 0);
  EXPECT_EQ(Runs("merged"), 0u);
}

TEST_F(SuiteProgram, AShardMakesTheScenesOfItsOwnCasesAlone) {
  Suite("part", {"--shard", "2/3"});
  std::set<std::string> made;
  for (const fs::directory_entry& scene : fs::directory_iterator(folder_ / "part" / "scenes")) {
    made.insert(scene.path().stem().string());
  }
  EXPECT_THAT(made, ElementsAre("plates-2", "plates-5", "wall-3"));
}

TEST_F(SuiteProgram, RefusesWhatCannotBe) {
  for (const char* shard : {"4/3", "0/3", "1.5/3", "-1/3", "1/0", "1"}) {
    const Outcome refused = Suite("out", {"--shard", shard});
    EXPECT_EQ(refused.exit_code, 2) << shard;
    EXPECT_THAT(refused.errors, HasSubstr("I from 1 to N")) << shard;
  }
  EXPECT_THAT(Suite("out", {"--baseline", folder_ / "none.json"}).errors,
              HasSubstr("--accept"));
  EXPECT_THAT(Suite("out", {"--replay", "no/such"}).errors,
              HasSubstr("is no case of this suite"));
  EXPECT_THAT(Suite("").errors, HasSubstr("neither empty nor a folder of results"));
  std::ofstream(folder_ / "suite.yaml")
      << "format: pas-suite/1\nname: r\nscenes: [{recordings: all}]\n";
  EXPECT_THAT(Suite("out").errors, HasSubstr("--recordings FOLDER"));
}

TEST_F(SuiteProgram, ReplaysACase) {
  EXPECT_EQ(Suite("out", {"--replay", "wall-3/kinect1/own/full/default"}).exit_code, 0);
  EXPECT_TRUE(fs::exists(folder_ / "out/replay/metrics.json"));
}

TEST_F(SuiteProgram, ShrinksACaseWhileItFailsAlike) {
  // It crashes from four frames on when the first of the two boards is there.
  WriteSuite("seeds: {first: 1, count: 1}\nsize_px: [320, 240]\n");
  WriteProgram(
      "case \"$*\" in *slam*)\n"
      "  frames=${*##*--frames }; frames=${frames%% *}\n"
      "  if [ $frames -ge 4 ] && grep -q 'name: book_1' $4; then kill -SEGV $$; fi;;\n"
      "esac");
  const Outcome outcome = Suite("out", {"--shrink", "plates-1/kinect1/own/full/default"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  const std::string suite = ReadText(folder_ / "out/shrunk/suite.yaml");
  EXPECT_THAT(suite, HasSubstr("frames: 5\nsize_px: [80, 60]"));
  const std::string scene = ReadText(folder_ / "out/shrunk/scene.yaml");
  EXPECT_EQ(scene.find("name:", scene.find("name:", scene.find("objects:")) + 1),
            std::string::npos)
      << scene;
  // What it wrote is a suite that fails in the same way.
  fs::copy_file(folder_ / "out/shrunk/suite.yaml", folder_ / "out/shrunk/again.yaml");
  const Outcome again = Process({Pas(), "-q", "suite", folder_ / "out/shrunk/again.yaml", "-o",
                                 folder_ / "again", "--program", folder_ / "fake"},
                                {}, folder_ / "errors")
                            .Wait();
  EXPECT_EQ(again.exit_code, 1) << again.errors;
  EXPECT_THAT(Statuses("again"), ElementsAre(HasSubstr("crashed")));
}

TEST_F(SuiteProgram, LeavesTheLastSceneThatFailedWhereSmallerOnesDoNot) {
  WriteSuite("seeds: {first: 1, count: 1}\n");
  WriteProgram(
      "case \"$*\" in *slam*)\n"
      "  if grep -q 'name: book_1' $4 && grep -q 'name: book_2' $4; then kill -SEGV $$; fi;;\n"
      "esac");
  const Outcome outcome = Suite("out", {"--shrink", "plates-1/kinect1/own/full/default"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  const std::string scene = ReadText(folder_ / "out/shrunk/scene.yaml");
  EXPECT_THAT(scene, HasSubstr("name: book_1"));
  EXPECT_THAT(scene, HasSubstr("name: book_2"));
  EXPECT_THAT(scene, Not(HasSubstr("name: desk")));
}

TEST_F(SuiteProgram, ShrinksNothingThatDoesNotFail) {
  const Outcome outcome = Suite("out", {"--shrink", "plates-1/kinect1/own/full/default"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.errors, HasSubstr("does not fail; bound its figures"));
}

class SuiteGate : public SuiteProgram {
 protected:
  void SetUp() override {
    SuiteProgram::SetUp();
    EXPECT_EQ(Gate("before", {"--accept", "first"}).exit_code, 0);
  }
  Outcome Gate(const std::string& results, std::vector<std::string> more = {}) const {
    more.insert(more.end(), {"--baseline", folder_ / "baseline.json"});
    return Suite(results, more);
  }
  std::size_t Cases(const std::string& results) const {
    return Query(folder_ / results, "SELECT key FROM cases").size();
  }
};

TEST_F(SuiteGate, AnUnchangedProgramIsGreenWithTheFirstSeeds) {
  for (int i = 0; i < 5; ++i) {
    EXPECT_EQ(Gate("now" + std::to_string(i)).exit_code, 0);
    EXPECT_EQ(Cases("now" + std::to_string(i)), 10u);
  }
}

TEST_F(SuiteGate, AnErrorThatGrewByATenthIsRed) {
  WriteProgram("factor=1.10");
  EXPECT_EQ(Gate("now").exit_code, 1);
}

TEST_F(SuiteGate, AddsSeedsUntilItCanTell) {
  // Worse by a tenth in the mean, by anything between -20 % and +40 % in each case.
  WriteProgram("factor=$(awk \"BEGIN { print 1.1 + 0.3 * ((${seed:-0} % 2) * 2 - 1) }\")");
  Gate("now");
  EXPECT_EQ(Cases("now"), 36u);  // 5, 10 and, as no more are wanted, 18 seeds
}

TEST_F(SuiteGate, WhatIsAcceptedIsGreen) {
  WriteProgram("factor=1.10");
  EXPECT_EQ(Gate("now", {"--accept", "a better reason"}).exit_code, 0);
  EXPECT_THAT(ReadText(folder_ / "baseline.json"),
              HasSubstr("\"reason\": \"a better reason\""));
  EXPECT_EQ(Gate("now").exit_code, 0);
}

/// A module that takes `da_ms`, a word of the shell, beside one millisecond of ORB features.
std::string WithTimes(const std::string& da_ms) {
  return "if [ \"$2\" = slam ]; then\n"
         "  run=${*##*-o }; run=${run%% *}; mkdir -p $run\n"
         "  echo timestamp,orb,od,mdc,epi,pp,da,po,upm,mt > $run/timing.csv\n"
         "  echo 1.0,1,1,1,1,1," +
         da_ms + ",1,1,9 >> $run/timing.csv\nfi\n";
}

TEST_F(SuiteGate, ATimeIsWorseOnlyIfItIsSoAgain) {
  WriteSuite("seeds: {first: 1, count: 8}\n");
  WriteProgram(WithTimes("1.0"));
  EXPECT_EQ(Gate("before-times", {"--accept", "with times"}).exit_code, 0);
  // Slow in the first run of the sixteen cases, as where the machine has other work for a minute.
  WriteProgram(
      WithTimes("$([ $(cat log 2>/dev/null | wc -l) -lt 16 ] && echo 1.1 || echo 1.0)"));
  EXPECT_EQ(Gate("held-up").exit_code, 0);
  EXPECT_EQ(Runs("held-up"), 16u * 5u);
  WriteProgram(WithTimes("1.1"));
  EXPECT_EQ(Gate("slow").exit_code, 1);
}

TEST_F(SuiteGate, ASlowDownIsFoundThatTheFirstRunHalfHides) {
  WriteSuite("seeds: {first: 1, count: 8}\n");
  WriteProgram(WithTimes("1.0"));
  EXPECT_EQ(Gate("before-times", {"--accept", "with times"}).exit_code, 0);
  WriteProgram(
      WithTimes("$([ $(cat log 2>/dev/null | wc -l) -lt 16 ] && echo 1.02 || echo 1.05)"));
  EXPECT_EQ(Gate("half-hidden").exit_code, 1);
  EXPECT_EQ(Runs("half-hidden"), 16u * 5u);
}

TEST_F(SuiteGate, MoreFailuresAreRed) {
  WriteProgram("case \"$*\" in *wall-2*) exit 1;; esac");
  EXPECT_EQ(Gate("now").exit_code, 1);
}

TEST_F(SuiteGate, ABaselineOfAnotherSuiteIsRefused) {
  WriteSuite("size_px: [160, 120]\n");
  const Outcome outcome = Gate("now");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.errors, HasSubstr("10 frames, own x own"));
}

}  // namespace
