#include "sim/scene/read_scene.h"
#include "sim/scene/write_scene.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include "io/input_error.h"
#include "sim/base/angle.h"
#include "sim/families/families.h"
#include "tests/support/refusal.h"
#include "tests/support/temporary_folder.h"

namespace sim {
namespace {

using testing::AllOf;
using testing::HasSubstr;

const std::string kHead = "format: pas-scene/1\nname: test\nobjects:\n";  // three lines

std::string Box(int id, const std::string& name, const std::string& rest) {
  return "  - id: " + std::to_string(id) + "\n    name: " + name +
         "\n    class: book\n    role: regular\n" + rest;
}

const std::string kPlaced = "    center_m: [0, 0, 0.5]\n    size_m: [1, 1, 1]\n";

std::string ErrorOf(const std::string& text) {
  return test_support::RefusalOf([&] { ParseScene(text, "s.yaml"); });
}

std::string SourcePath(const std::string& name) {
  return std::string(PAS_SOURCE_DIR) + "/" + name;
}

TEST(SceneFile, NamesTheLineOfAnUnknownKeyAndTheUnitThatIsMeant) {
  EXPECT_THAT(ErrorOf(kHead + Box(1, "a", kPlaced + "    size_mm: [1, 1, 1]\n")),
              AllOf(HasSubstr("s.yaml:10"), HasSubstr("unknown key `size_mm`"),
                    HasSubstr("did you mean `size_m`?")));
  EXPECT_THAT(ErrorOf("format: pas-scene/1\nname: test\ncolour: 1\nobjects: []\n"),
              AllOf(HasSubstr("s.yaml:3"), HasSubstr("unknown key `colour`")));
}

TEST(SceneFile, RefusesASingleFaceOfWhatHasOneMaterial) {
  const std::string face = "    faces: {+z: {print: cover}}\n";
  EXPECT_EQ(ErrorOf(kHead + Box(1, "a", kPlaced + face)), "");
  EXPECT_THAT(ErrorOf(kHead + Box(1, "a", kPlaced + "    shape: cylinder\n" + face)),
              AllOf(HasSubstr("s.yaml:11"), HasSubstr("one material, `all`")));
}

TEST(SceneFile, RefusesANameThatYamlTakesForNothing) {
  EXPECT_THAT(ErrorOf(kHead + Box(1, "\"null\"", kPlaced)), HasSubstr("s.yaml:5"));
}

TEST(SceneFile, RefusesAKeyThatStandsTwice) {
  EXPECT_THAT(ErrorOf(kHead + Box(1, "a", kPlaced + "    role: regular\n")),
              AllOf(HasSubstr("s.yaml:10"), HasSubstr("key `role` is given twice")));
}

TEST(SceneFile, RefusesAnotherFormatOrVersion) {
  EXPECT_THAT(ErrorOf("format: pas-scene/2\nname: a\nobjects: []\n"),
              AllOf(HasSubstr("s.yaml:1"), HasSubstr("pas-scene/1")));
  EXPECT_THAT(ErrorOf("name: a\nobjects: []\n"), HasSubstr("key `format` is missing"));
}

TEST(SceneFile, RefusesRepeatedIdsAndNames) {
  const std::string apart = "    center_m: [5, 0, 0.5]\n    size_m: [1, 1, 1]\n";
  EXPECT_THAT(ErrorOf(kHead + Box(1, "a", kPlaced) + Box(1, "b", apart)),
              AllOf(HasSubstr("s.yaml:10"), HasSubstr("id 1 belongs to 'a'")));
  EXPECT_THAT(ErrorOf(kHead + Box(1, "a", kPlaced) + Box(2, "a", apart)),
              AllOf(HasSubstr("s.yaml:10"), HasSubstr("name 'a' is taken")));
}

TEST(SceneFile, RefusesNumbersThatAreNone) {
  for (const char* bad : {"0.5m", ".nan", ".inf", "'1'", "1e999", "0x10", "", "~", "[1]"}) {
    const std::string text = kHead + Box(1, "a",
                                         "    center_m: [0, 0, 0.5]\n    size_m: [1, 1, " +
                                             std::string(bad) + "]\n");
    EXPECT_THAT(ErrorOf(text), AllOf(HasSubstr("s.yaml:9"), HasSubstr("size_m"))) << bad;
  }
}

TEST(SceneFile, RefusesSizesThatNoSolidHas) {
  for (const char* bad : {"0", "-0.1", "1000"}) {
    const std::string text = kHead + Box(1, "a",
                                         "    center_m: [0, 0, 0.5]\n    size_m: [1, 1, " +
                                             std::string(bad) + "]\n");
    EXPECT_THAT(ErrorOf(text), AllOf(HasSubstr("s.yaml:9"), HasSubstr("metres"))) << bad;
  }
}

TEST(SceneFile, RefusesObjectsInOnePlaceAndSaysHowDeep) {
  const std::string inside = "    center_m: [0.9, 0, 0.5]\n    size_m: [1, 1, 1]\n";
  EXPECT_THAT(ErrorOf(kHead + Box(1, "a", kPlaced) + Box(2, "b", inside)),
              AllOf(HasSubstr("s.yaml:10"), HasSubstr("'b' and 'a' are 100 mm inside")));
  const std::string touching = "    center_m: [1, 0, 0.5]\n    size_m: [1, 1, 1]\n";
  EXPECT_EQ(ErrorOf(kHead + Box(1, "a", kPlaced) + Box(2, "b", touching)), "");
}

TEST(SceneFile, RefusesAnObjectBelowTheFloor) {
  EXPECT_THAT(
      ErrorOf(kHead + Box(1, "a", "    center_m: [0, 0, 0.4]\n    size_m: [1, 1, 1]\n")),
      AllOf(HasSubstr("s.yaml:4"), HasSubstr("'a' reaches 100 mm below the floor")));
}

TEST(SceneFile, RefusesWhatIsNotPlainYaml) {
  EXPECT_THAT(ErrorOf(""), HasSubstr("the file is empty"));
  EXPECT_THAT(ErrorOf("a: [1, 2\nb: }"), HasSubstr("not valid YAML"));
  EXPECT_THAT(ErrorOf("- 1\n"), HasSubstr("expected `key: value` lines"));
  EXPECT_THAT(ErrorOf("a: &x 1\nb: *x\n"), HasSubstr("anchors"));
  EXPECT_THAT(ErrorOf("a: 1\n---\nb: 2\n"), HasSubstr("more than one"));
  EXPECT_THAT(ErrorOf(std::string(100000, '[')), HasSubstr("nested deeper"));
}

TEST(SceneFile, RefusesAMotionThatContradictsItself) {
  const std::string motion = "motion:\n  preset: office\n  distance_min_m: 2\n";
  EXPECT_THAT(
      ErrorOf("format: pas-scene/1\nname: a\n" + motion + "objects:\n" + Box(1, "a", kPlaced)),
      AllOf(HasSubstr("s.yaml:5"), HasSubstr("exceeds its maximum")));
  EXPECT_THAT(ErrorOf("format: pas-scene/1\nname: a\nmotion:\n  preset: quick\nobjects: []\n"),
              AllOf(HasSubstr("s.yaml:4"), HasSubstr("slow, office, fast")));
}

TEST(SceneFile, RefusesAWayThatIsInTwoPlacesAtOnce) {
  const auto way = [](const std::string& second_s) {
    return kHead + Box(1, "a",
                       "    size_m: [1, 1, 1]\n    way:\n"
                       "      - {time_s: 1, center_m: [0, 0, 0.5]}\n"
                       "      - {time_s: " +
                           second_s + ", center_m: [0, 1, 0.5]}\n");
  };
  EXPECT_EQ(ErrorOf(way("1.5")), "");
  for (const char* second_s : {"1", "0.5"})
    EXPECT_THAT(ErrorOf(way(second_s)), HasSubstr("is not after the one before"));
}

TEST(SceneFile, RefusesARotationGivenTwiceOrNotUnit) {
  EXPECT_THAT(
      ErrorOf(kHead +
              Box(1, "a", kPlaced + "    rpy_deg: [0, 0, 1]\n" + "    q_xyzw: [0, 0, 0, 1]\n")),
      HasSubstr("keep one"));
  EXPECT_THAT(ErrorOf(kHead + Box(1, "a", kPlaced + "    q_xyzw: [0, 0, 0.5, 0.5]\n")),
              AllOf(HasSubstr("s.yaml:10"), HasSubstr("unit quaternion")));
}

TEST(SceneFile, RefusesFilesThatAreTooLargeOrNotThere) {
  EXPECT_THROW(ReadScene("/nonexistent/scene.yaml"), io::InputError);
  const test_support::TemporaryFolder folder;
  EXPECT_THROW(ReadScene(folder.path()), io::InputError);
  const std::filesystem::path path = folder / "too_large.yaml";
  std::ofstream(path) << std::string((1 << 20) + 1, '#');
  EXPECT_THROW(ReadScene(path), io::InputError);
}

TEST(SceneFile, ReadsAnglesInDegreesAndLengthsInMetres) {
  const Scene scene =
      ParseScene(kHead + Box(1, "a", kPlaced + "    rpy_deg: [0, 0, 90]\n"), "s");
  const Eigen::Matrix3d R = scene.objects[0].q_wo.toRotationMatrix();
  EXPECT_LT((R * Eigen::Vector3d::UnitX() - Eigen::Vector3d::UnitY()).norm(), 1e-15);
  EXPECT_EQ(scene.objects[0].size, Eigen::Vector3d::Ones());
}

TEST(SceneFile, GivesBackEveryGeneratedSceneBitForBit) {
  for (const Family& family : Families()) {
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
      const Scene made = MakeScene(family.name, seed);
      const Scene read = ParseScene(SceneText(made), "text");
      EXPECT_EQ(SceneText(read), SceneText(made));
      ASSERT_EQ(read.objects.size(), made.objects.size());
      for (std::size_t i = 0; i < read.objects.size(); ++i) {
        EXPECT_EQ(read.objects[i].center_w, made.objects[i].center_w);
        EXPECT_EQ(read.objects[i].q_wo.coeffs(), made.objects[i].q_wo.coeffs());
        EXPECT_EQ(read.objects[i].size, made.objects[i].size);
        EXPECT_EQ(read.objects[i].seed, made.objects[i].seed);
      }
      EXPECT_EQ(read.motion.azimuth_min_rad, made.motion.azimuth_min_rad);
      EXPECT_EQ(read.motion.pitch_max_rad, made.motion.pitch_max_rad);
    }
  }
}

TEST(SceneFile, GivesBackARotationThatNoRoundAngleMakes) {
  Scene scene = MakeScene("plates", 1);
  scene.objects[2].q_wo = Eigen::Quaterniond(0.9, 0.01, -0.02, 0.43).normalized();
  scene.objects[2].center_w.z() += 1;
  const Scene read = ParseScene(SceneText(scene), "text");
  EXPECT_EQ(read.objects[2].q_wo.coeffs(), scene.objects[2].q_wo.coeffs());
}

TEST(SceneFile, TellsALensOfZerosFromOneThatIsLeftOut) {
  Scene scene = MakeScene("plates", 1);
  scene.capture.emplace();
  EXPECT_FALSE(ParseScene(SceneText(scene), "text").capture->distortion.has_value());
  for (const double k1 : {0.0, 0.2}) {
    scene.capture->distortion = {k1, 0, 0, 0, 0};
    EXPECT_EQ(ParseScene(SceneText(scene), "text").capture->distortion,
              scene.capture->distortion);
  }
}

TEST(SceneFile, IsWrittenWholeAndReadBackFromDisk) {
  const test_support::TemporaryFolder folder;
  const std::filesystem::path path = folder / "round_trip.yaml";
  const Scene made = MakeScene("stack", 3);
  WriteScene(made, path);
  EXPECT_EQ(SceneHash(ReadScene(path)), SceneHash(made));
  EXPECT_FALSE(std::filesystem::exists(path.string() + ".part"));
  EXPECT_THROW(WriteScene(made, "/nonexistent/folder/scene.yaml"), io::InputError);
}

TEST(SceneFile, TakesTheColoursOfAMaterialThatItLeavesOut) {
  const auto material = [](const std::string& colours) {
    const std::string faces = "    faces: {all: {print: text" + colours + "}}\n";
    return ParseScene(kHead + Box(1, "a", kPlaced + faces), "s").objects[0].faces[0];
  };
  const std::array light{0.7, 0.7, 0.7}, dark{0.1, 0.1, 0.1};  // so that a print shows
  const Material neither = material(""), paper = material(", colour: [0.9, 0.8, 0.2]"),
                 ink = material(", ink: [0.2, 0, 0.5]");
  EXPECT_EQ(neither.colour, light);
  EXPECT_EQ(neither.ink, dark);
  EXPECT_EQ(paper.colour, (std::array{0.9, 0.8, 0.2}));
  EXPECT_EQ(paper.ink, dark);
  EXPECT_EQ(ink.colour, light);
  EXPECT_EQ(ink.ink, (std::array{0.2, 0.0, 0.5}));
}

TEST(SceneFile, KeepsWhatAMaterialIsToDepthSensors) {
  Scene scene = MakeScene("plates", 1);
  scene.objects[0].faces[2].infrared = 0.25;
  scene.objects[0].faces[2].gloss = 0.5;
  const Scene read = ParseScene(SceneText(scene), "text");
  EXPECT_EQ(read.objects[0].faces[2].infrared, 0.25);
  EXPECT_EQ(read.objects[0].faces[2].gloss, 0.5);
  EXPECT_FALSE(read.objects[0].faces[3].gloss.has_value());
  EXPECT_THAT(
      ErrorOf(kHead + Box(1, "a", kPlaced + "    faces: {all: {print: text, gloss: 2}}\n")),
      HasSubstr("gloss"));
}

TEST(SceneFile, ReadsEveryCommittedScene) {
  int count = 0;
  for (const auto& entry :
       std::filesystem::recursive_directory_iterator(SourcePath("scenes"))) {
    if (entry.path().extension() != ".yaml") continue;
    EXPECT_NO_THROW(ReadScene(entry.path())) << entry.path();
    ++count;
  }
  EXPECT_GE(count, 5);
}

TEST(SceneFile, CommittedDeskIsSeedOneOfItsFamily) {
  EXPECT_EQ(SceneText(ReadScene(SourcePath("scenes/ambiguous/desk.yaml"))),
            SceneText(MakeScene("desk", 1)));
}

TEST(SceneHash, ChangesWithTheLastBitOfAnyLength) {
  Scene scene = MakeScene("plates", 1);
  const std::string before = SceneHash(scene);
  scene.objects[1].size.x() = std::nextafter(scene.objects[1].size.x(), 1.0);
  EXPECT_NE(SceneHash(scene), before);
}

}  // namespace
}  // namespace sim
