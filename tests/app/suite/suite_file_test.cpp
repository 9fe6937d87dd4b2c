#include "app/suite/suite_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/program.h"
#include "tests/support/refusal.h"

namespace app {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class SuiteFiles : public testing::Test {
 protected:
  SuiteFile Read(const std::string& text) const {
    std::ofstream(folder_ / "suite.yaml") << "format: pas-suite/1\nname: s\n" << text;
    return ReadSuite(folder_ / "suite.yaml");
  }
  std::string Refusal(const std::string& text) const {
    return test_support::RefusalOf([&] { Read(text); });
  }

  program::TemporaryFolder folder_;
};

TEST_F(SuiteFiles, HaveADefaultForAllButTheirScenes) {
  const SuiteFile suite = Read("scenes: [{family: desk}]\n");
  EXPECT_EQ(suite.frames, std::nullopt);
  EXPECT_EQ(suite.sensors.front().name, "kinect1");
  EXPECT_THAT(suite.motions, ElementsAre("own"));
  EXPECT_THAT(suite.variants, ElementsAre("full"));
  EXPECT_EQ(suite.configs.front().name, "default");
  EXPECT_EQ(suite.seeds.max_count, 1);
}

TEST_F(SuiteFiles, LetRecordingsTellTheirSensorUnlessTheySay) {
  EXPECT_EQ(Read("scenes: [{recordings: all}]\n").scenes[0].sensor, "auto");
  EXPECT_EQ(Read("scenes: [{recordings: all, sensor: d435}]\n").scenes[0].sensor, "d435");
}

TEST_F(SuiteFiles, TakeTheCameraOfRecordingsByNameOrAsAFileBesideThem) {
  EXPECT_EQ(Read("scenes: [{recordings: all}]\n").scenes[0].camera.name, "tum1");
  const SuiteChoice named =
      Read("scenes: [{recordings: all, camera: tum3}]\n").scenes[0].camera;
  EXPECT_EQ(named.name, "tum3");
  EXPECT_EQ(named.file, "");
  std::ofstream(folder_ / "cam.yaml") << "fx: 525\n";
  EXPECT_TRUE(program::fs::equivalent(
      Read("scenes: [{recordings: all, camera: cam.yaml}]\n").scenes[0].camera.file,
      folder_ / "cam.yaml"));
  EXPECT_THAT(Refusal("scenes: [{recordings: all, camera: tum9}]\n"),
              HasSubstr("camera: expected tum1, tum2, tum3 or a file"));
}

TEST_F(SuiteFiles, GiveEachKeyItsValue) {
  std::ofstream(folder_ / "noisy.yaml") << "base: azure\n";
  const SuiteFile suite = Read(
      "frames: 30\nsize_px: [160, 120]\nseeds: {first: 7, count: 2, max_count: 5}\n"
      "limits: {seconds: 2.5, memory_mb: 300}\n"
      "scenes:\n  - {family: plates, set: {step_mm: 5}, name: thin}\n  - {twin: fr1-xyz, "
      "frames: 9}\n"
      "sensors: [d435, {name: noisy, file: noisy.yaml, estimator: azure}]\n"
      "motions: [own, fast]\nvariants: [points, full]\n"
      "gate: {alpha: 0.02, times: false, undecided: passes, variants: [full],\n"
      "       worst: {/trajectory/ate_se3/rmse_m: 0.05}}\n");
  EXPECT_EQ(suite.frames, 30);
  EXPECT_EQ(suite.width, 160);
  EXPECT_EQ(suite.seeds.first, 7u);
  EXPECT_EQ(suite.limits.seconds, 2.5);
  EXPECT_EQ(suite.scenes[0].name, "thin");
  EXPECT_EQ(suite.scenes[0].parameters.at("step_mm"), 5.0);
  EXPECT_EQ(suite.scenes[1].frames, 9);
  EXPECT_EQ(suite.sensors[0].estimator, "d435");
  EXPECT_EQ(suite.sensors[1].estimator, "azure");
  EXPECT_TRUE(suite.gate.undecided_passes);
  EXPECT_EQ(suite.gate.worst.at("/trajectory/ate_se3/rmse_m"), 0.05);
  EXPECT_THAT(suite.gated_variants, ElementsAre("full"));
}

TEST_F(SuiteFiles, AreRefusedWithTheLineAndHowToMendIt) {
  EXPECT_THAT(Refusal("scene: []\n"),
              HasSubstr("suite.yaml:3: unknown key `scene`; did you mean `scenes`?"));
  EXPECT_THAT(Refusal("scenes: []\n"), HasSubstr("names no scene"));
  EXPECT_THAT(Refusal("frames: 3\n"), HasSubstr("key `scenes` is missing"));
  EXPECT_THAT(Refusal("scenes: [{family: dask}]\n"),
              HasSubstr("scenes[0].family: expected one of: desk"));
  EXPECT_THAT(Refusal("scenes: [{}]\n"), HasSubstr("scenes[0]"));
  EXPECT_THAT(Refusal("scenes: [{family: desk, twin: fr1-xyz}]\n"),
              HasSubstr("expected one of family"));
  EXPECT_THAT(Refusal("scenes: [{family: desk}, {family: desk}]\n"),
              HasSubstr("give this one a name"));
  EXPECT_THAT(Refusal("scenes: [{recordings: all}, {recordings: all}]\n"),
              HasSubstr("the recordings are named already"));
  EXPECT_THAT(Refusal("scenes: [{recordings: all, name: mine}]\n"),
              HasSubstr("names of their own"));
  EXPECT_THAT(Refusal("scenes: [{family: desk, set: {stepp: 1}}]\n"),
              HasSubstr("unknown key `stepp`"));
  EXPECT_THAT(Refusal("scenes: [{family: plates, set: {step_mm: 999}}]\n"),
              HasSubstr("[0, 200]"));
  EXPECT_THAT(Refusal("scenes: [{file: none.yaml}]\n"), HasSubstr("none.yaml is no file"));
  EXPECT_THAT(Refusal("scenes: [{family: desk, camera: tum1}]\n"),
              HasSubstr("for recordings only"));
  const std::string desk = "scenes: [{family: desk}]\n";
  EXPECT_THAT(Refusal(desk + "sensors: [kinect2]\n"),
              HasSubstr("sensors[0]: expected one of: ideal"));
  EXPECT_THAT(Refusal(desk + "sensors: [azure, azure]\n"), HasSubstr("gives azure twice"));
  EXPECT_THAT(Refusal(desk + "sensors: []\n"), HasSubstr("is empty"));
  EXPECT_THAT(Refusal(desk + "variants: [all]\n"), HasSubstr("expected one of: full"));
  EXPECT_THAT(Refusal(desk + "motions: [jump]\n"), HasSubstr("expected one of: slow"));
  EXPECT_THAT(Refusal(desk + "seeds: {count: 3, max_count: 2}\n"),
              HasSubstr("less than count"));
  EXPECT_THAT(Refusal(desk + "size_px: [320]\n"), HasSubstr("[width, height]"));
  EXPECT_THAT(Refusal(desk + "limits: {seconds: 0}\n"), HasSubstr("a number in"));
  EXPECT_THAT(Refusal(desk + "gate: {worst: {/ate: 1}}\n"), HasSubstr("unknown key `/ate`"));
  EXPECT_THAT(Refusal(desk + "gate: {variants: [points]}\n"),
              HasSubstr("expected one of: full"));
  EXPECT_THAT(Refusal(desk + "configs: [{name: a/b, file: x}]\n"),
              HasSubstr("names have no '/'"));
}

}  // namespace
}  // namespace app
