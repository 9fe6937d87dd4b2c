#include "eval/draw/draw_run.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "eval/draw/contact_sheet.h"
#include "eval/draw/error_picture.h"
#include "eval/draw/frame_picture.h"
#include "eval/draw/label_layout.h"
#include "eval/draw/map_picture.h"
#include "eval/draw/paint.h"
#include "eval/draw/run_gauge.h"
#include "io/input_error.h"
#include "tests/eval/check/small_run.h"

namespace eval {
namespace {

using namespace small_world;
using ::testing::HasSubstr;

// The round trip through quaternions of 17 digits, and poses of 2 m.
constexpr double kRoundOff_m = 1e-9;

bool SamePixels(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && a.type() == b.type() && cv::norm(a, b, cv::NORM_INF) == 0;
}

Eigen::Isometry3d Moved() {
  Eigen::Isometry3d T_wg(Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, 2, 0.5).normalized()));
  T_wg.translation() << 1, 2, -1;
  return T_wg;
}

class DrawRunFolder : public ::testing::Test {
 protected:
  DrawRunFolder()
      : folder_("draw_" +
                std::string(::testing::UnitTest::GetInstance()->current_test_info()->name())) {
    WriteSequence(seq(), world_);
  }
  fs::path seq() const { return folder_.path() / "seq"; }
  fs::path MakeRun(const std::string& name, const Eigen::Isometry3d& T_wg,
                   bool segmentation = true) {
    RunOptions options;
    options.T_wg = T_wg;
    options.segmentation = segmentation;
    options.sequence = seq().string();
    WriteRun(folder_.path() / name, world_, options);
    return folder_.path() / name;
  }
  cv::Mat Named(const std::vector<Picture>& pictures, const std::string& name) {
    for (const Picture& picture : pictures) {
      if (picture.name == name) return picture.image;
    }
    return {};
  }
  FrameScene SceneOf(const ::eval::Run& run, std::size_t frame) {
    FrameScene scene;
    scene.rgb = Render(world_, world_.views[frame]).rgb;
    scene.labels = ReadSegmentation(run, run.frames[frame].stamp_s);
    scene.frame = &run.frames[frame];
    scene.T_wc = run.trajectory[frame].T_wc;
    scene.map = &run.map;
    scene.camera = ReadNamedCamera((seq() / "camera.yaml").string());
    return scene;
  }

  TemporaryFolder folder_;
  World world_ = MakeWorld(160, 120, 5);
};

TEST_F(DrawRunFolder, GivesTheSamePixelsTwice) {
  const fs::path run = MakeRun("run", Moved());
  const std::vector<Picture> first = DrawRun(run, {}), second = DrawRun(run, {});
  ASSERT_EQ(first.size(), 3u);
  ASSERT_EQ(second.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(first[i].name, second[i].name);
    EXPECT_TRUE(SamePixels(first[i].image, second[i].image)) << first[i].name;
  }
}

TEST_F(DrawRunFolder, LaysARunInAnyWorldFrameOnTheTruth) {
  const MapScene scene = CollectMap(ReadRun(MakeRun("run", Moved())), ReadSequence(seq()));
  ASSERT_TRUE(scene.on_truth);
  ASSERT_EQ(scene.run_path_v.size(), scene.truth_path_v.size());
  for (std::size_t i = 0; i < scene.run_path_v.size(); ++i) {
    EXPECT_LT((scene.run_path_v[i] - scene.truth_path_v[i]).norm(), kRoundOff_m);
  }
  for (const MapScene::Estimate& plane : scene.planes) {
    const Face& face = world_.faces[static_cast<std::size_t>(40 - plane.id - 1)];
    for (std::size_t k = 0; k < 4; ++k) {
      EXPECT_LT((plane.vertices_v[k] - face.vertices[k]).norm(), kRoundOff_m);
    }
  }
}

TEST_F(DrawRunFolder, DrawsARunInAnotherWorldFrameAtTheSamePixels) {
  const Sequence sequence = ReadSequence(seq());
  const cv::Mat still = DrawMap(
      CollectMap(ReadRun(MakeRun("a", Eigen::Isometry3d::Identity())), sequence), "map");
  const cv::Mat moved = DrawMap(CollectMap(ReadRun(MakeRun("b", Moved())), sequence), "map");
  ASSERT_EQ(still.size(), moved.size());
  cv::Mat difference;
  cv::absdiff(still, moved, difference);
  cv::cvtColor(difference, difference, cv::COLOR_BGR2GRAY);
  // Round-off may move an edge by a sixteenth of a pixel.
  EXPECT_LT(cv::countNonZero(difference > 40), 20);
}

TEST_F(DrawRunFolder, PaintsTheTopOfTheBookInItsColourWhereTheTruthHasIt) {
  const MapScene scene = CollectMap(ReadRun(MakeRun("run", Moved())), ReadSequence(seq()));
  const cv::Mat page = DrawMap(scene, "map");
  // The page as DrawMap lays it out: margins of 30 and 64, a column of 340 to the right.
  const MapScale scale = FitMap(scene, {30, 64, 1640 - 60 - 340, 1000});
  const Face& top = world_.faces[11];
  ASSERT_GT(top.n.z(), 0.99);
  const Eigen::Vector3d inside = 0.8 * top.vertices[0] + 0.2 * top.vertices[2];
  const cv::Point2d at = scale.At(inside);
  const cv::Vec3b found = page.at<cv::Vec3b>(cvRound(at.y), cvRound(at.x));
  // Half the book's colour over half the table's over the page.
  const Colour book = ColourOfPlane(MapId(12)), table = ColourOfPlane(MapId(6));
  const Colour paper(250, 249, 248);
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(found[c], 0.5 * book[c] + 0.25 * table[c] + 0.25 * paper[c], 2);
  }
}

TEST_F(DrawRunFolder, FindsTheDeskForBaseAndTheTrueSteps) {
  const MapScene scene = CollectMap(ReadRun(MakeRun("run", Moved())), ReadSequence(seq()));
  const auto base = BasePlane(scene);
  ASSERT_TRUE(base.has_value());
  EXPECT_EQ(scene.planes[*base].class_name, "dining table");
  for (const MapScene::Estimate& plane : scene.planes) {
    if (plane.class_name != "book" || plane.pi_v.n.z() < kLevel_cos) continue;
    const MapScene::Truth* truth = TrueLevelPlane(scene, plane);
    ASSERT_NE(truth, nullptr);
    EXPECT_EQ(truth->class_name, "book");
    EXPECT_NEAR(HeightAt(plane.pi_v, plane.centre_v) -
                    HeightAt(scene.planes[*base].pi_v, plane.centre_v),
                0.04, kRoundOff_m);
  }
}

TEST_F(DrawRunFolder, LaysTheLargestPlaneLevelWithoutATruth) {
  const fs::path run = MakeRun("run", Moved());
  fs::remove(seq() / "groundtruth.txt");
  fs::remove_all(seq() / "gt");
  const std::vector<Picture> pictures = DrawRun(run, {});
  EXPECT_EQ(pictures.size(), 2u);
  EXPECT_TRUE(Named(pictures, "error_over_time.png").empty());
  EXPECT_FALSE(CollectMap(ReadRun(run), ReadSequence(seq())).on_truth);
}

TEST_F(DrawRunFolder, TintsASegmentInTheColourOfItsMapPlaneInEveryFrame) {
  const ::eval::Run run = ReadRun(MakeRun("run", Moved()));
  const Face& top = world_.faces[11];
  const Colour colour = ColourOfPlane(MapId(top.id));
  for (const std::size_t frame : {std::size_t{0}, std::size_t{2}}) {
    const FrameScene scene = SceneOf(run, frame);
    const cv::Mat image = DrawFrame(scene, world_.width);
    // Each pixel of the plane lies between what was seen and the colour, apart from lines and
    // text.
    const cv::Mat mask = Render(world_, world_.views[frame]).plane_ids == top.id;
    int tinted = 0, total = 0;
    for (int y = 0; y < mask.rows; ++y) {
      for (int x = 0; x < mask.cols; ++x) {
        if (mask.at<uchar>(y, x) == 0) continue;
        ++total;
        bool good = true;
        for (int c = 0; c < 3; ++c) {
          const double expected = 0.58 * scene.rgb.at<cv::Vec3b>(y, x)[c] + 0.42 * colour[c];
          good = good && std::abs(image.at<cv::Vec3b>(y, x)[c] - expected) <= 1.5;
        }
        tinted += good;
      }
    }
    EXPECT_GT(total, 100);
    EXPECT_GT(tinted, total / 10);
  }
}

TEST_F(DrawRunFolder, OutlinesPlanesByTheirVerticesWithoutASegmentation) {
  const fs::path folder = MakeRun("run", Moved(), false);
  const ::eval::Run run = ReadRun(folder);
  const FrameScene scene = SceneOf(run, 1);
  ASSERT_FALSE(scene.labels.has_value());
  const cv::Mat image = DrawFrame(scene, world_.width);
  cv::Mat difference;
  cv::absdiff(image, scene.rgb, difference);
  const cv::Mat book = Render(world_, world_.views[1]).plane_ids == 12;
  const cv::Scalar on_book = cv::mean(difference, book);
  EXPECT_GT(on_book[0] + on_book[1] + on_book[2], 30);
  EXPECT_EQ(DrawRun(folder, {}).size(), 3u);
}

TEST_F(DrawRunFolder, AsksForACameraWhenNothingElseCanPlaceThePlanes) {
  const fs::path run = MakeRun("run", Moved(), false);
  fs::remove(seq() / "camera.yaml");
  try {
    DrawRun(run, {});
    FAIL() << "drawn without a camera";
  } catch (const io::InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("--camera"));
  }
  DrawOptions options;
  options.camera = "tum1";
  EXPECT_EQ(DrawRun(run, options).size(), 3u);
}

TEST_F(DrawRunFolder, RefusesAFolderThatExistsUnlessForced) {
  const fs::path out = folder_.path() / "pictures";
  const std::vector<Picture> pictures{{"a.png", cv::Mat::zeros(4, 4, CV_8UC3)}};
  WritePictures(pictures, out, false);
  EXPECT_THROW(WritePictures(pictures, out, false), io::InputError);
  WriteText(out / "kept.txt", "mine");
  WritePictures(pictures, out, true);
  EXPECT_TRUE(fs::exists(out / "kept.txt"));
  EXPECT_TRUE(fs::exists(out / "a.png"));
  EXPECT_EQ(std::distance(fs::directory_iterator(out), fs::directory_iterator()), 2);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_.path()), fs::directory_iterator()), 2)
      << "something was left behind";
}

TEST_F(DrawRunFolder, DrawsARunThatTrackedNothing) {
  const fs::path run = MakeRun("run", Moved());
  WriteText(run / "trajectory.txt", "");
  WriteText(run / "map.json", "{\"planes\": []}");
  std::istringstream in(ReadText(run / "frame_planes.jsonl"));
  std::string lines, line;
  while (std::getline(in, line)) {
    lines +=
        json{{"timestamp", json::parse(line)["timestamp"]}, {"planes", json::array()}}.dump();
    lines += "\n";
  }
  WriteText(run / "frame_planes.jsonl", lines);
  EXPECT_EQ(DrawRun(run, {}).size(), 2u);
}

TEST(AlignByPoses, RecoversTheMotionOfAStraightPath) {
  const Eigen::Isometry3d T_wg = Moved();
  Trajectory truth, run;
  for (int i = 0; i < 4; ++i) {
    const Pose T_gc{Eigen::Matrix3d::Identity(), Eigen::Vector3d(0.1 * i, 0, 0)};
    truth.push_back({i * 0.1, T_gc});
    run.push_back({i * 0.1, Pose{T_wg.linear(), T_wg.translation()} * T_gc});
  }
  const auto T_gw = AlignByPoses(run, truth, true);
  ASSERT_TRUE(T_gw.has_value());
  EXPECT_LT((T_gw->R - T_wg.linear().transpose()).norm(), 1e-12);
  EXPECT_LT((*T_gw * run[3].T_wc.t - truth[3].T_wc.t).norm(), 1e-12);
  EXPECT_FALSE(AlignByPoses(run, {}, true).has_value());
}

TEST(ColourOfPlane, TellsNeighbouringIdsApart) {
  for (int id = 0; id < 200; ++id) {
    for (int next = id + 1; next <= id + 4; ++next) {
      EXPECT_GT(cv::norm(ColourOfPlane(id) - ColourOfPlane(next)), 40) << id << " " << next;
    }
  }
}

TEST(LabelLayout, NeverPutsOneLabelOverAnother) {
  LabelLayout layout({0, 0, 400, 300});
  std::vector<cv::Rect2d> placed;
  for (int i = 0; i < 30; ++i) {
    const auto place = layout.Place({200.0 + i, 150}, {60, 16});
    if (!place) continue;
    for (const cv::Rect2d& other : placed) EXPECT_EQ((other & *place).area(), 0);
    EXPECT_GE(place->x, 0);
    EXPECT_LE(place->y + place->height, 300);
    placed.push_back(*place);
  }
  EXPECT_GT(placed.size(), 5u);
}

TEST(SpreadEvenly, TakesTheFirstAndTheLastAndNoneTwice) {
  EXPECT_THAT(SpreadEvenly(100, 4), ::testing::ElementsAre(0, 33, 66, 99));
  EXPECT_THAT(SpreadEvenly(3, 12), ::testing::ElementsAre(0, 1, 2));
  EXPECT_THAT(SpreadEvenly(9, 1), ::testing::ElementsAre(0));
  EXPECT_TRUE(SpreadEvenly(0, 5).empty());
}

TEST(RoundStep, IsOneTwoOrFiveTimesAPowerOfTen) {
  EXPECT_DOUBLE_EQ(RoundStep(10, 10), 1);
  EXPECT_DOUBLE_EQ(RoundStep(37, 10), 5);
  EXPECT_DOUBLE_EQ(RoundStep(0.18, 10), 0.02);
  EXPECT_DOUBLE_EQ(RoundStep(0, 10), 1);
}

}  // namespace
}  // namespace eval
