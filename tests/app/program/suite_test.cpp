// What the rows of `pas suite` hold when cases fail, when it is killed, split and merged.
#include <chrono>
#include <set>
#include <thread>

#include "tests/app/program/fake_suite.h"

namespace {

using namespace program;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;

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

TEST_F(SuiteProgram, RunsAgainWhatAFileOfTheUsersChanged) {
  std::ofstream(folder_ / "sensor.yaml") << "base: azure\n";
  std::ofstream(folder_ / "config.yaml") << "pose: {rounds: 4}\n";
  WriteSuite(
      "seeds: {first: 1, count: 2}\nsensors: [kinect1, {name: mine, file: sensor.yaml}]\n"
      "configs: [default, {name: mine, file: config.yaml}]\n");
  Suite("out");
  const std::size_t all = Runs("out");
  Suite("out");
  EXPECT_EQ(Runs("out"), 0u);
  std::ofstream(folder_ / "sensor.yaml") << "base: d435 \n";  // as long as before
  Suite("out");
  EXPECT_EQ(Runs("out"), all / 2);
  std::ofstream(folder_ / "config.yaml") << "pose: {rounds: 5}\n";
  Suite("out");
  EXPECT_EQ(Runs("out"), all / 2);
  std::ofstream(folder_ / "warp.yaml") << "1\n";
  std::ofstream(folder_ / "config.yaml")
      << "depth_warp: {source: " << (folder_ / "warp.yaml").string() << "}\n";
  Suite("out");
  EXPECT_EQ(Runs("out"), all / 2);
  std::ofstream(folder_ / "warp.yaml") << "2\n";
  Suite("out");
  EXPECT_EQ(Runs("out"), all / 2);
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
  fs::create_directories(folder_ / "elsewhere");  // images may lie on another disk
  std::ofstream(folder_ / "elsewhere/1.png") << "an image";
  fs::create_directory_symlink(folder_ / "elsewhere", folder_ / "all/one/depth");
  EXPECT_EQ(runs(), 1u);
  std::ofstream(folder_ / "elsewhere/1.png") << "another image";
  EXPECT_EQ(runs(), 1u);
}

TEST_F(SuiteProgram, RunsARecordingAgainWhoseCameraBesideTheSuiteChanged) {
  std::ofstream(folder_ / "suite.yaml")
      << "format: pas-suite/1\nname: real\nscenes: [{recordings: all, camera: cam.yaml}]\n";
  fs::create_directories(folder_ / "all/one");
  std::ofstream(folder_ / "all/one/rgb.txt") << "1.0 rgb/1.png\n";
  std::ofstream(folder_ / "all/one/depth.txt") << "1.0 depth/1.png\n";
  // The program finds the file where the command says.
  WriteProgram(
      "case \"$*\" in *--camera*) file=${*##*--camera }; cat ${file%% *} >> seen;; esac");
  for (const char* text : {"fx: 525\n", "fx: 525\n", "fx: 517\n"}) {
    std::ofstream(folder_ / "cam.yaml") << text;
    const Outcome outcome = Suite("out", {"--recordings", folder_ / "all"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  }
  EXPECT_EQ(ReadText(folder_ / "out/seen"), "fx: 525\nfx: 517\n");
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
                  "wall-3|timeout|not done after 3 s", "wall-4|memory|needs more than 200 MiB",
                  "wall-5|failed|exit code 1: pas: the camera was lost"));
  EXPECT_THAT(Query(folder_ / "out", "SELECT key FROM cases WHERE status = 'done'"), SizeIs(6));
  // A failure is a result: it is not tried again.
  Runs("out");
  EXPECT_EQ(Suite("out").exit_code, 1);
  EXPECT_EQ(Runs("out"), 0u);
}

TEST_F(SuiteProgram, RunsAgainAtOtherLimitsWhatWasEndedAtALimitAlone) {
  WriteProgram(
      "case \"$*\" in *slam*wall-1*) sleep 3;; *slam*wall-2*) echo 'pas: lost' >&2; exit 1;; "
      "esac");
  const auto suite = [&](const char* seconds) {
    WriteSuite(std::string("seeds: {first: 1, count: 2}\nlimits: {seconds: ") + seconds +
               "}\n");
    Suite("out");
  };
  suite("1");
  EXPECT_EQ(Runs("out"), 2u);  // of the plates: the others end before they say so
  suite("1");
  EXPECT_THAT(Statuses("out"), ElementsAre("wall-1|timeout|not done after 1 s",
                                           "wall-2|failed|exit code 1: pas: lost"));
  EXPECT_FALSE(fs::exists(folder_ / "out/log"));
  suite("60");
  EXPECT_THAT(Statuses("out"), ElementsAre("wall-2|failed|exit code 1: pas: lost"));
  EXPECT_EQ(Runs("out"), 1u);
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

// A scheduler ends all processes at once, and the suite may see that of a case before its own.
TEST_F(SuiteProgram, ACaseThatIsEndedFromOutsideIsNoResult) {
  for (const char* end : {"kill -TERM $$; sleep 9", "exit 143"}) {
    WriteProgram(std::string("[ -e ../again ] || case \"$*\" in *slam*wall-2*) ") + end +
                 ";; esac");
    const Outcome outcome = Suite("out", {"-j", "1"});
    EXPECT_EQ(outcome.exit_code, 128 + SIGTERM);
    EXPECT_THAT(outcome.errors, HasSubstr("keeps what was done"));
    EXPECT_THAT(Query(folder_ / "out", "SELECT scene FROM cases WHERE scene LIKE 'wall%'"),
                ElementsAre("wall-1"));
    std::ofstream(folder_ / "again") << "\n";
    EXPECT_EQ(Suite("out").exit_code, 0);
    EXPECT_THAT(Query(folder_ / "out", "SELECT key FROM cases"), SizeIs(10));
    fs::remove(folder_ / "again");
    fs::remove_all(folder_ / "out");
  }
}

TEST_F(SuiteProgram, AProgramThatIsReplacedMeanwhileMakesNoRows) {
  WriteProgram("case \"$*\" in *slam*wall-2*) cp \"$0\" copy; mv copy \"$0\";; esac");
  const Outcome outcome = Suite("out", {"-j", "1"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.errors, HasSubstr("fake: has changed while the suite ran"));
  EXPECT_THAT(Query(folder_ / "out", "SELECT scene FROM cases WHERE scene LIKE 'wall%'"),
              ElementsAre("wall-1"));
}

TEST_F(SuiteProgram, RunsFailuresAgainWhenAsked) {
  WriteProgram("[ -e ../space ] || case \"$*\" in *slam*wall-2*) exit 1;; esac");
  EXPECT_EQ(Suite("out").exit_code, 1);
  std::ofstream(folder_ / "space") << "\n";
  Runs("out");
  EXPECT_EQ(Suite("out").exit_code, 1);
  EXPECT_EQ(Runs("out"), 0u);
  EXPECT_EQ(Suite("out", {"--retry-failed"}).exit_code, 0);
  EXPECT_EQ(Runs("out"), 1u);
}

TEST_F(SuiteProgram, MergingTakesWhatIsDoneForWhatIsNot) {
  const auto merge = [&](const char* from) {
    return Process({Pas(), "-q", "suite", "merge", folder_ / from, "-o", folder_ / "merged"},
                   {}, folder_ / "errors")
        .Wait()
        .exit_code;
  };
  WriteProgram("[ -e ../space ] || case \"$*\" in *slam*wall-2*) exit 1;; esac");
  Suite("failed");
  std::ofstream(folder_ / "space") << "\n";
  Suite("done");
  EXPECT_EQ(merge("failed"), 0);
  EXPECT_THAT(Statuses("merged"), SizeIs(1));
  EXPECT_EQ(merge("done"), 0);
  EXPECT_EQ(merge("failed"), 0);
  EXPECT_EQ(Content("merged"), Content("done"));
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

TEST_F(SuiteProgram, MergesNothingWhereAFolderHasNoResults) {
  Suite("part", {"--shard", "1/3"});
  const Outcome refused = Process({Pas(), "-q", "suite", "merge", folder_ / "part",
                                   folder_ / "nosuch", "-o", folder_ / "merged"},
                                  {}, folder_ / "errors")
                              .Wait();
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.errors, HasSubstr("nosuch: holds no results.sqlite"));
  EXPECT_FALSE(fs::exists(folder_ / "merged"));
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
  for (const char* shard : {"4/3", "0/3", "1.5/3", "-1/3", "1/0", "1", "1/1e300"}) {
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

}  // namespace
