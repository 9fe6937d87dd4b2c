#include "slam/run/config_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <fstream>
#include <numbers>

#include "io/input_error.h"
#include "tests/support/temporary_folder.h"

namespace slam {
namespace {

using ::testing::ContainsRegex;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

class ConfigFile : public ::testing::Test {
 protected:
  Config Read(const std::string& text) {
    std::ofstream(file_) << text;
    return ReadConfig(file_);
  }
  void ExpectError(const std::string& text, const std::string& regex) {
    EXPECT_THAT([&] { Read(text); }, ThrowsMessage<io::InputError>(ContainsRegex(regex)))
        << text;
  }
  test_support::TemporaryFolder temporary_;
  const std::filesystem::path file_ = temporary_ / "settings.yaml";
};

TEST_F(ConfigFile, OfNothingGivesTheDefaults) {
  EXPECT_EQ(ConfigAsJson(Read("{}")), ConfigAsJson(Config{}));
  EXPECT_EQ(ConfigAsJson(Read("# only a comment\n")), ConfigAsJson(Config{}));
}

TEST_F(ConfigFile, IsNotAnEmptyFile) {
  ExpectError("", "settings.yaml:1: the file is empty; expected settings");
  ExpectError(" \n\t\r\n", "settings.yaml:1: the file is empty; expected settings");
}

TEST_F(ConfigFile, ReadsBackWhatItListsToTheSameValues) {
  Config config;
  config.box_tracks.min_match_iou = 0.123456789;
  config.box_tracks.enabled = false;
  config.point_features.count = 777;
  config.classes.regular = {"book", "odd: name, \"quoted\" #1"};
  EXPECT_EQ(ConfigAsJson(Read(ConfigAsYaml(config))), ConfigAsJson(config));
}

TEST_F(ConfigFile, ListsUnitDomainDefaultAndMeaningOfEachKey) {
  Config config;
  config.association.gates.max_normal_angle_rad = std::numbers::pi / 6;
  const std::string text = ConfigAsYaml(config);
  EXPECT_THAT(text, HasSubstr("    max_normal_angle_deg: 30  # degrees in (0, 180), default "
                              "9.998113525032865: largest angle between"));
  EXPECT_THAT(text, HasSubstr("  count: 1000  # whole number in [1, 10000], default 1000: "));
  EXPECT_THAT(text, HasSubstr("  model: kinect1  # kinect1 | azure | d435, default kinect1: "));
  EXPECT_THAT(text, HasSubstr("  async: false  # true or false, default false: "));
}

TEST(SettingsExample, OfTheDocumentationIsUpToDate) {
  std::ifstream file(std::string(PAS_SOURCE_DIR) + "/docs/settings.yaml");
  const std::string example{std::istreambuf_iterator<char>(file), {}};
  EXPECT_EQ(example, ConfigAsYaml(Config{}))
      << "mend with: pas config --sensor kinect1 > docs/settings.yaml";
}

TEST_F(ConfigFile, ChangesTheKeysItNamesAndNoOthers) {
  const Config config = Read("box_tracks:\n  min_hits: 5\npoint_features: {count: 1500}\n");
  EXPECT_EQ(config.box_tracks.min_hits, 5);
  EXPECT_EQ(config.point_features.count, 1500);
  auto expected = ConfigAsJson(Config{});
  expected["box_tracks"]["min_hits"] = 5;
  expected["point_features"]["count"] = 1500;
  EXPECT_EQ(ConfigAsJson(config), expected);
}

TEST_F(ConfigFile, HoldsAnglesInDegrees) {
  const Config config = Read("association: {gates: {max_normal_angle_deg: 30}}\n");
  EXPECT_NEAR(config.association.gates.max_normal_angle_rad, std::numbers::pi / 6, 1e-15);
  EXPECT_EQ(ConfigAsJson(config)["association"]["gates"]["max_normal_angle_deg"], 30.0);
}

TEST_F(ConfigFile, LeavesAnglesItDoesNotNameBitForBit) {
  EXPECT_EQ(Read("box_tracks: {min_hits: 5}").association.gates.max_normal_angle_rad,
            Config{}.association.gates.max_normal_angle_rad);
}

TEST_F(ConfigFile, OverridesTheListsOfClasses) {
  const Config config = Read("classes:\n  regular: [brick]\n");
  EXPECT_THAT(config.classes.regular, ElementsAre("brick"));
  EXPECT_EQ(config.classes.KindOf("book"), ClassKind::kOther);
  EXPECT_EQ(config.classes.KindOf("person"), ClassKind::kUnstructured);
  ExpectError("classes:\n  regular: [person]\n", "a class is both regular and unstructured");
  ExpectError("classes:\n  regular: brick\n",
              ":2: classes.regular: expected a list.*found `brick`");
}

TEST_F(ConfigFile, RefusesAnUnknownKeyAndListsTheLegalOnes) {
  ExpectError(
      "box_trax:\n  min_hits: 5\n",
      "yaml:1: unknown key `box_trax`; did you mean `box_tracks`. keys here: .*box_tracks");
  ExpectError("box_tracks:\n  min_hits: 5\n  min_hit: 5\n",
              "yaml:3: box_tracks: unknown key `min_hit`; did you mean `min_hits`. keys here: "
              "enabled, .*min_hits");
}

TEST_F(ConfigFile, RefusesAValueOutsideItsDomainOrOfAnotherType) {
  ExpectError("box_tracks:\n  min_hits: 0\n",
              "yaml:2: box_tracks.min_hits: expected a whole number in .1, 100., found `0`");
  ExpectError("box_tracks:\n  survival: nan\n",
              "yaml:2: box_tracks.survival: expected a number in .0, 1., found `nan`");
  ExpectError("box_tracks:\n  enabled: 1\n",
              "yaml:2: box_tracks.enabled: expected one of: false, true, found `1`");
  ExpectError("box_tracks: 3\n", "yaml:1: box_tracks: expected `key: value` lines, found `3`");
  ExpectError("box_tracks:\n  min_hits: 4\n  min_hits: 5\n",
              "yaml:3: key `min_hits` is given twice");
}

TEST_F(ConfigFile, TakesTheDefaultsOfTheSensorThatItNames) {
  Config d435 = ConfigFor(DepthSensor::kD435);
  EXPECT_EQ(d435.plane_extraction.joining.bend_ratio, 0.0);
  EXPECT_EQ(ConfigAsJson(Read("sensor: {model: d435}")), ConfigAsJson(d435));
  // What is set goes over them, whatever stands first.
  d435.sensor.noise.floor_m = 0.001;
  d435.plane_extraction.joining.bend_ratio = 0.001;
  EXPECT_EQ(ConfigAsJson(Read("plane_extraction: {joining: {bend_ratio: 0.001}}\n"
                              "sensor: {noise: {floor_m: 0.001}, model: d435}")),
            ConfigAsJson(d435));
  EXPECT_EQ(ConfigAsJson(Read(ConfigAsYaml(d435))), ConfigAsJson(d435));
  ExpectError("sensor: {model: kinect9}", "one of: kinect1, azure, d435, found `kinect9`");
}

TEST_F(ConfigFile, GoesOverTheSettingsThatItIsGiven) {
  const Config d435 = ConfigFor(DepthSensor::kD435);
  std::ofstream(file_) << "plane_extraction: {min_share: 0.01}\n";
  const Config config = ReadConfig(file_, d435);
  EXPECT_EQ(config.plane_extraction.min_share, 0.01);
  EXPECT_EQ(config.sensor.noise.correlated_px, d435.sensor.noise.correlated_px);
}

TEST_F(ConfigFile, RefusesSettingsThatContradictEachOther) {
  ExpectError("point_features: {fast_threshold: 5}\n", "min_fast_threshold must not be above");
  ExpectError("point_depth: {min_depth_m: 0.2, max_depth_m: 0.2}\n",
              "must be below max_depth_m");
  ExpectError("association: {max_chi2: 20, new_chi2: 19.9}\n",
              "max_chi2 must not be above new_chi2");
  ExpectError("yolox: {classes: []}\n", "yolox: classes must name at least one class");
  ExpectError("plane_processing: {vertices: {min_fill: 0.9, max_fill: 0.8}}\n",
              "vertices: min_fill must not be above max_fill");
  EXPECT_EQ(Read("association: {max_chi2: 20, new_chi2: 20}\n").association.max_chi2, 20.0);
}

}  // namespace
}  // namespace slam
