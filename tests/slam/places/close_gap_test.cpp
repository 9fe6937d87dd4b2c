#include "slam/places/close_gap.h"

#include <gmock/gmock.h>

#include <cmath>
#include <vector>

#include "slam/model/map_queries.h"
#include "tests/support/map_surfaces.h"
#include "tests/support/slam_matchers.h"

namespace slam {
namespace {

/// A camera that goes along x past panels which do not tell its height, frame by frame, and then sees the
/// floor again. Its height is a random walk: each frame adds the same variance.
struct WalkAlongPanels {
  static constexpr double kStep_m2 = 0.0016, kSeen_m2 = 1e-6;
  Map map;

  /// @param known  keyframes that know their height
  /// @param open   those after them that do not
  WalkAlongPanels(int known, int open) {
    for (int k = 0; k < known + open; ++k)
      Add(k < known ? kSeen_m2 : kSeen_m2 + (k - known + 1) * kStep_m2);
  }
  Keyframe& Add(double height_m2) {
    Keyframe& keyframe = map.keyframes.emplace_back();
    keyframe.id = static_cast<int>(map.keyframes.size()) - 1;
    keyframe.frame_index = 10 * keyframe.id;
    keyframe.T_cw = Pose{ExpSo3({0.3, 0.1 * keyframe.id, -0.2}), {0.1 * keyframe.id, 0.4, 0.2}};
    const Eigen::Matrix3d& R_cw = keyframe.T_cw.R;
    const Eigen::Vector3d variances(1e-6, 1e-6, height_m2);
    keyframe.covariance.topLeftCorner<3, 3>() =
        R_cw * variances.asDiagonal() * R_cw.transpose();
    return keyframe;
  }
  /// What a frame tells that sees the floor: the one before, whose height has this variance, was so low.
  static FoundPlace Higher(double off_m, double before_m2, double after_m2 = kSeen_m2) {
    return {{0, 0, off_m},
            Eigen::Vector3d(1e-6, 1e-6, before_m2).asDiagonal(),
            Eigen::Vector3d(1e-6, 1e-6, after_m2).asDiagonal()};
  }
  /// The newest keyframe is that frame.
  int Find(const FoundPlace& found) {
    Add(found.after_w(2, 2)).found = found;
    return map.keyframes.back().id;
  }
  int Find(double off_m) {
    return Find(Higher(off_m, HeightVariance(map.keyframes.back().id)));
  }
  Eigen::Vector3d Centre(int keyframe) const { return Inverse(KeyframePose(map, keyframe)).t; }
  double HeightVariance(int keyframe) const {
    const Keyframe& k = map.keyframes[static_cast<std::size_t>(keyframe)];
    const Eigen::Vector3d up_c = k.T_cw.R * Eigen::Vector3d::UnitZ();
    return up_c.dot(k.covariance.topLeftCorner<3, 3>() * up_c);
  }
};

TEST(CloseGaps, MovesThePastAsTheJointDistributionOfARandomWalkDoes) {
  // Heights of a walk have the covariance min(i, j) of its steps; given that of the last one, those before
  // are where the normal distribution says.
  constexpr int kOpen = 6;
  constexpr double kFound_m2 = 4e-4;
  WalkAlongPanels walk(2, kOpen);
  Eigen::MatrixXd joint(kOpen, kOpen);
  for (int i = 0; i < kOpen; ++i)
    for (int j = 0; j < kOpen; ++j)
      joint(i, j) =
          WalkAlongPanels::kSeen_m2 + (std::min(i, j) + 1) * WalkAlongPanels::kStep_m2;
  const double walked_m2 = joint(kOpen - 1, kOpen - 1);
  const double after_m2 = walked_m2 * kFound_m2 / (walked_m2 + kFound_m2);
  const double off_m = 0.1;

  std::vector<Eigen::Vector3d> before;
  for (int k = 0; k < 2 + kOpen; ++k) before.push_back(walk.Centre(k));
  ASSERT_TRUE(
      CloseGaps(walk.map, walk.Find(WalkAlongPanels::Higher(off_m, walked_m2, after_m2))));
  for (int i = 0; i < kOpen; ++i) {
    const double share = joint(i, kOpen - 1) / walked_m2;
    const Eigen::Vector3d moved = walk.Centre(2 + i) - before[static_cast<std::size_t>(2 + i)];
    EXPECT_LT((moved - Eigen::Vector3d(0, 0, share * off_m)).norm(), 1e-12) << i;
    const double left_m2 =
        joint(i, i) - joint(i, kOpen - 1) * joint(i, kOpen - 1) / (walked_m2 + kFound_m2);
    EXPECT_NEAR(walk.HeightVariance(2 + i), left_m2, 1e-12) << i;
  }
  // Those who knew their height, and the new one, stay.
  EXPECT_EQ(walk.Centre(0), before[0]);
  EXPECT_LT((walk.Centre(1) - before[1]).norm(), 1e-4);
}

TEST(CloseGaps, CarriesWhatWasFirstSeenOnTheWayAndNothingElse) {
  WalkAlongPanels walk(3, 5);
  MapPlane floor, shelf;
  floor.pi_w = shelf.pi_w = {Eigen::Vector3d::UnitZ(), 0.0};
  floor.first_frame = 0, shelf.first_frame = 70;
  shelf.estimate.world_variance_m2 = WalkAlongPanels::kSeen_m2 + 5 * WalkAlongPanels::kStep_m2;
  AddLandmark(walk.map, floor);
  AddLandmark(walk.map, shelf);
  // An edge of the floor that came into view late.
  SupposedPlane edge;
  edge.pi_w = {Eigen::Vector3d::UnitZ(), -0.5};
  edge.first_frame = 70;
  walk.map.planes.At(0).supposed = {edge};
  for (const int keyframe : {1, 7}) {
    MapPoint point;
    point.id = static_cast<int>(walk.map.points.size());
    point.first_keyframe = keyframe;
    walk.map.points.push_back(point);
  }
  ASSERT_TRUE(CloseGaps(walk.map, walk.Find(0.1)));
  EXPECT_NEAR(walk.map.planes.At(0).pi_w.d, 0.0, 1e-12);
  EXPECT_NEAR(walk.map.planes.At(1).pi_w.d, -0.1, 1e-12);
  EXPECT_NEAR(walk.map.planes.At(1).estimate.world_variance_m2, WalkAlongPanels::kSeen_m2,
              1e-8);
  EXPECT_NEAR(walk.map.planes.At(0).supposed[0].pi_w.d, -0.6, 1e-12);
  EXPECT_NEAR(walk.map.points[0].p_w.z(), 0.0, 1e-4);
  EXPECT_NEAR(walk.map.points[1].p_w.z(), 0.1, 1e-12);
}

TEST(CloseGaps, TeachASupposedPlaneByTheWayThatItFacesItself) {
  // What the height tells is news of an edge that faces up, whatever its landmark faces; one that
  // faces aside is known as before.
  WalkAlongPanels walk(3, 5);
  const double before_m2 = WalkAlongPanels::kSeen_m2 + 5 * WalkAlongPanels::kStep_m2;
  const auto with_edge = [&](const Eigen::Vector3d& n_w, const Eigen::Vector3d& edge_n_w) {
    MapPlane plane;
    plane.pi_w = {n_w, -1.0};
    SupposedPlane edge;
    edge.pi_w = {edge_n_w, -0.5};
    edge.first_frame = 70;
    edge.estimate.world_variance_m2 = before_m2;
    plane.supposed = {edge};
    return AddLandmark(walk.map, plane);
  };
  const Eigen::Vector3d aside = Eigen::Vector3d::UnitX(), up = Eigen::Vector3d::UnitZ();
  const int wall = with_edge(aside, up), floor = with_edge(up, aside);
  ASSERT_TRUE(CloseGaps(walk.map, walk.Find(0.1)));
  const auto variance_m2 = [&](int plane) {
    return walk.map.planes.At(plane).supposed[0].estimate.world_variance_m2;
  };
  EXPECT_NEAR(variance_m2(wall), WalkAlongPanels::kSeen_m2, 1e-8);
  EXPECT_NEAR(variance_m2(floor), before_m2, 1e-12);
}

TEST(CloseGaps, ReachesBackNoFartherThanWhereTheCameraKnewItsPlace) {
  WalkAlongPanels walk(2, 5);
  walk.Add(WalkAlongPanels::kSeen_m2);  // the floor was in view in between
  for (int k = 1; k <= 5; ++k) walk.Add(k * WalkAlongPanels::kStep_m2);
  const Eigen::Vector3d earlier = walk.Centre(6), later = walk.Centre(12);
  ASSERT_TRUE(CloseGaps(walk.map, walk.Find(-0.1)));
  EXPECT_LT((walk.Centre(6) - earlier).norm(), 1e-4);
  EXPECT_NEAR((walk.Centre(12) - later).z(), -0.1, 1e-12);
}

TEST(CloseGaps, MovesAKeyframeByItsShareOfWhatTheLastFrameDidNotKnow) {
  // Frames went on after the newest keyframe of the way, which knew its height four times as well.
  WalkAlongPanels walk(2, 3);
  const Eigen::Vector3d before = walk.Centre(4);
  const int keyframe = walk.Find(WalkAlongPanels::Higher(0.1, 4 * walk.HeightVariance(4)));
  ASSERT_TRUE(CloseGaps(walk.map, keyframe));
  EXPECT_NEAR((walk.Centre(4) - before).z(), 0.025, 1e-12);
}

// Nobody keeps up what a culled keyframe knew: it must not stand between the others and the gap.
TEST(CloseGaps, MovesTheOthersAsIfACulledKeyframeWereNotThere) {
  WalkAlongPanels whole(2, 6), without(2, 6);
  Keyframe& culled = without.map.keyframes[5];
  culled.culled = true;
  culled.parent = 4;
  culled.T_cp = culled.T_cw * Inverse(without.map.keyframes[4].T_cw);
  culled.covariance *= 0.01;
  const Eigen::Vector3d before = without.Centre(5) - without.Centre(4);
  ASSERT_TRUE(CloseGaps(whole.map, whole.Find(0.1)));
  ASSERT_TRUE(CloseGaps(without.map, without.Find(0.1)));
  for (const int k : {2, 3, 4, 6, 7}) {
    EXPECT_THAT(without.Centre(k), VectorNear(whole.Centre(k), 1e-12)) << k;
    EXPECT_NEAR(without.HeightVariance(k), whole.HeightVariance(k), 1e-12) << k;
  }
  // It goes where its parent does.
  EXPECT_THAT(without.Centre(5) - without.Centre(4), VectorNear(before, 1e-12));
}

// Of a slanted surface a height tells its share of the normal, squared.
TEST(CloseGaps, TeachASlantedPlaneByHowMuchItFacesUp) {
  WalkAlongPanels walk(3, 5);
  constexpr double kBefore_m2 = 0.02;
  const double told_m2 = 5 * WalkAlongPanels::kStep_m2;
  for (const double slant_rad : {0.0, 0.5, 1.0, 1.5}) {
    MapPlane plane;
    plane.pi_w = {{std::sin(slant_rad), 0, std::cos(slant_rad)}, -1.0};
    plane.first_frame = 70;
    plane.estimate.world_variance_m2 = kBefore_m2;
    AddLandmark(walk.map, plane);
  }
  ASSERT_TRUE(CloseGaps(walk.map, walk.Find(0.1)));
  for (const MapPlane& plane : walk.map.planes) {
    const double up = plane.pi_w.n.z();
    EXPECT_NEAR(plane.estimate.world_variance_m2, kBefore_m2 - up * up * told_m2, 1e-8) << up;
  }
}

TEST(CloseGaps, LeavesAloneWhatIsNoNewsAndWhatIsNotCredible) {
  const auto closes = [](double off_m, double after_m2) {
    WalkAlongPanels walk(2, 4);  // known to 80 mm
    const FoundPlace found = WalkAlongPanels::Higher(off_m, walk.HeightVariance(5), after_m2);
    const bool told = ClosesGap(found);
    EXPECT_EQ(CloseGaps(walk.map, walk.Find(found)), told);
    return told;
  };
  EXPECT_TRUE(closes(0.1, 1e-6));
  EXPECT_FALSE(closes(0.1, 2e-3));     // hardly better known than before
  EXPECT_FALSE(closes(0.0025, 1e-6));  // as well where motion led
  EXPECT_FALSE(closes(0.5, 1e-6));     // more than five times what it may be off
}

TEST(FoundOff, SharesWhatIsFoundBetweenWhereTheCameraWasAndHowItMoved) {
  // Where it was is known to 30 mm along x and to nothing's width along y; it may have moved by 40 mm, 20 mm.
  const Eigen::Matrix3d before_w = Eigen::Vector3d(9e-4, 0, 1e-4).asDiagonal();
  const Eigen::Matrix3d motion_w = Eigen::Vector3d(16e-4, 4e-4, 1e-4).asDiagonal();
  const FoundPlace found =
      FoundOff({0.05, 0.05, 0.02}, 1e-6 * Eigen::Matrix3d::Identity(), before_w, motion_w);
  EXPECT_THAT(found.off_w, VectorNear(Eigen::Vector3d(0.018, 0, 0.01), 1e-12));
  EXPECT_EQ(found.before_w, before_w);
  const Eigen::Vector3d known = found.after_w.diagonal();
  EXPECT_THAT(known, VectorNear(Eigen::Vector3d(1.601e-3, 4.01e-4, 1.01e-4), 1e-12));
  // Of the frame that is the world, and of one that cannot have moved, nothing is found off.
  EXPECT_EQ(
      FoundOff({1, 1, 1}, before_w, Eigen::Matrix3d::Zero(), Eigen::Matrix3d::Zero()).off_w,
      Eigen::Vector3d::Zero());
}

TEST(CloseGaps, HasNothingToDoWhereNothingIsTold) {
  EXPECT_FALSE(ClosesGap({}));
  WalkAlongPanels walk(0, 0);
  EXPECT_FALSE(CloseGaps(walk.map, walk.Find(FoundPlace{})));
}

}  // namespace
}  // namespace slam
