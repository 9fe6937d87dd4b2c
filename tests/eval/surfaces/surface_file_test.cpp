#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include "eval/surfaces/outline.h"
#include "eval/surfaces/surface.h"
#include "io/atomic_file.h"
#include "tests/support/refusal.h"
#include "tests/support/temporary_folder.h"

namespace eval {
namespace {

using test_support::RefusalOf;
using ::testing::HasSubstr;

SurfaceFile TwoSurfaces() {
  SurfaceFile file{"a \"recording\"", 0.15, 0.0016, {}};
  Surface surface;
  surface.id = 3;
  surface.flatness_m = 0.0042;
  surface.pi_g = {Eigen::Vector3d(0, 0, -1), 2.0};
  surface.chart_g = {Eigen::Vector3d(0.5, 0.25, 2.0), Eigen::Vector3d::UnitX(),
                     -Eigen::Vector3d::UnitY()};
  surface.outlines = {{{0, 0}, {1, 0}, {1, 0.5}, {0, 0.5}}};
  surface.holes = {{{0.2, 0.2}, {0.4, 0.2}, {0.4, 0.3}, {0.2, 0.3}}};
  file.surfaces = {surface, surface};
  file.surfaces[1].id = 4;
  file.surfaces[1].same_as = 3;
  return file;
}

class SurfaceFileOnDisk : public ::testing::Test {
 protected:
  /// What reading the text throws; empty when it does not.
  std::string ErrorOf(const std::string& text) {
    io::WriteFile(path_, text);
    return RefusalOf([&] { ReadSurfaces(path_); });
  }
  /// The text with one piece of it replaced.
  static std::string Edited(const std::string& from, const std::string& to) {
    std::string text = SurfacesText(TwoSurfaces());
    const auto at = text.find(from);
    if (at == std::string::npos) throw std::runtime_error("no " + from + " in " + text);
    return text.replace(at, from.size(), to);
  }
  test_support::TemporaryFolder temporary_;
  const std::filesystem::path path_ = temporary_ / "surfaces.yaml";
};

TEST_F(SurfaceFileOnDisk, GivesBackWhatWasWritten) {
  const SurfaceFile written = TwoSurfaces();
  io::WriteFile(path_, SurfacesText(written));
  const SurfaceFile read = ReadSurfaces(path_);
  EXPECT_EQ(SurfacesText(read), SurfacesText(written));
  ASSERT_EQ(read.surfaces.size(), 2u);
  EXPECT_DOUBLE_EQ(AreaOf(read.surfaces[0]), 0.5 - 0.02);
  EXPECT_EQ(CountedAs(read.surfaces[1]), 3);
  EXPECT_LT((read.surfaces[0].chart_g.axis_v + Eigen::Vector3d::UnitY()).norm(), 1e-9);
}

// It sets the tolerances by which pixels are told apart.
TEST_F(SurfaceFileOnDisk, KeepsTheNoiseOfAGoodSensorToAPercent) {
  for (const double noise_per_m : {0.0016, 0.00034, 0.00012}) {
    SurfaceFile written = TwoSurfaces();
    written.noise_per_m = noise_per_m;
    io::WriteFile(path_, SurfacesText(written));
    EXPECT_NEAR(ReadSurfaces(path_).noise_per_m, noise_per_m, 0.01 * noise_per_m);
  }
}

TEST_F(SurfaceFileOnDisk, NamesTheLineOfEachMistakeOfAnEditor) {
  EXPECT_THAT(ErrorOf(Edited("normal: [0, 0, -1]", "normal: [0, 0, -2]")),
              HasSubstr(".yaml:10: "));
  EXPECT_THAT(ErrorOf(Edited("axis_u: [1, 0, 0]", "axis_u: [0, 0, 1]")),
              HasSubstr(".yaml:11: surfaces[0].axis_u: expected a direction at right angles"));
  EXPECT_THAT(ErrorOf(Edited("[1, 0.5]", "[1]")), HasSubstr(".yaml:13: "));
  EXPECT_THAT(ErrorOf(Edited("[1, 0.5]", "[1, 5000]")), HasSubstr(".yaml:13: "));
  EXPECT_THAT(ErrorOf(Edited("id: 4", "id: 3")), HasSubstr("a second time"));
  EXPECT_THAT(ErrorOf(Edited("same_as: 3", "same_as: 7")), HasSubstr("no surface of the file"));
  EXPECT_THAT(ErrorOf(Edited("same_as: 3", "same_as: 4")), HasSubstr("part of another"));
  EXPECT_THAT(ErrorOf(Edited("holes", "hole")), HasSubstr("did you mean `holes`"));
  EXPECT_THAT(ErrorOf(Edited("pas-surfaces/1", "pas-run/1")), HasSubstr(".yaml:1: "));
}

TEST_F(SurfaceFileOnDisk, SaysHowToMakeOneThatIsMissing) {
  EXPECT_THAT(RefusalOf([] { ReadSurfaces("/nowhere/surfaces.yaml"); }),
              HasSubstr("pas surfaces"));
}

TEST_F(SurfaceFileOnDisk, ReadsBackTheWallOfALongCorridorAsItWasOutlined) {
  Sheet sheet;
  sheet.pi_g = {Eigen::Vector3d::UnitZ(), 0.0};
  sheet.chart_g = {{0, 0, 0}, Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY()};
  const CellMask mask(20, 12000, std::uint8_t(255));  // 120 m
  sheet.height_m = cv::Mat1d(mask.size(), 0.0);
  sheet.hits = cv::Mat1i(mask.size(), 1);
  SurfaceFile file{"", 0.15, 0.0016, {OutlinedSurface(sheet, mask)}};
  file.surfaces[0].id = 1;
  io::WriteFile(path_, SurfacesText(file));
  EXPECT_NEAR(AreaOf(ReadSurfaces(path_).surfaces.at(0)), 120 * 0.2, 0.5);
}

}  // namespace
}  // namespace eval
