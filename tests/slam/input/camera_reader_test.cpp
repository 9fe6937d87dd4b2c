#include "slam/input/camera_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <fstream>

#include "io/input_error.h"
#include "tests/support/temporary_folder.h"

namespace slam {
namespace {

using ::testing::ContainsRegex;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::ThrowsMessage;

const std::string kGood =
    "model: pinhole\nwidth: 320\nheight: 240\nfx: 260.5\nfy: 261\ncx: 159.5\ncy: 119.5\n"
    "depth_factor: 1000\n";

class CameraReader : public ::testing::Test {
 protected:
  CameraFile ReadFile(const std::string& text) {
    std::ofstream(folder_ / "camera.yaml") << text;
    return ReadCamera(folder_ / "camera.yaml");
  }
  Camera Read(const std::string& text) { return ReadFile(text).camera; }
  void ExpectError(const std::string& text, const std::string& regex) {
    EXPECT_THAT([&] { Read(text); }, ThrowsMessage<io::InputError>(ContainsRegex(regex)))
        << text;
  }
  test_support::TemporaryFolder temporary_;
  const std::filesystem::path folder_ = temporary_.path();
};

TEST_F(CameraReader, ReadsEveryKey) {
  const Camera c = Read(kGood +
                        "fps: 15\nk1: 0.1\nk2: -0.2\np1: 0.001\np2: 0.002\n"
                        "k3: 0.03\n");
  EXPECT_EQ(c.width, 320);
  EXPECT_EQ(c.height, 240);
  EXPECT_EQ(c.fx, 260.5);
  EXPECT_EQ(c.fy, 261.0);
  EXPECT_EQ(c.cx, 159.5);
  EXPECT_EQ(c.cy, 119.5);
  EXPECT_EQ(c.fps, 15.0);
  EXPECT_EQ(c.depth_factor, 1000.0);
  EXPECT_EQ(c.k1, 0.1);
  EXPECT_EQ(c.k2, -0.2);
  EXPECT_EQ(c.p1, 0.001);
  EXPECT_EQ(c.p2, 0.002);
  EXPECT_EQ(c.k3, 0.03);
}

TEST_F(CameraReader, RefusesAnUnknownKeyAndListsTheLegalOnes) {
  ExpectError(kGood + "focal: 3\n",
              "camera.yaml:9: unknown key `focal`; keys here: model, width, height, fx");
}

TEST_F(CameraReader, RefusesAMissingKey) {
  ExpectError("width: 320\nheight: 240\nfx: 260\n",
              "camera.yaml:1: key `fy` is missing; expected a number in .1, 100000.");
  ExpectError("", "camera.yaml:1: the file is empty; expected .*width");
}

TEST_F(CameraReader, RefusesACameraWithoutTheUnitOfDepth) {
  ExpectError("model: pinhole\nwidth: 320\nheight: 240\nfx: 260\nfy: 261\ncx: 159\ncy: 119\n",
              "camera.yaml:1: key `depth_factor` is missing; expected .*1000 for millimetres");
}

TEST_F(CameraReader, WarnsWhenTheModelOrTheRateIsMissing) {
  EXPECT_THAT(ReadFile(kGood + "fps: 15\n").warnings, IsEmpty());
  EXPECT_THAT(ReadFile(kGood).warnings,
              ElementsAre(ContainsRegex("camera.yaml: key `fps` is missing; 30")));
  const std::string no_model = kGood.substr(kGood.find('\n') + 1);
  EXPECT_THAT(ReadFile(no_model + "fps: 15\n").warnings,
              ElementsAre(ContainsRegex("key `model` is missing; `pinhole`")));
}

TEST_F(CameraReader, RefusesValuesOutsideTheirDomain) {
  const auto with = [](const std::string& key, const std::string& value) {
    std::string text = kGood;
    const std::size_t at = text.find(key + ":");
    return text.replace(at, text.find('\n', at) - at, key + ": " + value);
  };
  ExpectError(with("fx", "0"),
              "camera.yaml:4: fx: expected a number in .1, 100000., found `0`");
  ExpectError(with("fx", "-525"), "camera.yaml:4: fx: expected .*found `-525`");
  ExpectError(with("fx", "nan"), "fx: expected a number .*found `nan`");
  ExpectError(with("fx", ".inf"), "fx: expected a number .*found `.inf`");
  ExpectError(with("fx", "525px"), "fx: expected a number .*found `525px`");
  ExpectError(with("fx", "[1, 2]"), "fx: expected a number .*found a list");
  ExpectError(with("width", "0"), "camera.yaml:2: width: expected a whole number .*found `0`");
  ExpectError(with("width", "1000000"),
              "width: expected a whole number in .16, 8192., found `1000000`");
  ExpectError(with("width", "320.5"), "width: expected a whole number .*found `320.5`");
  ExpectError(with("cx", "400"), "camera.yaml:6: cx: the principal point");
  ExpectError(with("model", "fisheye"),
              "camera.yaml:1: model: expected one of: pinhole, found `fisheye`");
  ExpectError(with("depth_factor", "0"), "camera.yaml:8: depth_factor: .*found `0`");
  ExpectError(kGood + "fx: 3\n", "camera.yaml:9: key `fx` is given twice");
}

TEST_F(CameraReader, RefusesADistortionThatCannotBeInverted) {
  ExpectError(kGood + "k1: -5\n", "camera.yaml:9: k1: the distortion .* cannot be inverted");
}

TEST_F(CameraReader, RefusesTextThatIsNotYaml) {
  ExpectError("width: [320\n", "camera.yaml:[0-9]+: not valid YAML");
  ExpectError("- 1\n- 2\n", "camera.yaml:1: expected `key: value` lines, found a list");
  ExpectError(std::string(1000000, '['), "camera.yaml:1: nested deeper");
  std::string stairs;
  for (std::size_t depth = 0; depth < 1000; ++depth) stairs += std::string(depth, ' ') + "a:\n";
  ExpectError(stairs, "camera.yaml:9: nested deeper");
  ExpectError(std::string(2 << 20, ' '), "larger than 1 MiB");
  EXPECT_THAT([&] { ReadCamera(folder_ / "none.yaml"); },
              ThrowsMessage<io::InputError>(ContainsRegex("none.yaml: no such file")));
}

TEST_F(CameraReader, TakesTheCameraOfTheSequenceUnlessToldOtherwise) {
  EXPECT_THAT(
      [&] { ChooseCamera("", folder_); },
      ThrowsMessage<io::InputError>(ContainsRegex("camera.yaml: .*pass --camera tum1")));
  Read(kGood);
  EXPECT_EQ(ChooseCamera("", folder_).camera.width, 320);
  EXPECT_EQ(ChooseCamera("tum3", folder_).camera.fx, TumCamera("tum3").fx);
  EXPECT_EQ(ChooseCamera((folder_ / "camera.yaml").string(), "elsewhere").camera.width, 320);
  EXPECT_THAT(
      [&] { ChooseCamera("tum9", folder_); },
      ThrowsMessage<io::InputError>(ContainsRegex("--camera tum9: .*expected tum1, tum2")));
}

TEST_F(CameraReader, KnowsEachOfTumsCamerasByItsName) {
  for (const char* name : {"tum1", "tum2", "tum3"})
    EXPECT_EQ(ChooseCamera(name, folder_).camera.fx, TumCamera(name).fx) << name;
}

TEST_F(CameraReader, SaysThatAFolderIsNoCamera) {
  EXPECT_THAT([&] { ChooseCamera(folder_.string(), folder_); },
              ThrowsMessage<io::InputError>(
                  ContainsRegex("--camera .*: is a folder; expected tum1, tum2")));
}

TEST_F(CameraReader, ReadsTheCalibrationsOfTum) {
  for (const char* name : {"tum1", "tum2", "tum3"}) EXPECT_EQ(TumCamera(name).width, 640);
}

}  // namespace
}  // namespace slam
