// Frame planes, corners, segments and map planes that are wrong in one known way each: the
// figures that ought to move do, and no others.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "eval/planes/true_frame.h"
#include "tests/eval/report/evaluated_world.h"

namespace eval {
namespace {

using ::testing::HasSubstr;
using testing::TinyRun;

TEST_F(EvaluateTinyWorld, AFramePlaneThatShowsItsBackIsTurnedRoundWithAWarning) {
  // With label images, and without them, where the normal tells which true plane it is.
  for (const bool by_pixels : {true, false}) {
    TinyRun run(*world_);
    if (!by_pixels) run.segmentation.clear();
    const nlohmann::json before = Metrics(run);
    for (auto& frame : run.frames) {
      for (auto& plane : frame["planes"]) {
        for (auto& component : plane["normal"]) component = -component.get<double>();
        plane["d"] = -plane["d"].get<double>();
      }
    }
    const nlohmann::json after = Metrics(run);
    EXPECT_EQ(Moved(before, after), Keys{});
    EXPECT_THAT(after["warnings"][0].get<std::string>(), HasSubstr("has d > 0"));
  }
}

TEST_F(EvaluateTinyWorld, AFramePlaneOnATruthThatDoesNotCountHasNoSayInTheParameters) {
  TinyRun run(*world_);
  const nlohmann::json before = Metrics(run);
  const Sequence sequence = ReadSequence(SequenceFolder());
  int turned = 0;
  for (std::size_t i = 0; i < world_->frames.size(); ++i) {
    const testing::TinyFrame& frame = world_->frames[i];
    for (const SeenPlane& seen : ReadTrueFrame(sequence, frame.stamp_s, frame.T_gc).planes) {
      nlohmann::json* plane = seen.counted ? nullptr : FramePlane(run, i, seen.plane->id);
      if (plane == nullptr) continue;
      for (auto& component : (*plane)["normal"]) component = -component.get<double>();
      (*plane)["d"] = -(*plane)["d"].get<double>();
      ++turned;
    }
  }
  ASSERT_GT(turned, 0);
  EXPECT_EQ(Moved(before, Metrics(run)), Keys{});
}

TEST_F(EvaluateTinyWorld, AMapPlaneWithTheWrongSignOfItsDistanceIsFarFromItsTruth) {
  TinyRun run(*world_);
  const nlohmann::json before = Metrics(run);
  for (auto& plane : run.map["planes"]) plane["d"] = -plane["d"].get<double>();
  const nlohmann::json after = Metrics(run);
  EXPECT_EQ(Moved(before, after), (Keys{"map/offset_mm", "map/consistency"}));
  EXPECT_GT(after["map"]["offset_mm"]["median"].get<double>(), 100.0);
}

TEST_F(EvaluateTinyWorld, CornersOffByAFewMillimetresShowAsSuchAndFarOnesAsMissing) {
  TinyRun near(*world_), far(*world_);
  const nlohmann::json before = Metrics(near);
  const auto shift = [](TinyRun& run, double by_m) {
    for (auto& frame : run.frames) {
      for (auto& plane : frame["planes"]) {
        for (auto& corner : plane["vertices"]) corner[0] = corner[0].get<double>() + by_m;
      }
    }
  };
  shift(near, 0.004);
  const nlohmann::json after = Metrics(near);
  EXPECT_EQ(Moved(before, after), Keys{"vertices/error_mm"});
  EXPECT_NEAR(after["vertices"]["error_mm"]["median"].get<double>(), 4.0, kExact_mm);
  shift(far, 5.0);
  const nlohmann::json lost = Metrics(far);
  EXPECT_EQ(lost["vertices"]["precision"], 0.0);
  EXPECT_EQ(lost["vertices"]["recall"], 0.0);
  EXPECT_EQ(lost["vertices"]["planes_with_4"], 0.0);
  EXPECT_TRUE(lost["vertices"].at("error_mm").is_null());
}

TEST_F(EvaluateTinyWorld, ASegmentThatSwallowsABookIsUnderSegmentedAndNotMissedOnly) {
  TinyRun run(*world_);
  for (std::size_t i = 0; i < run.frames.size(); ++i) {
    const auto* desk = FramePlane(run, i, TinyWorld::kDeskTop);
    const auto* book = FramePlane(run, i, TinyWorld::kThinTop);
    ASSERT_TRUE(desk != nullptr && book != nullptr);
    const int from = (*book)["index"].get<int>() + 1, to = (*desk)["index"].get<int>() + 1;
    run.segmentation[i].setTo(to, run.segmentation[i] == from);
    auto& planes = run.frames[i]["planes"];
    planes.erase(planes.begin() + (from - 1));
  }
  const nlohmann::json after = Metrics(run);
  EXPECT_GT(after["extraction"]["under"].get<double>(), 0.9);
  EXPECT_LT(after["extraction"]["pixel_precision"].get<double>(), 1.0);
  EXPECT_LT(after["extraction"]["pq"].get<double>(), 1.0);
  EXPECT_EQ(after["association"]["decision"]["precision"], 1.0);
}

TEST_F(EvaluateTinyWorld, APlaneInTwoPiecesIsOverSegmentedAndNotUnder) {
  TinyRun run(*world_);
  for (std::size_t i = 0; i < run.frames.size(); ++i) {
    const auto* desk = FramePlane(run, i, TinyWorld::kDeskTop);
    ASSERT_NE(desk, nullptr);
    auto& planes = run.frames[i]["planes"];
    nlohmann::json piece = *desk;
    piece["index"] = planes.size();
    const int half = piece["index"].get<int>() + 1, whole = (*desk)["index"].get<int>() + 1;
    auto left = run.segmentation[i].colRange(0, run.segmentation[i].cols / 2);
    left.setTo(half, left == whole);
    planes.push_back(piece);
  }
  const nlohmann::json after = Metrics(run);
  EXPECT_GT(after["extraction"]["evops"]["osr"].get<double>(), 0.0);
  EXPECT_EQ(after["extraction"]["evops"]["usr"], 0.0);
}

TEST_F(EvaluateTinyWorld, APlaneOnTheToyIsNoiseUnlessTheRunDistrustsIt) {
  TinyRun run(*world_);
  const nlohmann::json before = Metrics(run);
  nlohmann::json plane = run.frames[20]["planes"][0];
  plane["index"] = 40;
  plane["map_plane"] = nullptr;
  plane["decision"] = "none";
  plane["vertices"] = nlohmann::json::array();
  run.frames[20]["planes"].push_back(plane);
  cv::Mat1b& labels = run.segmentation[20];
  labels.setTo(41, world_->frames[20].object_ids == TinyWorld::kToy);
  nlohmann::json after = Metrics(run);
  EXPECT_EQ(Moved(before, after),
            (Keys{"extraction/machine", "extraction/noise", "extraction/pq", "extraction/rq",
                  "extraction/pixel_precision", "extraction/ri", "extraction/voi_bits",
                  "extraction/sc", "extraction/evops"}));
  run.frames[20]["planes"].back()["bad"] = "unstructured";
  EXPECT_EQ(Moved(before, Metrics(run)), Keys{});
}

TEST_F(EvaluateTinyWorld, WithoutMasksTrackingDoesNotDependOnTheIdsOfMapPlanes) {
  const auto association_with = [](int piece_id) {
    TinyRun run(*world_);
    run.segmentation.clear();
    // A corner of the desk is a second map plane, in every other frame.
    bool made = false;
    for (std::size_t i = 0; i < run.frames.size(); i += 2) {
      nlohmann::json piece = *FramePlane(run, i, TinyWorld::kDeskTop);
      piece["index"] = 200;
      piece["pixels"] = piece["pixels"].get<int>() / 4;
      piece["map_plane"] = piece_id;
      piece["decision"] = made ? "matched" : "new";
      made = true;
      run.frames[i]["planes"].push_back(piece);
    }
    nlohmann::json piece = MapPlane(run, TinyWorld::kDeskTop);
    piece["id"] = piece_id;
    run.map["planes"].push_back(piece);
    return Metrics(run)["association"];
  };
  const nlohmann::json low = association_with(3), high = association_with(4711);
  EXPECT_EQ(low, high);
  EXPECT_EQ(low["id_switches"], 0);
  EXPECT_LT(low["mota"].get<double>(), 1.0);
}

TEST_F(EvaluateTinyWorld, WithoutMasksTheGeometryFindsTheSameTruthAndPixelFiguresAreAbsent) {
  TinyRun run(*world_);
  const nlohmann::json before = Metrics(run);
  run.segmentation.clear();
  const nlohmann::json after = Metrics(run);
  EXPECT_EQ(Moved(before, after),
            (Keys{"extraction/truth", "extraction/machine", "extraction/correct",
                  "extraction/over", "extraction/under", "extraction/missed",
                  "extraction/noise", "extraction/pq", "extraction/sq", "extraction/rq",
                  "extraction/pixel_precision", "extraction/pixel_recall",
                  "extraction/correct_ratio", "extraction/correct_pixel_ratio", "extraction/ri",
                  "extraction/voi_bits", "extraction/sc", "extraction/evops"}));
  EXPECT_TRUE(after["extraction"].at("pq").is_null());
  EXPECT_TRUE(after["extraction"].contains("normal_deg"));
  EXPECT_THAT(after["rules"]["truth_of_a_frame_plane"].get<std::string>(),
              HasSubstr("no segmentation images"));
  EXPECT_FALSE(before.contains("warnings"));
  EXPECT_THAT(after.at("warnings"), ElementsAre(HasSubstr("pas slam --save-segmentation")));
}

TEST_F(EvaluateTinyWorld, AFramePlaneThatTheRunDistrustsHasNoSayInParametersAndCorners) {
  TinyRun honest(*world_), wild(*world_);
  for (std::size_t i = 0; i < honest.frames.size(); ++i) {
    for (TinyRun* run : {&honest, &wild}) {
      nlohmann::json* book = FramePlane(*run, i, TinyWorld::kThickTop);
      ASSERT_NE(book, nullptr);
      (*book)["bad"] = "far";
      (*book)["map_plane"] = nullptr;
      (*book)["decision"] = "none";
      if (run == &honest) continue;
      for (auto& component : (*book)["normal"]) component = -component.get<double>();
      (*book)["d"] = 0.5 - (*book)["d"].get<double>();
      (*book)["vertices"] = nlohmann::json::array();
    }
  }
  const nlohmann::json before = Metrics(honest), after = Metrics(wild);
  EXPECT_NEAR(after["extraction"]["normal_deg"]["p95"].get<double>(), 0.0, 1e-6);
  EXPECT_EQ(Moved(before, after), Keys{});
}

}  // namespace
}  // namespace eval
