#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/families/families.h"
#include "sim/scene/geometry.h"
#include "sim/scene/read_scene.h"
#include "sim/scene/write_scene.h"
#include "tests/support/refusal.h"

namespace sim {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// A scene whose third line is `lights:`, with one line for each light.
std::string WithLights(const std::vector<std::string>& lights) {
  std::string text = "format: pas-scene/1\nname: test\nlights:\n";
  for (const std::string& light : lights) text += "  - {" + light + "}\n";
  return text +
         "objects:\n  - id: 1\n    name: a\n    class: book\n    role: regular\n"
         "    center_m: [0, 0, 0.5]\n    size_m: [1, 1, 1]\n";
}

std::string ErrorOf(const std::vector<std::string>& lights) {
  return test_support::RefusalOf([&] { ParseScene(WithLights(lights), "s.yaml"); });
}

const std::string kLamp = "kind: lamp, position_m: [0.1, 0.2, 1.7], intensity: 0.5";
const std::string kArea =
    "kind: area, center_m: [0, 0, 2], half_a_m: [0.4, 0, 0], half_b_m: [0, -0.2, 0], "
    "intensity: 1";

TEST(LightsInAFile, AreReadAsTheyStand) {
  const Scene scene = ParseScene(
      WithLights({kArea + ", samples_per_side: 7", kLamp + ", colour: [1, 0.8, 0.6]", kArea}),
      "s");
  ASSERT_EQ(scene.lights.size(), 3u);
  EXPECT_EQ(scene.lights[0].kind, LightKind::kArea);
  EXPECT_EQ(scene.lights[0].center_w, Eigen::Vector3d(0, 0, 2));
  EXPECT_EQ(scene.lights[0].half_a_w, Eigen::Vector3d(0.4, 0, 0));
  EXPECT_EQ(scene.lights[0].half_b_w, Eigen::Vector3d(0, -0.2, 0));
  EXPECT_EQ(scene.lights[0].samples_per_side, 7);
  EXPECT_EQ(scene.lights[1].kind, LightKind::kLamp);
  EXPECT_EQ(scene.lights[1].center_w, Eigen::Vector3d(0.1, 0.2, 1.7));
  EXPECT_EQ(scene.lights[1].intensity, 0.5);
  EXPECT_EQ(scene.lights[1].colour, (std::array{1.0, 0.8, 0.6}));
  EXPECT_EQ(scene.lights[2].samples_per_side, 4);
  EXPECT_EQ(scene.lights[2].colour, (std::array{1.0, 1.0, 1.0}));
}

TEST(LightsInAFile, AreGivenBackBitForBit) {
  const Scene scene = ParseScene(
      WithLights({kLamp + ", colour: [1, 0.8, 0.1]", kArea + ", samples_per_side: 9"}), "s");
  const std::string text = SceneText(scene);
  const Scene again = ParseScene(text, "text");
  EXPECT_EQ(SceneText(again), text);
  ASSERT_EQ(again.lights.size(), 2u);
  EXPECT_EQ(again.lights[1].samples_per_side, 9);
  EXPECT_EQ(again.lights[0].colour, scene.lights[0].colour);
  EXPECT_EQ(again.lights[1].half_b_w, scene.lights[1].half_b_w);
}

TEST(LightsInAFile, ArePartOfTheScenesHashAndLeaveNoTraceWhereThereAreNone) {
  const Scene lit = ParseScene(WithLights({kLamp}), "s");
  Scene brighter = lit, dark = lit;
  brighter.lights[0].intensity = 0.51;
  dark.lights.clear();
  EXPECT_NE(SceneHash(brighter), SceneHash(lit));
  EXPECT_EQ(SceneText(dark).find("lights"), std::string::npos);
}

TEST(LightsInAFile, AreRefusedWithTheirLineWhenTheyCannotBe) {
  const auto lamp = [](const std::string& rest) {
    return ErrorOf({kLamp, "kind: lamp, " + rest});
  };
  EXPECT_THAT(lamp("position_m: [0, 0, .nan], intensity: 1"),
              AllOf(HasSubstr("s.yaml:5"), HasSubstr("position_m")));
  EXPECT_THAT(lamp("position_m: [0, 0, 1], intensity: 0"),
              AllOf(HasSubstr("s.yaml:5"), HasSubstr("intensity")));
  EXPECT_THAT(lamp("position_m: [0, 0, 1], intensity: -1"), HasSubstr("intensity"));
  EXPECT_THAT(lamp("position_m: [0, 0, 1]"), HasSubstr(".intensity` is missing"));
  EXPECT_THAT(lamp("position_m: [0, 0, 1], intensity: 1, power_w: 60"),
              HasSubstr("unknown key `power_w`"));
  EXPECT_THAT(lamp("position_m: [0, 0, 1], intensity: 1, colour: [2, 0, 0]"),
              HasSubstr("linear RGB"));
  EXPECT_THAT(lamp("position_m: [0, 0, 1], intensity: 1, samples_per_side: 4"),
              AllOf(HasSubstr("s.yaml:5"), HasSubstr("kind: area")));
  EXPECT_THAT(ErrorOf({"kind: sun, position_m: [0, 0, 1], intensity: 1"}),
              HasSubstr("expected one of: lamp, area"));
}

TEST(LightsInAFile, AreRectangles) {
  const auto area = [](const std::string& b, const std::string& rest = "") {
    return ErrorOf({"kind: area, center_m: [0, 0, 2], half_a_m: [0.4, 0, 0], half_b_m: " + b +
                    ", intensity: 1" + rest});
  };
  EXPECT_EQ(area("[0, 0.1, 0.1]"), "");
  EXPECT_THAT(area("[0.1, 0.2, 0]"), AllOf(HasSubstr("s.yaml:4"), HasSubstr("not square")));
  EXPECT_THAT(area("[0, 0, 0]"), HasSubstr("0.1 mm or more"));
  EXPECT_THAT(area("[0, 0.1, 0]", ", samples_per_side: 17"), HasSubstr("samples_per_side"));
  EXPECT_THAT(area("[0, 0.1, 0]", ", position_m: [0, 0, 1]"), HasSubstr("name center_m"));
}

TEST(LightsInAFile, AreEightAtMost) {
  EXPECT_EQ(ErrorOf(std::vector<std::string>(8, kLamp)), "");
  EXPECT_THAT(ErrorOf(std::vector<std::string>(9, kLamp)), HasSubstr("at most 8"));
}

TEST(LampsOfAFamily, AddLightsAndChangeNothingElse) {
  for (const std::string family : {"desk", "office"}) {
    const Scene dark = MakeScene(family, 3, {{"objects", 20}});
    Scene lit = MakeScene(family, 3, {{"objects", 20}, {"lamps", 3}});
    ASSERT_EQ(lit.lights.size(), 3u);
    EXPECT_TRUE(dark.lights.empty());
    EXPECT_EQ(SceneText(ParseScene(SceneText(lit), "text")), SceneText(lit));
    lit.lights.clear();
    EXPECT_EQ(SceneText(lit), SceneText(dark));
  }
}

TEST(LampsOfAFamily, ShineInTheShadesOfDeskLampsFirst) {
  const Scene scene = MakeScene("desk", 1, {{"objects", 25}, {"lamps", 2}});
  const auto shade =
      std::find_if(scene.objects.begin(), scene.objects.end(), [](const Object& object) {
        return object.class_name == "lamp" && object.shape == ShapeKind::kBowl;
      });
  ASSERT_NE(shade, scene.objects.end());
  EXPECT_EQ(scene.lights[0].kind, LightKind::kLamp);
  EXPECT_LT(DistanceToBox(*shade, scene.lights[0].center_w), -0.03);
  EXPECT_EQ(scene.lights[1].kind, LightKind::kArea);
  EXPECT_GT(scene.lights[1].center_w.z(), scene.motion.target_w.z() + 1);
  const Light& panel = scene.lights[1];
  EXPECT_LT(panel.half_a_w.cross(panel.half_b_w).z(), 0) << "it shines down";
}

}  // namespace
}  // namespace sim
