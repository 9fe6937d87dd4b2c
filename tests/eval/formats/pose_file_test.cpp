// Files of poses of other programs: the three kinds, told apart by what stands in them, and what is
// said of one that is broken.
#include "eval/formats/pose/pose_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include "io/atomic_file.h"
#include "tests/support/refusal.h"
#include "tests/support/temporary_folder.h"

namespace eval {
namespace {

using ::testing::HasSubstr;

constexpr double kDigits = 1e-15;  // positions below 4 m

class PoseFiles : public ::testing::Test {
 protected:
  PoseFile Read(const std::string& text) const {
    io::WriteFile(path_, text);
    return ReadPoseFile(path_);
  }
  std::string ErrorOf(const std::string& text) const {
    return test_support::RefusalOf([&] { Read(text); });
  }
  test_support::TemporaryFolder temporary_;
  const std::filesystem::path path_ = temporary_ / "poses.txt";
};

TEST_F(PoseFiles, OfTumHaveSecondsAndTheQuaternionsScalarLast) {
  const PoseFile file = Read("# t x y z q\n0.5 1 2 3 0 0 1 0\n0.6 1 2 4 0 0 0 1\n");
  EXPECT_EQ(file.kind, PoseFileKind::kTum);
  ASSERT_EQ(file.poses.size(), 2u);
  EXPECT_EQ(file.poses[0].stamp_s, 0.5);
  EXPECT_EQ(file.poses[0].line, 2);
  EXPECT_TRUE(file.poses[0].T_wc.R.isApprox(
      Eigen::Vector3d(-1, -1, 1).asDiagonal().toDenseMatrix(), kDigits));
}

TEST_F(PoseFiles, OfKittiHaveRowsOfAMatrixAndTheirPlaceForATime) {
  const PoseFile file = Read("1 0 0 1 0 1 0 2 0 0 1 3\n0 -1 0 4 1 0 0 5 0 0 1 6\n");
  EXPECT_EQ(file.kind, PoseFileKind::kKitti);
  ASSERT_EQ(file.poses.size(), 2u);
  EXPECT_EQ(file.poses[1].stamp_s, 1.0);
  EXPECT_EQ(file.poses[1].T_wc.t, Eigen::Vector3d(4, 5, 6));
  EXPECT_NEAR(file.poses[1].T_wc.R(0, 1), -1.0, kDigits);
}

TEST_F(PoseFiles, OfEurocHaveNanosecondsTheScalarFirstAndMoreColumns) {
  const PoseFile file = Read(
      "#timestamp [ns], p_RS_R_x [m], ...\n"
      "1403636579763555584,1.5,2,3,0,0,0,1,0.1,0.2,0.3\n"
      "1403636579813555456, 1.5, 2, 4, 1, 0, 0, 0, , ,\n");
  EXPECT_EQ(file.kind, PoseFileKind::kEuroc);
  ASSERT_EQ(file.poses.size(), 2u);
  EXPECT_EQ(file.poses[0].stamp_s, 1403636579763555584.0 / 1e9);
  EXPECT_EQ(file.poses[0].T_wc.t, Eigen::Vector3d(1.5, 2, 3));
  EXPECT_NEAR(file.poses[0].T_wc.R(0, 0), -1.0, kDigits);  // half a turn about z
  EXPECT_NEAR(file.poses[1].T_wc.R(0, 0), 1.0, kDigits);
}

TEST_F(PoseFiles, ThatAreBrokenAreNamedWithTheLine) {
  const std::string good = "0 0 0 0 0 0 0 1\n", file = path_.filename().string();
  EXPECT_THAT(ErrorOf(""), HasSubstr(file + ": holds no pose"));
  EXPECT_THAT(ErrorOf("# nothing\n"), HasSubstr("holds no pose"));
  EXPECT_THAT(ErrorOf(good), HasSubstr("holds a single pose"));
  EXPECT_THAT(ErrorOf(good + "1 nan 0 0 0 0 0 1\n"), HasSubstr(file + ":2: expected `t tx"));
  EXPECT_THAT(ErrorOf(good + "1 0 0 0 0 0 0 2\n"), HasSubstr(":2: expected a unit quaternion"));
  EXPECT_THAT(ErrorOf(good + "1 0 0\n"), HasSubstr(":2: expected `t tx"));
  EXPECT_THAT(ErrorOf("1 0 0\n" + good), HasSubstr(":1: expected eight numbers (TUM), twelve"));
  EXPECT_THAT(ErrorOf("2 0 0 0 0 0 0 1\n1 0 0 0 0 0 0 1\n"),
              HasSubstr(":2: time stamp 1.000000 does not follow 2.000000"));
  EXPECT_THAT(ErrorOf("1 0 0 1 0 1 0 2 0 0 1 3\n1 0 0 1 0 1 0 2 0 0 inf 3\n"),
              HasSubstr(":2: expected the first three rows"));
  EXPECT_THAT(ErrorOf("2 0 0 1 0 1 0 2 0 0 1 3\n1 0 0 1 0 1 0 2 0 0 1 3\n"),
              HasSubstr(":1: expected a rotation"));
  EXPECT_THAT(ErrorOf("1 0 0 1 0 1 0 2 0 0 -1 3\n1 0 0 1 0 1 0 2 0 0 1 3\n"),
              HasSubstr("determinant -1"));
  EXPECT_THAT(ErrorOf("0.5,1,2,3,1,0,0,0\n"), HasSubstr(":1: expected whole nanoseconds"));
  EXPECT_THAT(ErrorOf("timestamp,x,y,z,w,x,y,z\n"), HasSubstr(":1: expected `ns, x"));
  EXPECT_THAT(ErrorOf("2000000000,1,2,3,1,0,0,0\n1000000000,1,2,3,1,0,0,0\n"),
              HasSubstr(":2: time stamp"));
}

TEST_F(PoseFiles, KeepBothPosesOfAStampThatComesAgainAndSaySo) {
  const PoseFile file = Read("1 0 0 0 0 0 0 1\n1 1 0 0 0 0 0 1\n");
  EXPECT_EQ(file.poses.size(), 2u);
  ASSERT_EQ(file.warnings.size(), 1u);
  EXPECT_EQ(file.warnings[0].line, 2);
}

TEST_F(PoseFiles, AreRefusedWhereTheirTimesStartAgain) {
  std::string euroc, tum;
  for (const int second : {1, 2, 3, 1, 2, 3}) {
    euroc += std::to_string(second) + "000000000,1,2,3,1,0,0,0\n";
    tum += std::to_string(second) + " 1 2 3 0 0 0 1\n";
  }
  for (const std::string& text : {euroc, tum})
    EXPECT_THAT(ErrorOf(text), HasSubstr("time stamp 1.000000 does not follow 3.000000"));
  // One that stands twice in a row is a repetition, of which the first counts.
  EXPECT_EQ(ErrorOf("1 1 2 3 0 0 0 1\n2 1 2 3 0 0 0 1\n2 1 2 3 0 0 0 1\n"), "");
}

TEST_F(PoseFiles, OfEurocHaveNoBlanksInsideANumber) {
  EXPECT_THAT(ErrorOf("1000000000,1 2,0,0,1,0,0,0\n2000000000,1,0,0,1,0,0,0\n"),
              HasSubstr("eight finite numbers"));
}

}  // namespace
}  // namespace eval
