#include "eval/draw/draw_run.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "eval/draw/contact_sheet.h"
#include "eval/draw/map_picture.h"
#include "eval/draw/paint.h"
#include "eval/draw/run_title.h"
#include "io/input_error.h"
#include "tests/eval/draw/drawn_world.h"
#include "tests/support/image_files.h"
#include "tests/support/refusal.h"

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

using DrawRunFolder = DrawnWorld;

TEST_F(DrawRunFolder, GivesTheSamePixelsTwice) {
  const fs::path run = MakeRun("run", Moved());
  const std::vector<Picture> first = DrawRun(run, {}).pictures,
                             second = DrawRun(run, {}).pictures;
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
  ASSERT_FALSE(scene.run_path_v.empty() || scene.planes.empty());
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
  const cv::Mat still =
      DrawMap(CollectMap(ReadRun(MakeRun("a", Eigen::Isometry3d::Identity())), sequence),
              RunTitle{"map", "", "", ""});
  const cv::Mat moved = DrawMap(CollectMap(ReadRun(MakeRun("b", Moved())), sequence),
                                RunTitle{"map", "", "", ""});
  ASSERT_EQ(still.size(), moved.size());
  cv::Mat difference;
  cv::absdiff(still, moved, difference);
  cv::cvtColor(difference, difference, cv::COLOR_BGR2GRAY);
  // Round-off may move an edge by a sixteenth of a pixel.
  EXPECT_LT(cv::countNonZero(difference > 40), 20);
}

TEST_F(DrawRunFolder, PaintsTheTopOfTheBookInItsColourWhereTheTruthHasIt) {
  const MapScene scene = CollectMap(ReadRun(MakeRun("run", Moved())), ReadSequence(seq()));
  const cv::Mat page = DrawMap(scene, RunTitle{"map", "", "", ""});
  // The page as DrawMap lays it out: margins of 30 and 76, a column of 340 to the right.
  const MapScale scale = FitMap(scene, {30, 76, 1640 - 60 - 340, 1000});
  const Face& top = world_.faces[11];
  ASSERT_GT(top.n.z(), 0.99);
  const Eigen::Vector3d inside = 0.8 * top.vertices[0] + 0.2 * top.vertices[2];
  const cv::Point2d at = scale.At(inside);
  const cv::Vec3b found = page.at<cv::Vec3b>(cvRound(at.y), cvRound(at.x));
  // The book's fill over the table's over the page.
  const Colour book = LevelFill(MapId(12)), table = LevelFill(MapId(6));
  const Colour paper(250, 249, 248);
  const double through = 1 - kLevelOpacity;
  for (int c = 0; c < 3; ++c) {
    const double under = kLevelOpacity * table[c] + through * paper[c];
    EXPECT_NEAR(found[c], kLevelOpacity * book[c] + through * under, 2);
  }
}

TEST_F(DrawRunFolder, FindsTheDeskForBaseAndTheTrueSteps) {
  const MapScene scene = CollectMap(ReadRun(MakeRun("run", Moved())), ReadSequence(seq()));
  const auto base = BasePlane(scene);
  ASSERT_TRUE(base.has_value());
  EXPECT_EQ(scene.planes[*base].class_name, "dining table");
  int books = 0;
  for (const MapScene::Estimate& plane : scene.planes) {
    if (plane.class_name != "book" || plane.pi_v.n.z() < kLevel_cos) continue;
    ++books;
    const MapScene::Truth* truth = TrueLevelPlane(scene, plane);
    ASSERT_NE(truth, nullptr);
    EXPECT_EQ(truth->class_name, "book");
    EXPECT_NEAR(HeightAt(plane.pi_v, plane.centre_v) -
                    HeightAt(scene.planes[*base].pi_v, plane.centre_v),
                0.04, kRoundOff_m);
  }
  EXPECT_GT(books, 0);
}

TEST_F(DrawRunFolder, LaysTheLargestPlaneLevelWithoutATruth) {
  const fs::path run = MakeRun("run", Moved());
  fs::remove(seq() / "groundtruth.txt");
  fs::remove_all(seq() / "gt");
  const std::vector<Picture> pictures = DrawRun(run, {}).pictures;
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
  EXPECT_EQ(DrawRun(folder, {}).pictures.size(), 3u);
}

TEST_F(DrawRunFolder, OutlinesAPlaneWithoutVerticesByTheHullThatTheMapHasOfIt) {
  const ::eval::Run run = ReadRun(MakeRun("run", Moved(), false));
  FrameScene scene = SceneOf(run, 1);
  const Face& top = world_.faces[11];  // of the book
  RunFrame frame = *scene.frame;
  std::erase_if(frame.planes, [&](const auto& p) { return p.map_plane != MapId(top.id); });
  ASSERT_EQ(frame.planes.size(), 1u);
  frame.planes[0].vertices_c.clear();
  scene.frame = &frame;
  cv::Mat difference;
  cv::absdiff(DrawFrame(scene, world_.width), scene.rgb, difference);
  cv::dilate(difference, difference, cv::Mat());  // a pixel's width
  int drawn = 0, all = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    for (double s = 0; s < 1; s += 0.05, ++all) {
      const Vector3d x_g = (1 - s) * top.vertices[k] + s * top.vertices[(k + 1) % 4];
      const Vector3d x_c = world_.views[1].T_wc.inverse() * x_g;
      const cv::Point at(cvRound(world_.focal_px * x_c.x() / x_c.z() + world_.cx()),
                         cvRound(world_.focal_px * x_c.y() / x_c.z() + world_.cy()));
      ASSERT_TRUE(cv::Rect({}, difference.size()).contains(at));
      drawn += cv::norm(difference.at<cv::Vec3b>(at)) > 30 ? 1 : 0;
    }
  }
  EXPECT_GT(drawn, 0.9 * all);
}

TEST_F(DrawRunFolder, AsksForACameraWhenNothingElseCanPlaceThePlanes) {
  const fs::path run = MakeRun("run", Moved(), false);
  const fs::path camera = folder_.path() / "camera.yaml";
  fs::rename(seq() / "camera.yaml", camera);
  EXPECT_THAT(test_support::RefusalOf([&] { DrawRun(run, {}); }), HasSubstr("--camera"));
  DrawOptions options;
  options.camera = camera;
  EXPECT_EQ(DrawRun(run, options).pictures.size(), 3u);
}

TEST_F(DrawRunFolder, TakesTheCameraOfTheRunWhenTheSequenceHasNone) {
  const fs::path run = MakeRun("run", Moved());
  const cv::Mat before = DrawRun(run, {}).pictures[0].image;
  const Camera camera = *ReadSequence(seq()).camera;
  json info = json::parse(ReadText(run / "run.json"));
  info["camera"] = {{"width", camera.width}, {"height", camera.height},
                    {"fx", camera.fx},       {"fy", camera.fy},
                    {"cx", camera.cx},       {"cy", camera.cy},
                    {"fps", camera.fps},     {"depth_factor", camera.depth_factor}};
  WriteText(run / "run.json", info.dump());
  fs::remove(seq() / "camera.yaml");
  EXPECT_EQ(cv::norm(DrawRun(run, {}).pictures[0].image, before, cv::NORM_INF), 0.0);
}

TEST_F(DrawRunFolder, RefusesAFolderThatExistsUnlessForced) {
  const fs::path out = folder_.path() / "pictures";
  const std::vector<Picture> pictures{{"contact_sheet.png", cv::Mat::zeros(4, 4, CV_8UC3)}};
  WritePictures(pictures, out, false);
  EXPECT_THROW(WritePictures(pictures, out, false), io::InputError);
  WriteText(out / "kept.txt", "mine");
  WritePictures(pictures, out, true);
  EXPECT_TRUE(fs::exists(out / "kept.txt"));
  EXPECT_TRUE(fs::exists(out / "contact_sheet.png"));
  EXPECT_EQ(std::distance(fs::directory_iterator(out), fs::directory_iterator()), 2);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_.path()), fs::directory_iterator()), 2)
      << "something was left behind";
}

TEST_F(DrawRunFolder, DrawsARunThatTrackedNothingAndSaysSo) {
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
  const Drawing drawing = DrawRun(run, {});
  EXPECT_EQ(drawing.pictures.size(), 3u);
  EXPECT_THAT(drawing.notes, ::testing::Contains(HasSubstr("nothing was tracked")));
  EXPECT_THAT(drawing.notes, ::testing::Contains(HasSubstr("the run tracked no frame")));
}

TEST_F(DrawRunFolder, SaysHowToGetASegmentationWhereThereIsNone) {
  const auto notes = DrawRun(MakeRun("run", Moved(), false), {}).notes;
  EXPECT_THAT(notes, ::testing::ElementsAre(HasSubstr("pas slam --save-segmentation")));
  EXPECT_TRUE(DrawRun(MakeRun("segmented", Moved()), {}).notes.empty());
}

TEST_F(DrawRunFolder, LeavesPlanesUnfilledWithoutASegmentation) {
  const ::eval::Run run = ReadRun(MakeRun("run", Moved(), false));
  const FrameScene scene = SceneOf(run, 1);
  const cv::Mat image = DrawFrame(scene, world_.width);
  // Lines and chips cover less than half of the table.
  const cv::Mat table = Render(world_, world_.views[1]).plane_ids == 6;
  cv::Mat difference;
  cv::absdiff(image, scene.rgb, difference);
  cv::cvtColor(difference, difference, cv::COLOR_BGR2GRAY);
  EXPECT_LT(cv::countNonZero((difference > 0) & table), cv::countNonZero(table) / 2);
}

TEST_F(DrawRunFolder, SaysWhyThereAreNoErrorsWithoutTruePoses) {
  const fs::path run = MakeRun("run", Moved());
  fs::remove(seq() / "groundtruth.txt");
  EXPECT_THAT(DrawRun(run, {}).notes, ::testing::ElementsAre(HasSubstr("groundtruth.txt")));
}

TEST_F(DrawRunFolder, NamesAnInterruptedRunInItsTitle) {
  const fs::path folder = MakeRun("run", Moved());
  json info = json::parse(ReadText(folder / "run.json"));
  info["interrupted"] = true;
  info["sequence_frames"] = 300;
  WriteText(folder / "run.json", info.dump());
  const RunTitle title = TitleOf(ReadRun(folder), ReadSequence(seq()));
  EXPECT_EQ(title.run, "run");
  EXPECT_EQ(title.sequence, "seq");
  EXPECT_EQ(title.warning, "interrupted after 5 of 300 frames");
  EXPECT_THAT(DrawRun(folder, {}).notes, ::testing::Contains(HasSubstr(title.warning)));
}

TEST_F(DrawRunFolder, SpreadsTheFramesOfAnInterruptedRunOverWhatItSaw) {
  ::eval::Run run = ReadRun(MakeRun("run", Moved()));
  const Sequence sequence = ReadSequence(seq());
  run.frames.resize(2);
  EXPECT_EQ(FramesSeen(run, sequence), sequence.frames.size());
  run.info.interrupted = true;
  EXPECT_EQ(FramesSeen(run, sequence), 2u);
}

TEST_F(DrawRunFolder, CountsTheFramesOfAnInterruptedRunWithoutPlanesAsRunJsonDoes) {
  ::eval::Run run = ReadRun(MakeRun("run", Moved()));
  const Sequence sequence = ReadSequence(seq());
  run.frames.clear();
  run.info.interrupted = true;
  run.info.frames = 3;
  EXPECT_EQ(FramesSeen(run, sequence), 3u);
  run.info.frames = 300;
  EXPECT_EQ(FramesSeen(run, sequence), sequence.frames.size());
  run.info.frames.reset();
  EXPECT_EQ(FramesSeen(run, sequence), sequence.frames.size());
}

TEST_F(DrawRunFolder, FillsAnEmptyFolder) {
  const fs::path out = folder_.path() / "pictures";
  fs::create_directory(out);
  WritePictures({{"a.png", cv::Mat::zeros(4, 4, CV_8UC3)}}, out, false);
  EXPECT_TRUE(fs::exists(out / "a.png"));
}

TEST_F(DrawRunFolder, RemovesThePictureOfAnEarlierRunThatThisOneHasNot) {
  const fs::path out = folder_.path() / "pictures";
  const cv::Mat image = cv::Mat::zeros(4, 4, CV_8UC3);
  WritePictures({{"contact_sheet.png", image}, {"error_over_time.png", image}}, out, false);
  WritePictures({{"contact_sheet.png", image}}, out, true);
  EXPECT_FALSE(fs::exists(out / "error_over_time.png"));
}

TEST_F(DrawRunFolder, LeavesNothingBehindWhenAPictureCannotBeWritten) {
  const cv::Mat image = cv::Mat::zeros(4, 4, CV_8UC3);
  const std::string too_long(300, 'x');
  EXPECT_THROW(
      WritePictures({{"a.png", image}, {too_long, image}}, folder_.path() / "new", false),
      io::InputError);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_.path()), fs::directory_iterator()), 1)
      << "only the sequence";
}

TEST_F(DrawRunFolder, ReplacesNothingWhenOneOfThePicturesIsNoFile) {
  const fs::path out = folder_.path() / "pictures";
  WriteText(out / "contact_sheet.png", "mine");
  fs::create_directory(out / "b.png");
  const cv::Mat image = cv::Mat::zeros(4, 4, CV_8UC3);
  EXPECT_THAT(test_support::RefusalOf([&] {
                WritePictures({{"contact_sheet.png", image}, {"b.png", image}}, out, true);
              }),
              HasSubstr("b.png: is no regular file"));
  EXPECT_EQ(ReadText(out / "contact_sheet.png"), "mine");
  EXPECT_EQ(std::distance(fs::directory_iterator(out), fs::directory_iterator()), 2);
}

TEST_F(DrawRunFolder, DrawsColourThatIsJpeg) {
  const fs::path run = MakeRun("run", Moved());
  const auto before = Named(DrawRun(run, {}).pictures, "contact_sheet.png");
  for (const fs::directory_entry& image : fs::directory_iterator(seq() / "rgb")) {
    const cv::Mat pixels = test_support::ReadImageFile(image.path());
    const fs::path jpeg = fs::path(image.path()).replace_extension(".jpg");
    cv::imwrite(jpeg.string(), pixels, {cv::IMWRITE_JPEG_QUALITY, 100});
    fs::remove(image.path());
  }
  for (const char* name : {"rgb.txt", "associations.txt"}) {
    if (!fs::exists(seq() / name)) continue;
    std::string text = ReadText(seq() / name), png = ".png";
    for (std::size_t at = text.find("rgb/"); at != std::string::npos;
         at = text.find("rgb/", at + 1)) {
      text.replace(text.find(png, at), png.size(), ".jpg");
    }
    WriteText(seq() / name, text);
  }
  const auto after = Named(DrawRun(run, {}).pictures, "contact_sheet.png");
  ASSERT_EQ(before.size(), after.size());
  cv::Mat difference;
  cv::absdiff(before, after, difference);
  EXPECT_LT(cv::mean(difference)[0], 3);  // what JPEG does to flat colours
}

TEST(ColourOfPlane, TellsNeighbouringIdsApart) {
  for (int id = 0; id < 200; ++id) {
    for (int next = id + 1; next <= id + 4; ++next) {
      EXPECT_GT(cv::norm(ColourOfPlane(id) - ColourOfPlane(next)), 40) << id << " " << next;
    }
  }
}

TEST(SpreadEvenly, TakesTheFirstAndTheLastAndNoneTwice) {
  EXPECT_THAT(SpreadEvenly(100, 4), ::testing::ElementsAre(0, 33, 66, 99));
  EXPECT_THAT(SpreadEvenly(3, 12), ::testing::ElementsAre(0, 1, 2));
  EXPECT_THAT(SpreadEvenly(9, 1), ::testing::ElementsAre(0));
  EXPECT_TRUE(SpreadEvenly(0, 5).empty());
}

}  // namespace
}  // namespace eval
