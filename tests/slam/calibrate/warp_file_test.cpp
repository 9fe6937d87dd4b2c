#include "slam/calibrate/warp_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <filesystem>
#include <fstream>

#include "tests/support/refusal.h"
#include "tests/support/temporary_folder.h"

namespace slam {
namespace {

using testing::AllOf;
using testing::HasSubstr;

Camera CameraOfFile() {
  Camera camera;
  camera.width = 8, camera.height = 6;
  return camera;
}

/// Two by three cells of a small image.
DepthWarp SmallWarp() {
  DepthWarp warp;
  warp.cells = {8, 6, 3, 2};
  warp.law = BendLaw::kDisparity;
  warp.pattern = Eigen::VectorXd(6);
  warp.pattern << 0.001, -0.002, 0.003, -0.004, 0.005, -0.006;
  warp.sigma = Eigen::VectorXd::Constant(6, 0.0005);
  return warp;
}

class WarpFile : public testing::Test {
 protected:
  DepthWarp Read(const std::string& text) const {
    std::ofstream(file_) << text;
    return ReadWarp(file_, CameraOfFile());
  }
  std::string FaultOf(const std::string& text) const {
    return test_support::RefusalOf([&] { Read(text); });
  }
  static std::string With(const std::string& part, const std::string& instead) {
    std::string text = WarpText(SmallWarp(), "made by hand");
    return text.replace(text.find(part), part.size(), instead);
  }
  test_support::TemporaryFolder temporary_;
  const std::filesystem::path file_ = temporary_ / "warp.yaml";
};

TEST_F(WarpFile, ReadsBackWhatIsWrittenToAMillionth) {
  const DepthWarp written = SmallWarp(), read = Read(WarpText(written, "made by hand"));
  EXPECT_EQ(read.law, written.law);
  EXPECT_EQ(read.cells.cols, 3);
  EXPECT_EQ(read.cells.rows, 2);
  EXPECT_LT((read.pattern - written.pattern).cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_LT((read.sigma - written.sigma).cwiseAbs().maxCoeff(), 1e-6);
}

TEST_F(WarpFile, GoesWithTheDepthWhereItDoesNotSay) {
  EXPECT_EQ(Read(With("law: disparity", "# ")).law, BendLaw::kDepth);
  EXPECT_THAT(FaultOf(With("law: disparity", "law: both")), HasSubstr("law"));
}

TEST_F(WarpFile, RefusesAnImageOfAnotherSizeThanTheCameras) {
  EXPECT_THAT(FaultOf(With("width: 8", "width: 16")),
              AllOf(HasSubstr("16 x 6"), HasSubstr("8 x 6"), HasSubstr(".yaml:3")));
}

TEST_F(WarpFile, RefusesRowsThatAreNotAsManyAsCells) {
  EXPECT_THAT(FaultOf(With("rows: 2", "rows: 3")), HasSubstr("pattern_ppm: has 2 rows"));
  EXPECT_THAT(FaultOf(With("1000, -2000, 3000", "1000, -2000")), HasSubstr("pattern_ppm[0]"));
}

TEST_F(WarpFile, RefusesWhatNoSensorBends) {
  EXPECT_THAT(FaultOf(With("-6000", "-600000")), HasSubstr("pattern_ppm[1]"));
  EXPECT_THAT(FaultOf(With("-6000", ".nan")), HasSubstr("pattern_ppm[1]"));
  EXPECT_THAT(FaultOf(With("500, 500, 500", "-500, 500, 500")), HasSubstr("sigma_ppm[0]"));
}

TEST_F(WarpFile, RefusesUnknownAndMissingKeysAndOtherFormats) {
  EXPECT_THAT(FaultOf(With("sigma_ppm", "sigmas_ppm")), HasSubstr("sigma_ppm"));
  EXPECT_THAT(FaultOf(With("pas-depth-warp/1", "pas-depth-warp/2")), HasSubstr("format"));
  EXPECT_THAT(FaultOf(""), HasSubstr("format"));
}

}  // namespace
}  // namespace slam
