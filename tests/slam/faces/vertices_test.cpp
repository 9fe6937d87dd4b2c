#include "slam/faces/vertices.h"

#include <gtest/gtest.h>

#include <cmath>

namespace slam {
namespace {

const Plane kFacing{-Eigen::Vector3d::UnitZ(), 1.0};  // z = 1
const Camera kCamera;

EdgeLine Side(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Camera& camera) {
  return {{a, (b - a).normalized()}, camera.Project(a), camera.Project(b), 30};
}

/// A rectangle 0.2 x 0.1 m at z = 1, edge points every 5 mm, its four sides as lines.
struct Face {
  /// @param off_axis_m  of its middle
  explicit Face(const Camera& seen_by = kCamera,
                const Eigen::Vector3d& off_axis_m = Eigen::Vector3d::Zero())
      : camera(seen_by) {
    plane.pi_c = kFacing, plane.area_m2 = 0.02;
    plane.centroid_c = Eigen::Vector3d(0, 0, 1) + off_axis_m;
    for (Eigen::Vector3d& p : corner) p += off_axis_m;
    for (int k = 0; k < 4; ++k) {
      const Eigen::Vector3d a = corner[k], b = corner[(k + 1) % 4];
      lines.push_back(Side(a, b, camera));
      for (int s = 0; s < 20; ++s) {
        const Eigen::Vector3d p = a + (b - a) * s / 20.0;
        plane.edge_points.push_back({p, camera.ProjectDistorted(p), EdgeKind::kSurface});
      }
    }
  }
  std::vector<Vertex> Find(const std::optional<Box>& box = std::nullopt) const {
    return FindVertices(plane, lines, camera, box, {});
  }
  Camera camera;
  Eigen::Vector3d corner[4] = {
      {-0.1, -0.05, 1}, {0.1, -0.05, 1}, {0.1, 0.05, 1}, {-0.1, 0.05, 1}};
  FramePlane plane;
  std::vector<EdgeLine> lines;
};

TEST(Vertices, AreTheCornersOfARectangleInOrder) {
  const Face face;
  const auto vertices = face.Find();
  ASSERT_EQ(vertices.size(), 4u);
  double area = 0.0;
  for (std::size_t k = 0; k < 4; ++k) {
    const Eigen::Vector3d &p = vertices[k].p_c, &q = vertices[(k + 1) % 4].p_c;
    area += 0.5 * p.cross(q).dot(kFacing.n);
    EXPECT_FALSE(vertices[k].extrapolated);
  }
  EXPECT_NEAR(area, 0.02, 1e-12) << "counter-clockwise seen from the front";
  EXPECT_NEAR((vertices[0].p_c - face.corner[0]).norm(), 0.0, 1e-12)
      << "first in reading order";
}

TEST(Vertices, AreMarkedWhereNoEdgePointIsNear) {
  Face face;
  std::erase_if(face.plane.edge_points,
                [&](const EdgePoint& e) { return (e.p_c - face.corner[2]).norm() < 0.03; });
  const auto vertices = face.Find();
  ASSERT_EQ(vertices.size(), 4u);
  for (const Vertex& v : vertices) {
    EXPECT_EQ(v.extrapolated, (v.p_c - face.corner[2]).norm() < 1e-9);
  }
}

// Where something nearer hides the rest of the side, the corner itself was not seen.
TEST(Vertices, AreMarkedWhereOnlyEdgesOfOtherThingsAreNear) {
  for (const EdgeKind kind : {EdgeKind::kOccluded, EdgeKind::kBorder, EdgeKind::kMissing}) {
    Face face;
    for (EdgePoint& e : face.plane.edge_points)
      if ((e.p_c - face.corner[2]).norm() < 0.03) e.kind = kind;
    const auto vertices = face.Find();
    ASSERT_EQ(vertices.size(), 4u);
    for (const Vertex& v : vertices)
      EXPECT_EQ(v.extrapolated, (v.p_c - face.corner[2]).norm() < 1e-9);
  }
}

TEST(Vertices, AreSeenWhereALensThatDistortsShowsThem) {
  Camera camera;
  camera.k1 = -0.2;
  Face face(camera, {0.45, 0.35, 0.0});  // off its ideal pixels by 10 to 33
  auto vertices = face.Find();
  ASSERT_EQ(vertices.size(), 4u);
  for (const Vertex& v : vertices) EXPECT_FALSE(v.extrapolated) << v.p_c.transpose();

  std::erase_if(face.plane.edge_points,
                [&](const EdgePoint& e) { return (e.p_c - face.corner[2]).norm() < 0.03; });
  vertices = face.Find();
  ASSERT_EQ(vertices.size(), 4u);
  for (const Vertex& v : vertices)
    EXPECT_EQ(v.extrapolated, (v.p_c - face.corner[2]).norm() < 1e-9) << v.p_c.transpose();
}

TEST(Vertices, AreTwoWhereOneSideIsHidden) {
  Face face;
  face.lines.erase(face.lines.begin());  // the upper side
  const auto vertices = face.Find();
  ASSERT_EQ(vertices.size(), 2u);
  for (const Vertex& v : vertices) EXPECT_NEAR(v.p_c.y(), 0.05, 1e-12);
}

TEST(Vertices, AreOneWhereTwoSidesAreSeen) {
  Face face;
  face.lines.resize(2);
  const auto vertices = face.Find();
  ASSERT_EQ(vertices.size(), 1u);
  EXPECT_NEAR((vertices[0].p_c - face.corner[1]).norm(), 0.0, 1e-12);
}

TEST(Vertices, LieBeyondABoxOnlyWhereTheImageCutsIt) {
  // The face is moved so that its right corners lie outside the image, and the box ends there.
  Face face;
  const double shift = 0.59;
  for (EdgeLine& line : face.lines) {
    line.line_c.P.x() += shift;
    line.from_px.x() += kCamera.fx * shift, line.to_px.x() += kCamera.fx * shift;
  }
  face.plane.centroid_c.x() += shift;
  for (EdgePoint& e : face.plane.edge_points) e.u_px.x() += kCamera.fx * shift;
  std::erase_if(face.plane.edge_points, [](const EdgePoint& e) { return e.u_px.x() > 639; });
  Box box;
  for (const EdgePoint& e : face.plane.edge_points) box.Include(e.u_px);
  box.max.x() = kCamera.width - 1;
  const auto vertices = face.Find(box);
  ASSERT_EQ(vertices.size(), 4u);
  for (const Vertex& v : vertices) {
    EXPECT_EQ(v.extrapolated, kCamera.Project(v.p_c).x() > kCamera.width - 1) << v.p_c.x();
  }
  box.max.x() = kCamera.width - 40;  // a box that ends inside the image is believed
  EXPECT_LT(face.Find(box).size(), 4u);
}

// Each pair of opposite sides is parallel within its bound, and the first corner square. Turned alike
// the two other sides meet at a right angle as well, turned against each other at 73 degrees.
TEST(Vertices, AreFourOnlyWhereOppositeCornersAreSquare) {
  constexpr double kTurn_rad = 0.15;
  for (const double against : {-1.0, 1.0}) {
    Face face;
    const auto turn = [&](std::size_t side, double angle_rad) {
      const Eigen::Vector3d a = face.corner[side], b = face.corner[(side + 1) % 4];
      const Eigen::Vector3d middle = 0.5 * (a + b);
      const Eigen::AngleAxisd R(angle_rad, Eigen::Vector3d::UnitZ());
      face.lines[side] = Side(middle + R * (a - middle), middle + R * (b - middle), kCamera);
    };
    turn(2, kTurn_rad);
    turn(3, -against * kTurn_rad);
    EXPECT_EQ(face.Find().size() == 4, against < 0) << against;
  }
}

TEST(Vertices, AreNoneOfParallelLinesAlone) {
  Face face;
  face.lines = {face.lines[0], face.lines[2]};
  EXPECT_TRUE(face.Find().empty());
  face.lines.clear();
  EXPECT_TRUE(face.Find().empty());
}

TEST(Vertices, DoNotMakeARectangleThatTheRegionDoesNotFill) {
  Face face;
  face.plane.area_m2 = 0.004;  // a fifth of it: lines of something else
  EXPECT_LT(face.Find().size(), 4u);
  face.plane.area_m2 = 0.03;  // the region reaches far beyond
  EXPECT_LT(face.Find().size(), 4u);
}

const Line kOneAbove{{0, 0, 1}, {1, 0, 0}};

TEST(VerticesConditionOne, RefusesLinesThatPassEachOther) {
  VertexConfig config;
  config.max_plane_distance_m = 1.0;  // so that condition 1 alone can refuse
  const auto apart = [&](double gap) {
    return MeetingPoint(kOneAbove, {{0, 0, 1 + gap}, {0, 1, 0}}, kFacing, kCamera, {}, config);
  };
  EXPECT_TRUE(apart(0.9 * config.max_feet_distance_m).has_value());
  EXPECT_FALSE(apart(1.1 * config.max_feet_distance_m).has_value());
}

TEST(VerticesConditionTwo, RefusesAPointOffThePlane) {
  const VertexConfig config;
  const auto off = [&](double z) {
    return MeetingPoint({{0, 0, z}, {1, 0, 0}}, {{0, 0, z}, {0, 1, 0}}, kFacing, kCamera, {},
                        config);
  };
  EXPECT_TRUE(off(1.0 + 0.9 * config.max_plane_distance_m).has_value());
  EXPECT_FALSE(off(1.0 - 1.1 * config.max_plane_distance_m).has_value());
}

TEST(VerticesConditionThree, RefusesAPointOutsideTheBox) {
  const VertexConfig config;
  const Eigen::Vector2d u = kCamera.Project({0, 0, 1});
  const auto with_box_right_of = [&](double distance_px) {
    const Box box{u + Eigen::Vector2d(distance_px, -50), u + Eigen::Vector2d(200, 50)};
    return MeetingPoint(kOneAbove, {{0, 0, 1}, {0, 1, 0}}, kFacing, kCamera, box, config);
  };
  EXPECT_TRUE(with_box_right_of(config.box_margin_px - 1).has_value());
  EXPECT_FALSE(with_box_right_of(config.box_margin_px + 1).has_value());
}

// A box is one of the recorded image.
TEST(VerticesConditionThree, GoesByWhereTheLensShowsThePoint) {
  Camera camera;
  camera.k1 = -0.2;
  const VertexConfig config;
  const Eigen::Vector3d corner(0.5, 0.4, 1);
  const Eigen::Vector2d shown = camera.ProjectDistorted(corner), ideal = camera.Project(corner);
  ASSERT_GT((shown - ideal).norm(), 2 * config.box_margin_px);
  const auto in_box_around = [&](const Eigen::Vector2d& u_px) {
    const Eigen::Vector2d half(1, 1);
    return MeetingPoint({corner, {1, 0, 0}}, {corner, {0, 1, 0}}, kFacing, camera,
                        Box{u_px - half, u_px + half}, config)
        .has_value();
  };
  EXPECT_TRUE(in_box_around(shown));
  EXPECT_FALSE(in_box_around(ideal));
}

TEST(MeetingPoint, LiesBeforeTheCamera) {
  const Plane floor{-Eigen::Vector3d::UnitY(), 0.1};
  const auto meet = [&](double z) {
    return MeetingPoint({{0.3, 0.1, z}, {1, 0, 0}}, {{0, 0.1, 0.7}, {0, 0, 1}}, floor, kCamera,
                        {}, {});
  };
  EXPECT_TRUE(meet(0.5).has_value());
  EXPECT_FALSE(meet(-0.2).has_value());
}

}  // namespace
}  // namespace slam
