#include "slam/pose/plane_constraints.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "slam/pose/factors/plane.h"
#include "tests/support/map_surfaces.h"
#include "tests/support/slam_matchers.h"

namespace slam {
namespace {

using ::testing::ElementsAre;

/// A book's top that fills its box, matched with landmark 0, from a turned camera.
struct SeenBook {
  Camera camera;
  Pose T_cw{ExpSo3({0.3, -0.2, 0.4}), {0.2, 0.1, 0.3}};
  Frame frame;
  Map map;
  PlaneConstraintConfig config;

  SeenBook() {
    frame.T_cw = T_cw;
    FramePlane plane;
    plane.pi_c = {Eigen::Vector3d(0, 0, -1), 2.0};
    plane.centroid_c = {0.1, -0.1, 2.0};
    plane.offset_sigma_m = 0.001, plane.angle_sigma_rad = 0.002;
    plane.area_m2 = 0.1;
    plane.box_px = {{100, 120}, {300, 280}};
    plane.detection = 0;
    plane.class_name = "book";
    for (const Eigen::Vector2d& u_px : {Eigen::Vector2d(100, 200), Eigen::Vector2d(200, 120),
                                        Eigen::Vector2d(300, 200), Eigen::Vector2d(200, 280)}) {
      for (int i = 0; i < 4; ++i)
        plane.edge_points.push_back({Eigen::Vector3d::Zero(), u_px, EdgeKind::kSurface});
    }
    frame.planes = {plane};
    frame.plane_matches = {{PlaneDecision::kMatched, 0, MatchReason::kBox}};
    frame.detections.resize(1);
    frame.detections[0].class_name = "book";
    frame.detections[0].box_px = plane.box_px;
    AddLandmark(map, Landmark({0, 0, -1}));
    map.planes.At(0).vertices_w.assign(4, Eigen::Vector3d::Zero());
  }

  /// @param n_c  its normal as it should be seen
  MapPlane Landmark(const Eigen::Vector3d& n_c) const {
    MapPlane m;
    m.pi_w.n = T_cw.R.transpose() * n_c.normalized();
    m.area_m2 = 1.0;
    m.observations = 50;
    return m;
  }
  PoseProblem Problem() const {
    PoseProblem problem;
    AddPlaneConstraints(frame, map, camera, config, problem);
    return problem;
  }
  std::array<bool, 4> Sides() const {
    const PoseProblem problem = Problem();
    return problem.boxes.empty() ? std::array<bool, 4>{} : problem.boxes[0].use;
  }
};

// planar-slam and sp-slam ask no side: the pose must not turn about to see the front.
TEST(PlaneConstraint, OfALandmarkSeenFromBehindIsMetAtTheTruePose) {
  const FramePlane seen = SeenBook().frame.planes[0];
  for (const Eigen::Vector3d& turn :
       {Eigen::Vector3d(0.3, -0.2, 0.4), Eigen::Vector3d(0, 1.2, 0),
        Eigen::Vector3d(-1, 0.9, 2), Eigen::Vector3d(3, 0, 0.2)}) {
    const Pose T_cw{ExpSo3(turn), {0.2, 0.1, 0.3}};
    const Plane front_w = Transform(Inverse(T_cw), seen.pi_c);
    for (const double side : {1.0, -1.0}) {
      MapPlane m;
      m.pi_w = {side * front_w.n, side * front_w.d};
      const PlaneConstraint c = MakePlaneConstraint(seen, m, T_cw, 0.001, 0.002);
      const Linearised<4> at_truth = PlaneFactor(c, T_cw);
      EXPECT_TRUE(at_truth.valid) << side << " turned by " << turn.transpose();
      EXPECT_LT(at_truth.r.norm(), 1e-12) << side << " turned by " << turn.transpose();
    }
  }
}

TEST(BoxConstraints, TakeEverySideThatTheFaceReachesInsideTheImage) {
  SeenBook book;
  EXPECT_THAT(book.Sides(), ElementsAre(true, true, true, true));
  book.frame.detections[0].box_px.max.x() += book.config.max_box_gap_px + 1;
  EXPECT_THAT(book.Sides(), ElementsAre(true, true, false, true));
}

/// All sides but one.
std::array<bool, 4> AllBut(std::size_t side) {
  std::array<bool, 4> sides{true, true, true, true};
  sides[side] = false;
  return sides;
}

// The box ends with the image there. In a wide and in a high image, at 3 px from the border and at 6.
TEST(BoxConstraints, LeaveOutTheSideAtWhichTheImageEnds) {
  for (const bool high : {false, true}) {
    for (std::size_t side = 0; side < 4; ++side) {
      for (const double inside_px : {3.0, 6.0}) {
        SeenBook book;
        if (high) std::swap(book.camera.width, book.camera.height);
        const Box image = book.camera.ImageBox();
        FramePlane& plane = book.frame.planes[0];
        const int axis = static_cast<int>(side % 2);
        Eigen::Vector2d shift = Eigen::Vector2d::Zero();
        shift[axis] = side < 2 ? image.min[axis] + inside_px - plane.box_px.min[axis]
                               : image.max[axis] - inside_px - plane.box_px.max[axis];
        for (EdgePoint& edge : plane.edge_points) edge.u_px += shift;
        plane.box_px = {plane.box_px.min + shift, plane.box_px.max + shift};
        book.frame.detections[0].box_px = plane.box_px;
        EXPECT_EQ(book.Sides() == AllBut(side), inside_px < 4) << side << " high " << high;
      }
    }
  }
}

TEST(BoxConstraints, LeaveOutASideOfWhichHalfLiesBehindSomethingNearer) {
  for (std::size_t side = 0; side < 4; ++side) {
    for (std::size_t hidden = 0; hidden <= 4; ++hidden) {
      SeenBook book;
      for (std::size_t i = 0; i < hidden; ++i)  // of the four at this side
        book.frame.planes[0].edge_points[4 * side + i].kind = EdgeKind::kOccluded;
      EXPECT_EQ(book.Sides() == AllBut(side), hidden >= 2) << side << " hidden " << hidden;
    }
  }
}

TEST(BoxConstraints, SayLessTheLessTheFaceFillsTheBox) {
  SeenBook book;
  EXPECT_NEAR(book.Problem().boxes.at(0).sigma_px, book.config.box_sigma_px, 1e-9);
  book.frame.detections[0].box_px.max.y() += 160;  // twice as high: half is the face
  EXPECT_NEAR(book.Problem().boxes.at(0).sigma_px, 2 * book.config.box_sigma_px, 1e-9);
  book.frame.detections[0].compensated = true;  // predicted, not seen
  EXPECT_TRUE(book.Problem().boxes.empty());
}

TEST(BoxConstraints, LeaveOutABoxOfWhichTheFaceIsASmallPart) {
  for (const double share : {0.3, 0.2}) {  // a quarter is the least
    SeenBook book;
    Box& box_px = book.frame.detections[0].box_px;
    const Eigen::Vector2d size = box_px.max - box_px.min;
    // Deeper on the side that is not asked: the others are where the face ends.
    box_px.max.y() = box_px.min.y() + size.y() / share;
    EXPECT_EQ(book.Problem().boxes.size(), share > 0.25 ? 1u : 0u);
  }
}

TEST(PointPlaneConstraints, OfPointsThatAPoseThrewOutAreGone) {
  SeenBook book;
  for (int i = 0; i < 3; ++i) {
    MapPoint point;
    point.id = i;
    point.p_w.x() = i;
    book.map.points.push_back(point);
    book.frame.map_points.push_back(i);
    book.frame.point_planes.push_back({i, 0});
  }
  book.frame.map_points[1] = kNone;
  const PoseProblem problem = book.Problem();
  ASSERT_EQ(problem.point_planes.size(), 2u);
  EXPECT_EQ(problem.point_planes[0].p_w.x(), 0);
  EXPECT_EQ(problem.point_planes[1].p_w.x(), 2);
}

TEST(PointPlaneConstraints, OfManyPointsWeighTogetherAsMuchAsTen) {
  for (const int count : {5, 40}) {
    SeenBook book;
    for (int i = 0; i < 20; ++i) {  // that a pose threw out: they weigh nothing
      book.frame.map_points.push_back(kNone);
      book.frame.point_planes.push_back({i, 0});
    }
    for (int i = 0; i < count; ++i) {
      MapPoint point;
      point.id = i;
      point.p_w = Inverse(book.T_cw) * book.camera.Backproject({120.0 + 4 * i, 200.0}, 2.0);
      book.map.points.push_back(point);
      book.frame.map_points.push_back(i);
      book.frame.point_planes.push_back({20 + i, 0});
    }
    const PoseProblem problem = book.Problem();
    ASSERT_EQ(static_cast<int>(problem.point_planes.size()), count);
    double information = 0.0;
    for (const PointPlaneConstraint& c : problem.point_planes) {
      information += 1 / (c.sigma_m * c.sigma_m);
    }
    const double each = 1 / (book.config.point_plane_sigma_m * book.config.point_plane_sigma_m);
    EXPECT_NEAR(information, std::min(count, 10) * each, 1e-6 * each) << count;
  }
}

TEST(PlaneConstraints, KnowTheLandmarkAtThePlaceOfThePatchInTheWorld) {
  const SeenBook book;
  FramePlane patch = book.frame.planes[0];
  MapPlane m = book.map.planes.At(0);
  const Eigen::Vector3d x_w = Inverse(book.T_cw) * patch.centroid_c;
  const Eigen::Vector3d along = book.T_cw.R.transpose() * Eigen::Vector3d::UnitX();
  const Eigen::Vector3d seen_w = x_w + 0.8 * along;
  m.pi_w.d = -m.pi_w.n.dot(x_w);
  AddObservation(m.estimate, m.pi_w, seen_w, 0.02, 0.004, 1.0);
  const PlaneConstraint c = MakePlaneConstraint(patch, m, book.T_cw, 0.003, 0.005);
  // The landmark's offset there: its own, and its slope times the lever of 0.8 m.
  EXPECT_NEAR(c.offset_sigma_m, std::sqrt(0.003 * 0.003 + 0.004 * 0.004 + 0.016 * 0.016), 1e-9);
  EXPECT_NEAR(c.angle_sigma_rad, std::sqrt(0.005 * 0.005 + 0.02 * 0.02), 1e-9);
}

TEST(PlaneConstraints, WeighAPlaneByItsFitAndTheBendThatItsLandmarkDoesNotShare) {
  SeenBook book;
  book.config.bend_share = 0.25;
  FramePlane& plane = book.frame.planes[0];
  plane.bend_offset_sigma_m = 0.008, plane.bend_angle_sigma_rad = 0.012;
  const PoseProblem problem = book.Problem();
  ASSERT_EQ(problem.planes.size(), 1u);
  EXPECT_NEAR(problem.planes[0].offset_sigma_m, std::hypot(0.001, 0.002), 1e-12);
  EXPECT_NEAR(problem.planes[0].angle_sigma_rad, std::hypot(0.002, 0.003), 1e-12);
}

/// The book with four corners in the map, 0.2 m by 0.3 m, each seen with no error of its own.
struct SeenCorners : SeenBook {
  SeenCorners() {
    MapPlane& m = map.planes.At(0);
    m.vertices_w.clear();
    for (const Eigen::Vector3d& p_c :
         {Eigen::Vector3d(0, 0, 2), Eigen::Vector3d(0.2, 0, 2), Eigen::Vector3d(0.2, 0.3, 2),
          Eigen::Vector3d(0, 0.3, 2)}) {
      m.vertices_w.push_back(Inverse(T_cw) * p_c);
      frame.planes[0].vertices_c.push_back({p_c});
    }
    m.vertex_weights.assign(4, 1.0);
  }
  Vertex& Seen(std::size_t i) { return frame.planes[0].vertices_c[i]; }
};

TEST(VertexConstraints, PairEachCornerThatWasSeenWithTheLandmarksNearest) {
  SeenCorners book;
  std::reverse(book.frame.planes[0].vertices_c.begin(), book.frame.planes[0].vertices_c.end());
  book.Seen(3).p_c.x() += 0.02;
  const PoseProblem problem = book.Problem();
  ASSERT_EQ(problem.vertices.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(problem.vertices[i].p_w, book.map.planes.At(0).vertices_w[3 - i]) << i;
    EXPECT_EQ(problem.vertices[i].p_c, book.Seen(i).p_c) << i;
  }
}

TEST(VertexConstraints, LeaveOutCornersThatNobodySawOrThatLieElsewhere) {
  SeenCorners book;
  book.Seen(0).extrapolated = true;
  book.Seen(1).p_c.y() -= 1.01 * kMaxVertexJump_m;
  book.Seen(2).p_c.z() = std::nan("");
  EXPECT_EQ(book.Problem().vertices.size(), 1u);
  book.frame.planes[0].bad = BadReason::kFar;
  EXPECT_TRUE(book.Problem().vertices.empty());
}

TEST(VertexConstraints, WeighTheFramesErrorAlongThePlaneAndTheViewsOfTheLandmark) {
  SeenCorners book;
  book.Seen(0).covariance_c = Eigen::Vector3d(4e-6, 16e-6, 1.0).asDiagonal();  // z: the plane's
  book.map.planes.At(0).vertex_weights[0] = 0.5;
  const VertexConstraint c = book.Problem().vertices.at(0);
  const Eigen::Matrix3d information = c.sqrt_information.transpose() * c.sqrt_information;
  const double other2 = 0.003 * 0.003 * (1 + 2);
  const Eigen::Vector3d expected(1 / (4e-6 + other2), 1 / (16e-6 + other2), 0);
  EXPECT_TRUE(information.isApprox(Eigen::Matrix3d(expected.asDiagonal()), 1e-9))
      << information;
}

}  // namespace
}  // namespace slam
