// `pas slam` that closes loops, as its settings say, on a camera that comes back to where it began.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/support/program.h"

namespace {

using namespace program;

TEST(LoopClosing, TakesTheFramesBetweenKeyframesAlong) {
  const TemporaryFolder folder;
  const fs::path scene = folder / "room.yaml", sequence = folder / "seq", run = folder / "run",
                 settings = folder / "settings.yaml";
  std::ofstream(settings) << "loop_closing: {enabled: true}\n";
  const std::vector<std::vector<std::string>> commands{
      {Pas(), "-q", "scene", "make", "--family", "room", "--seed", "77", "-o", scene},
      {Pas(),      "-q",       "sim",        scene,   "-o",     sequence,  "--motion",
       "loop",     "--frames", "120",        "--fps", "5",      "--width", "320",
       "--height", "240",      "--detector", "none",  "--seed", "77"},
      {"/bin/sh", "-c",
       Pas().string() + " slam " + sequence.string() + " --config " + settings.string() +
           " -o " + run.string() + " >&2"},
      {Pas(), "-q", "eval", run}};
  std::string told;
  for (const auto& command : commands) {
    const Outcome outcome = Process(command, {}, folder / "errors").Wait();
    ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
    told += outcome.errors;
  }
  ASSERT_THAT(told, testing::ContainsRegex(
                        "[1-9] loops? closed"));  // else poses stay as they were found
  const auto metrics = nlohmann::json::parse(ReadText(run / "metrics.json"));
  // 3 mm were measured, and 13 where keyframes alone were where they belong.
  EXPECT_LT(metrics.at("trajectory").at("ate_se3").at("rmse_m").get<double>(), 0.007);
}

}  // namespace
