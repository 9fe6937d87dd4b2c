#include "app/suite/suite_cases.h"

#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/program.h"

namespace app {
namespace {

/// The case of one recording without a camera file of its own.
SuiteCase CaseBy(const program::TemporaryFolder& folder, const std::string& camera) {
  std::ofstream(folder / "suite.yaml")
      << "format: pas-suite/1\nname: s\nscenes: [{recordings: all, camera: " << camera
      << "}]\n";
  program::fs::create_directories(folder / "all/one");
  std::ofstream(folder / "all/one/rgb.txt") << "1.0 rgb/1.png\n";
  std::ofstream(folder / "all/one/depth.txt") << "1.0 depth/1.png\n";
  return PlanCases(ReadSuite(folder / "suite.yaml"), 1, folder / "all", {}, folder / "out")
      .at(0);
}

// Else what a wrong camera gave would count as done once it is mended.
TEST(PlanCases, TakesTheCameraFileOfRecordingsForOneOfTheInputs) {
  const program::TemporaryFolder folder;
  const auto plan = [&](const char* camera) {
    std::ofstream(folder / "cam.yaml") << camera;
    return CaseBy(folder, "cam.yaml");
  };
  const SuiteCase first = plan("fx: 525\n"), same = plan("fx: 525\n"),
                  other = plan("fx: 517\n");
  EXPECT_EQ(same.inputs_sha256, first.inputs_sha256);
  EXPECT_NE(other.inputs_sha256, first.inputs_sha256);
  EXPECT_NE(other.scene_sha256, first.scene_sha256);
  EXPECT_NE(other.setup_sha256, first.setup_sha256);
}

// Else a baseline would be compared with runs of another camera.
TEST(PlanCases, TakesTheNamedCameraOfRecordingsForAPartOfTheSetup) {
  const program::TemporaryFolder folder;
  const SuiteCase first = CaseBy(folder, "tum1"), same = CaseBy(folder, "tum1"),
                  other = CaseBy(folder, "tum2");
  EXPECT_EQ(same.setup_sha256, first.setup_sha256);
  EXPECT_NE(other.setup_sha256, first.setup_sha256);
  EXPECT_NE(other.scene_sha256, first.scene_sha256);
}

}  // namespace
}  // namespace app
