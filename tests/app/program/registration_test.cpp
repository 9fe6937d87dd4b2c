// What a run learns of how far depth lies beside colour is taken out of it.
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/support/program.h"

namespace {

using namespace program;

nlohmann::json Json(const fs::path& file) { return nlohmann::json::parse(ReadText(file)); }

TEST(LearntRegistration, BringsTheCornersOfTheMapNearerToTheTruth) {
  const TemporaryFolder folder;
  const auto run = [&](std::vector<std::string> command) {
    command.insert(command.begin(), {Pas(), "-q"});
    return Process(command, {}, folder / "errors").Wait().exit_code;
  };
  const std::string scene = folder / "desk.yaml", sequence = folder / "seq";
  ASSERT_EQ(run({"scene", "make", "--family", "desk", "--seed", "2501", "-o", scene}), 0);
  ASSERT_EQ(run({"sim", scene, "-o", sequence, "--sensor", "kinect1-clean", "--registration-px",
                 "5", "--frames", "50", "--fps", "15"}),
            0);
  std::ofstream(folder / "off.yaml") << "depth_registration: {learn: false}\n";
  const std::string on = folder / "on", off = folder / "off";
  ASSERT_EQ(run({"slam", sequence, "-o", on}), 0);
  ASSERT_EQ(run({"slam", sequence, "-o", off, "--config", folder / "off.yaml"}), 0);
  ASSERT_EQ(run({"eval", on}), 0);
  ASSERT_EQ(run({"eval", off}), 0);
  EXPECT_EQ(Json(folder / "on/run.json").at("depth_registration").at("applied"), true);
  EXPECT_EQ(Json(folder / "off/run.json").at("depth_registration").at("applied"), false);
  const auto corner_mm = [&](const char* name) {
    return Json(folder / name / "metrics.json")
        .at("map")
        .at("vertex_mm")
        .at("median")
        .get<double>();
  };
  EXPECT_LT(corner_mm("on"), 0.95 * corner_mm("off"));
}

}  // namespace
