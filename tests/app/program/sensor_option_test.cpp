// --sensor auto: what `pas slam` takes the depth of a recording for.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/support/program.h"

namespace {

using namespace program;
using testing::HasSubstr;

class SensorOption : public testing::Test {
 protected:
  static fs::path Scene() { return fs::path(PAS_SOURCE_DIR) / "scenes/ambiguous/desk.yaml"; }

  Outcome Pas(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), program::Pas().string());
    const Outcome outcome = Process(arguments, {}, folder_ / "errors").Wait();
    EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
    return outcome;
  }
  fs::path Record(const std::string& sensor) const {
    const fs::path sequence = folder_ / ("seq-" + sensor);
    Pas({"sim", Scene(), "-o", sequence, "--sensor", sensor, "--frames", "4"});
    return sequence;
  }
  /// The sensor in run.json.
  std::string Used(const std::string& run) const {
    return nlohmann::json::parse(
        ReadText(folder_ / run / "run.json"))["options"]["sensor"]["model"];
  }

  TemporaryFolder folder_;
};

TEST_F(SensorOption, IsToldByTheRecordingUnlessItIsNamed) {
  std::ofstream(folder_ / "config.yaml") << "sensor: {model: kinect1}\n";
  for (const std::string sensor : {"azure", "d435"}) {
    const fs::path sequence = Record(sensor);
    EXPECT_THAT(Pas({"slam", sequence, "-o", folder_ / sensor}).errors,
                HasSubstr("taken for " + sensor + ", as its noise tells ("));
    EXPECT_EQ(Used(sensor), sensor);

    const std::string doubt = "taken for kinect1; its noise is that of " + sensor + " (";
    EXPECT_THAT(
        Pas({"slam", sequence, "-o", folder_ / "named", "--force", "--sensor", "kinect1"})
            .errors,
        HasSubstr(doubt));
    EXPECT_EQ(Used("named"), "kinect1");
    EXPECT_THAT(Pas({"slam", sequence, "-o", folder_ / "named", "--force", "--config",
                     folder_ / "config.yaml"})
                    .errors,
                HasSubstr(doubt));
    EXPECT_EQ(Used("named"), "kinect1");
  }
}

TEST_F(SensorOption, IsTheFirstKinectWhereDepthDoesNotTell) {
  EXPECT_THAT(Pas({"slam", Record("ideal"), "-o", folder_ / "run"}).errors,
              HasSubstr("taken for kinect1; its noise tells no sensor ("));
  EXPECT_EQ(Used("run"), "kinect1");
  EXPECT_EQ(Pas({"-q", "slam", Record("kinect1-clean"), "-o", folder_ / "quiet"}).errors, "");
  EXPECT_EQ(Used("quiet"), "kinect1");
}

TEST_F(SensorOption, OfALiveSceneIsThatWhichIsSimulated) {
  std::ofstream(folder_ / "mine.yaml") << "base: d435\nname: mine\n";
  for (const auto& [simulated, used] : std::vector<std::pair<std::string, std::string>>{
           {"azure", "azure"}, {folder_ / "mine.yaml", "d435"}, {"ideal", "kinect1"}}) {
    Pas({"slam", "--live", Scene(), "-o", folder_ / "live", "--force", "--frames", "2",
         "--sim-sensor", simulated});
    EXPECT_EQ(Used("live"), used) << simulated;
  }
}

}  // namespace
