#include "sim/sensor/read_sensor.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <iterator>
#include <map>
#include <sstream>

#include "io/input_error.h"
#include "tests/support/refusal.h"

namespace sim {
namespace {

using testing::HasSubstr;

std::string ErrorOf(const std::string& text) {
  return test_support::RefusalOf([&] { ParseSensor(text, "mine.yaml"); });
}

TEST(SensorFile, ChangesWhatItNamesAndKeepsTheRest) {
  const Sensor sensor = ParseSensor(
      "base: azure\nname: my tof\nwiggle_m: 0\nhexagon: 0\ncolour_gamma: 1.8\n", "mine.yaml");
  const auto& azure = std::get<AzureModel>(sensor.depth);
  EXPECT_EQ(sensor.name, "my tof");
  EXPECT_EQ(azure.wiggle_m, 0.0);
  EXPECT_FALSE(azure.hexagon);
  EXPECT_EQ(azure.multipath_m, AzureModel{}.multipath_m);
  EXPECT_EQ(sensor.colour.gamma, 1.8);
  EXPECT_EQ(sensor.changed.size(), 3U);
}

TEST(SensorFile, TakesAnglesInDegrees) {
  const Sensor sensor =
      ParseSensor("base: kinect1\nmax_incidence_deg: 70\nmirror_spot_deg: 4\n", "mine.yaml");
  const auto& kinect = std::get<KinectModel>(sensor.depth);
  EXPECT_NEAR(kinect.max_incidence_rad, 70 * M_PI / 180, 1e-15);
  EXPECT_NEAR(kinect.loss.mirror_spot_rad, 4 * M_PI / 180, 1e-15);
}

TEST(SensorFile, TellsTheTwoTangentialTermsOfALensApart) {
  const auto bent = [](const std::string& line) {
    return ParseSensor("base: ideal\n" + line, "mine.yaml").lens.Distort({0, 0.5});
  };
  // At x = 0, r^2 is y^2: p1 shifts by 3 p1 y^2 along y, p2 by p2 y^2 along x.
  EXPECT_LT((bent("lens_p1: 0.04\n") - Eigen::Vector2d(0, 0.5 + 0.03)).norm(), 1e-15);
  EXPECT_LT((bent("lens_p2: 0.04\n") - Eigen::Vector2d(0.01, 0.5)).norm(), 1e-15);
}

TEST(SensorFile, RefusesAnUnknownKeyAndSaysWhere) {
  const std::string error = ErrorOf("base: d435\nsubpixel_px: 0.1\nbaselin_m: 0.1\n");
  EXPECT_THAT(error, HasSubstr("mine.yaml:3"));
  EXPECT_THAT(error, HasSubstr("baselin_m"));
  EXPECT_THAT(error, HasSubstr("baseline_m"));
}

TEST(SensorFile, RefusesAParameterOfAnotherBase) {
  EXPECT_THAT(ErrorOf("base: kinect1\nwiggle_m: 0\n"), HasSubstr("mine.yaml:2"));
  EXPECT_THAT(ErrorOf("base: ideal\nnoise_scale: 2\n"), HasSubstr("mine.yaml:2"));
}

TEST(SensorFile, RefusesValuesOutOfRange) {
  EXPECT_THAT(ErrorOf("base: azure\nreflectivity: 1.5\n"), HasSubstr("mine.yaml:2"));
  EXPECT_THAT(ErrorOf("base: azure\nreflectivity: .nan\n"), HasSubstr("mine.yaml:2"));
  EXPECT_THAT(ErrorOf("base: d435\nwindow_px: 6\n"), HasSubstr("odd"));
  // gt/depth_warp.png would be cut off.
  EXPECT_THAT(ErrorOf("base: azure\nbend_rms: 0.009\n"), HasSubstr("mine.yaml:2"));
}

TEST(SensorFile, RefusesARangeThatLeavesNoDepth) {
  EXPECT_THAT(ErrorOf("base: kinect1-clean\nmin_depth_m: 5\n"),
              testing::AllOf(HasSubstr("mine.yaml:2"), HasSubstr("not below max_depth_m")));
  EXPECT_THAT(ErrorOf("base: d435\nmax_depth_m: 0.2\n"), HasSubstr("mine.yaml:2"));
}

TEST(SensorFile, RefusesFractionsOfWhatIsCountedOrSwitched) {
  for (const char* line : {"base: d435\nwindow_px: 4.6\n", "base: kinect1\nwindow_px: 0.4\n",
                           "base: kinect1\ndevice: 1.5\n", "base: kinect1\nquantise: 0.5\n"}) {
    EXPECT_THAT(ErrorOf(line),
                testing::AllOf(HasSubstr("mine.yaml:2"), HasSubstr("whole number")));
  }
}

TEST(SensorFile, RefusesAWindowWithoutACentreButNotNone) {
  for (const std::string base : {"kinect1", "d435"}) {
    for (const int side_px : {2, 4, 30}) {
      EXPECT_THAT(ErrorOf("base: " + base + "\nwindow_px: " + std::to_string(side_px) + "\n"),
                  testing::AllOf(HasSubstr("mine.yaml:2"), HasSubstr("odd")));
    }
  }
  const Sensor none = ParseSensor("base: kinect1\nwindow_px: 0\n", "mine.yaml");
  EXPECT_EQ(std::get<KinectModel>(none.depth).window.side_px, 0);
}

TEST(SensorFile, TakesTimesInMilliseconds) {
  const Sensor sensor = ParseSensor(
      "base: ideal\nshutter_ms: 12\nrolling_ms: 25\ndepth_offset_ms: 8\nstamp_jitter_ms: 3\n",
      "mine.yaml");
  EXPECT_NEAR(sensor.exposure.shutter_s, 0.012, 1e-15);
  EXPECT_NEAR(sensor.exposure.rolling_s, 0.025, 1e-15);
  EXPECT_NEAR(sensor.timing.depth_offset_s, 0.008, 1e-15);
  EXPECT_NEAR(sensor.timing.stamp_jitter_s, 0.003, 1e-15);
}

TEST(SensorFile, RefusesAMissingOrUnknownBase) {
  EXPECT_THAT(ErrorOf("noise_scale: 1\n"), HasSubstr("base"));
  EXPECT_THAT(ErrorOf("base: kinect3\n"), HasSubstr("mine.yaml:1"));
  EXPECT_THAT(ErrorOf("- 1\n"), HasSubstr("mine.yaml:1: expected `key: value` lines"));
  EXPECT_THAT(ErrorOf(""), HasSubstr("mine.yaml:1: key `base` is missing"));
}

TEST(SensorFile, CanSetEveryParameterThatIsListed) {
  for (const char* base : {"kinect1", "azure", "d435"}) {
    const std::vector<SensorParameter> usual = Parameters(SensorByName(base));
    for (const SensorParameter& parameter : usual) {
      const std::string value = parameter.key == "window_px"     ? "5"
                                : parameter.key == "min_depth_m" ? "0.3"  // below the largest
                                : parameter.key == "max_depth_m"
                                    ? "9"
                                    : std::to_string(parameter.high);
      const Sensor sensor =
          ParseSensor(std::string("base: ") + base + "\n" + parameter.key + ": " + value + "\n",
                      "mine.yaml");
      const std::vector<SensorParameter> now = Parameters(sensor);
      ASSERT_EQ(now.size(), usual.size());
      for (std::size_t i = 0; i < now.size(); ++i) {
        const double expected = now[i].key == parameter.key ? std::stod(value) : usual[i].value;
        EXPECT_NEAR(now[i].value, expected, 1e-9) << now[i].key << " with " << parameter.key;
      }
    }
  }
}

/// Files of users name these keys: none may go, or change its meaning from base to base.
TEST(SensorFile, KnowsTheKeysThatItHasAlwaysKnown) {
  const std::string any =
      "colour_shot_variance colour_read_sigma colour_corner_loss colour_gamma "
      "colour_reflections "
      "shutter_ms rolling_ms exposure_drift_stops drop_ratio repeat_ratio depth_offset_ms "
      "stamp_jitter_ms registration_px intrinsics_error lens_k1 lens_k2 lens_p1 lens_p2 "
      "lens_k3 ";
  const std::string bend = "bend_rms bend_drift_share device ";
  const std::string loss = "min_return_per_m2 return_spread_ln mirror_spot_deg ";
  const std::map<std::string, std::string> keys = {
      {"kinect1", any + bend + loss +
                      "disparity_m_steps projector_offset_m min_depth_m max_depth_m "
                      "max_incidence_deg noise_scale lateral_scale quantise window_px "
                      "window_min_share window_dots window_max_apart_steps"},
      {"azure", any + bend + loss +
                    "min_depth_m max_depth_m noise_scale reflectivity lateral_px flying_pixels "
                    "max_mixed_m min_mixed_share multipath_m multipath_reach_m multipath_loss "
                    "wiggle_m wiggle_period_m session_offset_m hexagon rounding_m"},
      {"d435",
       any + bend +
           "focal_baseline_px_m baseline_m subpixel_px correlated_share window_px grid_px "
           "ripple_px fattening_px max_mixed_px min_share min_depth_m max_depth_m "
           "rounding_m"},
      {"ideal", any}};
  for (const auto& [base, words] : keys) {
    std::istringstream in(words);
    const std::vector<std::string> expected(std::istream_iterator<std::string>(in), {});
    std::vector<std::string> known;
    for (const SensorParameter& parameter : Parameters(SensorByName(base)))
      known.push_back(parameter.key);
    EXPECT_THAT(known, testing::UnorderedElementsAreArray(expected)) << base;
  }
}

TEST(SensorName, MayBeAFileThatMustExist) {
  EXPECT_EQ(SensorByName("azure").name, "azure");
  EXPECT_THROW(SensorByName("no/such/file.yaml"), io::InputError);
  EXPECT_THROW(SensorByName("kinect"), io::InputError);
}

}  // namespace
}  // namespace sim
