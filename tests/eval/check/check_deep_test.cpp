#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>
#include <random>

#include "eval/check/check_folder.h"
#include "tests/eval/check/small_world.h"
#include "tests/support/image_files.h"

// Each test plants one of the mistakes that truth is most often written with.
namespace eval {
namespace {

using namespace small_world;
using ::testing::HasSubstr;

class CheckDeep : public ::testing::Test {
 protected:
  CheckDeep() : world_(MakeWorld(160, 120, 10)) { WriteSequence(seq(), world_); }
  fs::path seq() const { return folder_.path() / "seq"; }
  /// Cuts a hole into the table top: `wide_m` from left to right, before the things on it.
  void CutTable(double wide_m) {
    json scene = json::parse(ReadText(seq() / "gt/scene.json"));
    for (json& plane : scene["planes"]) {
      if (plane["object"] != 1 || plane["normal"][2] != 1) continue;
      const double z = plane["vertices"][0][2], h = wide_m / 2;
      plane["holes"] = {{{-h, -0.35, z}, {h, -0.35, z}, {h, -0.20, z}, {-h, -0.20, z}}};
      plane["area"] = plane["area"].get<double>() - wide_m * 0.15;
    }
    WriteText(seq() / "gt/scene.json", scene.dump(1));
  }
  fs::path Image(const std::string& where, int frame) const {
    return seq() / where /
           (StampText(world_.views[static_cast<std::size_t>(frame)].stamp_s) + ".png");
  }
  std::string Faults() const {
    WriteManifest(seq(), static_cast<int>(world_.views.size()));
    std::string text;
    for (const Fault& fault : CheckFolder(seq(), true).faults) text += Describe(fault) + "\n";
    return text;
  }
  /// Replaces every depth by what `change` makes of it.
  void ChangeDepth(const std::function<double(int x, int y, double units)>& change) {
    for (int i = 0; i < 10; ++i) {
      cv::Mat depth = test_support::ReadImageFile(Image("depth", i));
      for (int y = 0; y < depth.rows; ++y) {
        for (int x = 0; x < depth.cols; ++x) {
          ushort& units = depth.at<ushort>(y, x);
          if (units > 0) units = cv::saturate_cast<ushort>(change(x, y, units));
        }
      }
      WriteImage(Image("depth", i), depth);
    }
  }

  TemporaryFolder folder_;
  World world_;
};

TEST_F(CheckDeep, FindsNothingInAFaultlessSequence) { EXPECT_EQ(Faults(), ""); }

TEST_F(CheckDeep, FindsNothingInOneWithTheNoiseOfItsSensor) {
  std::mt19937 random(1);
  std::normal_distribution<double> noise;
  ChangeDepth([&](int, int, double units) {
    const double z = units / 5000;
    return units + 5000 * (0.0012 + 0.0019 * (z - 0.4) * (z - 0.4)) * noise(random);
  });
  WriteManifest(seq(), 10);
  std::string manifest = ReadText(seq() / "manifest.json");
  std::string text;
  Edit(seq() / "manifest.json", "\"ideal\"", "\"kinect1\"");
  for (const Fault& fault : CheckFolder(seq(), true).faults) text += Describe(fault) + "\n";
  EXPECT_EQ(text, "");
}

TEST_F(CheckDeep, FindsDepthAlongTheRay) {
  ChangeDepth([&](int x, int y, double units) {
    const double u = (x - world_.cx()) / world_.focal_px,
                 v = (y - world_.cy()) / world_.focal_px;
    return units * std::sqrt(1 + u * u + v * v);
  });
  EXPECT_THAT(Faults(), HasSubstr("length of the ray"));
  EXPECT_THAT(Faults(), HasSubstr("pairs of frames"));
}

TEST_F(CheckDeep, FindsIdsShiftedByAPixelAndTellsWhere) {
  for (int i = 0; i < 10; ++i) {
    for (const char* where : {"gt/plane_id", "gt/object_id"}) {
      const cv::Mat ids = test_support::ReadImageFile(Image(where, i));
      cv::Mat shifted = ids.clone();
      ids.colRange(0, ids.cols - 1).copyTo(shifted.colRange(1, ids.cols));
      WriteImage(Image(where, i), shifted);
    }
  }
  EXPECT_THAT(Faults(), HasSubstr("outside the face"));
  EXPECT_THAT(Faults(), HasSubstr("shifted by (1, 0) px"));
}

TEST_F(CheckDeep, FindsPixelsThatNameAFaceInsideItsHole) {
  CutTable(0.1);
  EXPECT_THAT(Faults(), HasSubstr("outside the face"));
}

// As at its outline: a centre ray may lie a fifth of a pixel beside the rim.
TEST_F(CheckDeep, LeavesPixelsBesideTheRimOfAHoleAlone) {
  CutTable(0.003);  // a third of a pixel, along a column of some thirty
  EXPECT_EQ(Faults(), "");
}

TEST_F(CheckDeep, FindsPosesThatAreInvertedEvenWithoutPlanes) {
  std::string poses;
  for (const View& view : world_.views) poses += TumLine(view.stamp_s, view.T_wc.inverse());
  WriteText(seq() / "groundtruth.txt", poses);
  EXPECT_THAT(Faults(), HasSubstr("world to camera"));
}

TEST_F(CheckDeep, FindsATranslationOfTheWrongSign) {
  std::string poses;
  for (const View& view : world_.views) {
    Eigen::Isometry3d T_wc = view.T_wc;
    T_wc.translation().x() *= -1;
    poses += TumLine(view.stamp_s, T_wc);
  }
  WriteText(seq() / "groundtruth.txt", poses);
  EXPECT_THAT(Faults(), HasSubstr("outside the face"));
}

TEST_F(CheckDeep, FindsAWrongDepthFactor) {
  Edit(seq() / "camera.yaml", "depth_factor: 5000", "depth_factor: 1000");
  EXPECT_THAT(Faults(), HasSubstr("5 times too large"));
  EXPECT_THAT(Faults(), HasSubstr("pairs of frames"));
}

TEST_F(CheckDeep, FindsDepthPairedWithTheFrameBefore) {
  for (int i = 9; i > 0; --i) {
    fs::copy_file(Image("depth", i - 1), Image("depth", i),
                  fs::copy_options::overwrite_existing);
  }
  EXPECT_THAT(Faults(), HasSubstr("the frame before better"));
}

TEST_F(CheckDeep, FindsDepthPairedWithTheFrameAfter) {
  for (int i = 0; i < 9; ++i) {
    fs::copy_file(Image("depth", i + 1), Image("depth", i),
                  fs::copy_options::overwrite_existing);
  }
  EXPECT_THAT(Faults(), HasSubstr("the frame after better"));
}

}  // namespace
}  // namespace eval
