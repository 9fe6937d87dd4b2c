// A wall that fills the picture, and surfaces of the map that differ from it in one thing each.
#include <gtest/gtest.h>

#include <optional>
#include <string>

#include "slam/associate/associate_planes.h"
#include "slam/associate/pair_evidence.h"
#include "tests/support/map_surfaces.h"

namespace slam {
namespace {

constexpr double kWall_m = 1.0;

struct WallInSight {
  Camera camera;
  AssociationConfig config;
  Frame frame;
  Map map;

  explicit WallInSight(const std::string& class_name = "book") {
    frame.depth_m = cv::Mat1f(camera.height, camera.width, static_cast<float>(kWall_m));
    frame.plane_labels = cv::Mat1b(camera.height, camera.width, std::uint8_t{0});
    frame.pose_covariance = 1e-12 * Matrix6d::Identity();
    AddPiece({0, 0, camera.width, camera.height});
    frame.planes[0].class_name = class_name;
  }
  /// The wall's pixels there are a plane of the frame.
  void AddPiece(const cv::Rect& where) {
    FramePlane piece;
    piece.index = static_cast<int>(frame.planes.size());
    piece.pi_c = {-Eigen::Vector3d::UnitZ(), kWall_m};
    piece.centroid_c = PointAt(where.x + where.width / 2, where.y + where.height / 2);
    piece.pixel_count = where.area();
    piece.area_m2 = where.area() * kWall_m * kWall_m / (camera.fx * camera.fy);
    piece.offset_sigma_m = 0.0005, piece.angle_sigma_rad = 0.002;
    frame.plane_labels(where).setTo(piece.index + 1);
    frame.planes.push_back(piece);
  }
  Eigen::Vector3d PointAt(double u_px, double v_px) const {
    return camera.Backproject({u_px, v_px}, kWall_m);
  }
  /// What the map has there, known to the tenth of a millimetre. @returns its id
  int Know(const std::string& class_name, LandmarkStatus status = LandmarkStatus::kLandmark,
           double off_m = 0.0, double beside_px = 0.0) {
    MapPlane m;
    m.status = status;
    m.pi_w = {-Eigen::Vector3d::UnitZ(), kWall_m + off_m};
    const Eigen::Vector3d off(0, 0, off_m);
    for (int v = 8; v < camera.height; v += 16)
      for (int u = 8; u < camera.width; u += 16)
        m.points_w.push_back(PointAt(u + beside_px, v) + off);
    m.hull_w = {m.points_w.front(), m.points_w.back()};
    m.area_m2 = camera.width * camera.height / (camera.fx * camera.fy);
    m.centroid_w = off + PointAt(camera.cx + beside_px, camera.cy);
    AddObservation(m.estimate, m.pi_w, m.centroid_w, 1e-4, 1e-4, 1.0);
    if (!class_name.empty()) {
      m.class_name = class_name;
      m.class_belief[class_name] = 20.0;
    }
    return map.planes.Add(m).id;
  }
  /// Frames have shown a step between the two, whenever they showed both.
  void SeeStep(int one, int other) {
    for (const auto& [m, n] : {std::pair(one, other), std::pair(other, one)})
      map.planes.At(m).covisible[n] = map.planes.At(m).stepped[n] = 10;
  }
  /// What costs more than a class that is another one's is in doubt.
  void DoubtClasses() { config.max_chi2 = 3.0, config.overlap_weight = 1.0; }
  PlaneMatch Decide(std::size_t f = 0) const {
    return AssociatePlanes(frame, map, camera, config).matches.at(f);
  }
};

/// Its box is the wall's half, and half of it.
void DetectLeftHalf(WallInSight& wall) {
  Detection half;
  half.class_name = "book";
  half.box_px = {{0, 0}, {319, 479}};
  wall.frame.detections = {half};
  wall.frame.planes[0].detection = 0;
}

TEST(WhatDecides, IsTheCueInWhichTheRunnerUpDiffers) {
  WallInSight alone;
  alone.Know("book");
  EXPECT_EQ(alone.Decide().reason, MatchReason::kParameters);

  WallInSight by_height;
  const int wall = by_height.Know("book");
  by_height.Know("book", LandmarkStatus::kLandmark, 0.005);
  EXPECT_EQ(by_height.Decide().map_plane, wall);
  EXPECT_EQ(by_height.Decide().reason, MatchReason::kParameters);

  WallInSight by_place;
  by_place.Know("book");
  by_place.Know("book", LandmarkStatus::kLandmark, 0.0, 700.0);
  EXPECT_EQ(by_place.Decide().reason, MatchReason::kOverlap);

  WallInSight by_class;
  by_class.Know("cup");
  const int book = by_class.Know("book");
  EXPECT_EQ(by_class.Decide().map_plane, book);
  EXPECT_EQ(by_class.Decide().reason, MatchReason::kClass);

  WallInSight by_box;
  DetectLeftHalf(by_box);
  by_box.config.iou_weight = 20.0;
  const int whole = by_box.Know("book"), half = by_box.Know("book");
  by_box.map.planes.At(half).hull_w = {by_box.PointAt(0, 0), by_box.PointAt(319, 479)};
  by_box.SeeStep(whole, half);
  EXPECT_EQ(by_box.Decide().map_plane, half);
  EXPECT_EQ(by_box.Decide().reason, MatchReason::kBox);
}

TEST(WhatDecides, IsTheDearestCueOfARunnerUpThatAllOfThemTogetherPutInDoubt) {
  WallInSight wall;
  wall.DoubtClasses();
  wall.Know("cup");
  const int book = wall.Know("book");
  EXPECT_EQ(wall.Decide().map_plane, book);
  EXPECT_EQ(wall.Decide().reason, MatchReason::kClass);
}

TEST(WhatDecides, IsNotAskedOfTheMatchFoundTwice) {
  WallInSight wall;
  wall.Know("book"), wall.Know("book");
  wall.Know("book", LandmarkStatus::kLandmark, 0.0, 700.0);
  EXPECT_EQ(wall.Decide().decision, PlaneDecision::kMatched);
  EXPECT_EQ(wall.Decide().reason, MatchReason::kOverlap);
}

TEST(TwoLandmarksAlike, AreOneFoundTwiceUnlessAStepWasSeenBetweenThem) {
  WallInSight wall;
  const int one = wall.Know("book"), other = wall.Know("book");
  EXPECT_EQ(wall.Decide().decision, PlaneDecision::kMatched);
  wall.SeeStep(one, other);
  EXPECT_EQ(wall.Decide().decision, PlaneDecision::kUnmatched);
  EXPECT_EQ(wall.Decide().reason, MatchReason::kAmbiguous);
}

TEST(ACandidate, TakesNothingWhereALandmarkIsInDoubt) {
  for (const LandmarkStatus status : {LandmarkStatus::kLandmark, LandmarkStatus::kCandidate}) {
    WallInSight wall;
    wall.DoubtClasses();
    wall.Know("cup", status);
    const int book = wall.Know("book", LandmarkStatus::kCandidate);
    const PlaneMatch match = wall.Decide();
    if (status == LandmarkStatus::kLandmark) {
      EXPECT_EQ(match.decision, PlaneDecision::kUnmatched);
      EXPECT_EQ(match.reason, MatchReason::kAmbiguous);
    } else {
      EXPECT_EQ(match.decision, PlaneDecision::kTrial) << "another candidate is no landmark";
      EXPECT_EQ(match.map_plane, book);
    }
  }
}

TEST(ACandidate, IsTriedThoughItWasFoundTwice) {
  WallInSight wall;
  wall.Know("book", LandmarkStatus::kCandidate);
  wall.Know("book", LandmarkStatus::kCandidate);
  EXPECT_EQ(wall.Decide().decision, PlaneDecision::kTrial);
}

TEST(AFragment, ThatIsAPieceOfTheSameSurfaceIsMatchedHoweverSmall) {
  WallInSight wall("");
  wall.AddPiece({0, 0, 64, 64});
  const int landmark = wall.Know("");
  for (const std::size_t f : {0u, 1u}) {
    EXPECT_EQ(wall.Decide(f).decision, PlaneDecision::kMatched) << f;
    EXPECT_EQ(wall.Decide(f).map_plane, landmark) << f;
  }
}

// A fault of its corners says nothing against where a plane lies.
TEST(APlaneWithAFault, IsMatchedWhereTheFaultIsOneOfCorners) {
  for (const auto& [fault, expected] :
       {std::pair(BadReason::kFar, PlaneDecision::kUnmatched),
        {BadReason::kInliers, PlaneDecision::kUnmatched},
        {BadReason::kBorder, PlaneDecision::kMatched},
        {BadReason::kStructure, PlaneDecision::kMatched},
        {BadReason::kUnstructured, PlaneDecision::kUnmatched}}) {
    WallInSight wall;
    wall.Know("book");
    wall.frame.planes[0].bad = fault;
    EXPECT_EQ(wall.Decide().decision, expected) << static_cast<int>(fault);
  }
}

TEST(OtherRules, TakeTheNearestLandmarkElseTheNearestCandidateAndNothingThatWasMerged) {
  for (const AssociationRule rule :
       {AssociationRule::kParameters, AssociationRule::kManhattanSlam,
        AssociationRule::kPlanarSlam, AssociationRule::kSpSlam}) {
    WallInSight wall;
    wall.config.rule = rule;
    wall.frame.planes[0].edge_points = {{wall.PointAt(0, 0), {0, 0}}};
    wall.Know("", LandmarkStatus::kMerged);
    EXPECT_EQ(wall.Decide().decision, PlaneDecision::kUnmatched);
    wall.Know("", LandmarkStatus::kCandidate, 0.003);
    const int candidate = wall.Know("", LandmarkStatus::kCandidate, 0.001);
    EXPECT_EQ(wall.Decide().decision, PlaneDecision::kTrial);
    EXPECT_EQ(wall.Decide().map_plane, candidate);
    wall.Know("", LandmarkStatus::kLandmark, 0.03);
    const int nearer = wall.Know("", LandmarkStatus::kLandmark, -0.02);
    wall.Know("", LandmarkStatus::kLandmark, 0.025);
    EXPECT_EQ(wall.Decide().decision, PlaneDecision::kMatched);
    EXPECT_EQ(wall.Decide().map_plane, nearer) << static_cast<int>(rule);
  }
}

TEST(WeighedPairs, ChargeForALittleShareNoMoreThanForFootprintsThatDoNotMeet) {
  WallInSight wall("");
  const int whole = wall.Know(""), patch = wall.Know("");
  MapPlane& small = wall.map.planes.At(patch);
  small.points_w.resize(30), small.area_m2 = 1e-5;
  const UncertainPose pose{wall.frame.T_cw, *wall.frame.pose_covariance};
  PairRefusals refused;
  const PairTable pairs =
      WeighPairs(wall.frame, wall.map, pose, pose, wall.camera, wall.config, refused);
  ASSERT_EQ(pairs.at(0).size(), 2u);
  EXPECT_EQ(pairs[0][static_cast<std::size_t>(whole)].share_cost, 0.0);
  EXPECT_DOUBLE_EQ(pairs[0][static_cast<std::size_t>(patch)].share_cost,
                   wall.config.overlap_weight);
}

TEST(RankTestOfPairs, IsNotAskedWhereMostOfTheFootprintIsShared) {
  WallInSight wall("");
  const int landmark = wall.Know("");
  // Features on the left of the wall, points of the map on its right.
  for (int k = 0; k < 40; ++k) {
    PointFeature feature;
    feature.u_px = {20.0 + 3 * k, 40.0 + 10 * k};
    feature.depth_m = kWall_m;
    wall.frame.features.push_back(feature);
    MapPoint point;
    point.id = k;
    point.p_w = wall.PointAt(400 + 5 * k, 40 + 10 * k);
    wall.map.points.push_back(point);
    wall.map.planes.At(landmark).map_points.insert(k);
  }
  for (const double overlap : {0.4, 0.59, 0.61, 1.0}) {
    PairEvidence pair;
    pair.map_plane = landmark, pair.verdict = PairVerdict::kPossible, pair.overlap = overlap;
    PairTable pairs{{pair}};
    TestRanks(wall.frame, wall.map, wall.frame.T_cw, wall.camera, wall.config, pairs);
    const bool doubted = overlap < 0.6;
    EXPECT_EQ(pairs[0][0].verdict, doubted ? PairVerdict::kDoubtful : PairVerdict::kPossible)
        << overlap;
    if (doubted) {
      EXPECT_EQ(pairs[0][0].refusal, PairRefusal::kRankTest);
    }
  }
}

}  // namespace
}  // namespace slam
