#include "slam/faces/vertex_covariance.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <array>
#include <cmath>

#include "slam/faces/process_planes.h"
#include "slam/segment/plane_segments.h"
#include "tests/support/closed_form_depth.h"
#include "tests/support/depth_planes.h"
#include "tests/support/normal_draws.h"

namespace slam {
namespace {

/// The middle of an image of 640 x 480.
Camera CroppedCamera() {
  Camera camera;
  camera.width = 320, camera.height = 240;
  camera.cx = 159.5, camera.cy = 119.5;
  return camera;
}

/// Sums of normalised squared errors of corners of one kind.
struct Consistency {
  int corners = 0;
  double in_plane = 0.0, across = 0.0;  ///< 2 and 1 degrees of freedom
  void Add(const Eigen::Vector3d& error_c, const Eigen::Matrix3d& covariance_c,
           const Eigen::Vector3d& n_c) {
    ++corners;
    across += std::pow(n_c.dot(error_c), 2) / n_c.dot(covariance_c * n_c);
    Eigen::Matrix<double, 3, 2> basis;
    basis.col(0) = n_c.unitOrthogonal();
    basis.col(1) = n_c.cross(basis.col(0));
    const Eigen::Vector2d e = basis.transpose() * error_c;
    in_plane += e.dot((basis.transpose() * covariance_c * basis).inverse() * e);
  }
};

/// A book on a desk, one corner behind a block; turned and looked at a little differently with
/// each draw, so that its sides fall anywhere between pixels.
struct HalfHiddenBook {
  HalfHiddenBook(double distance_m, std::uint64_t draw) {
    Random random({draw, 11});
    const auto within = [&](double low, double high) {
      return low + (high - low) * random.Uniform();
    };
    const double yaw = within(0.0, 3.14);
    world = closed_form::Desk();
    closed_form::PutOnDesk(world, 0.0, 0.0, {0.13, 0.19, 0.05}, yaw, "book");
    const Eigen::Vector3d view(within(-0.3, 0.3), -0.6, within(0.7, 0.9));
    T_cw = closed_form::LookAt(distance_m * view.normalized(),
                               {within(-0.01, 0.01), within(-0.01, 0.01), 0.05});
    corners_w = closed_form::TopCorners(world.boxes[1]);
    hidden = 0;  // the corner that is nearest to the camera
    for (std::size_t k = 1; k < 4; ++k) {
      if ((T_cw * corners_w[k]).z() < (T_cw * corners_w[hidden]).z()) hidden = k;
    }
    const Eigen::Vector3d& covered_w = corners_w[hidden];
    closed_form::PutOnDesk(world, covered_w.x(), covered_w.y(), {0.05, 0.05, 0.09}, yaw, "");
    const closed_form::View seen = closed_form::Render(world, camera, T_cw);
    frame = closed_form::MakeFrame(closed_form::AddKinectNoise(seen.depth_m, draw));
    Detection book;
    book.class_name = "book", book.kind = ClassKind::kRegular, book.score = 0.9;
    for (const Eigen::Vector3d& corner_w : corners_w) {
      book.box_px.Include(camera.Project(T_cw * corner_w));
      book.box_px.Include(camera.Project(T_cw * (corner_w - Eigen::Vector3d(0, 0, 0.05))));
    }
    frame.detections = {book};
    ExtractPlanes(frame, PixelRays(camera), {});
    ProcessPlanes(frame, camera, {}, {});
  }
  /// Adds the corners of the book's top that were found, seen and extrapolated.
  void AddTo(std::array<Consistency, 2>& sums) const {
    const Plane top_c = Transform(T_cw, closed_form::FacePlane(world.boxes[1], 5));
    for (const FramePlane& plane : frame.planes) {
      const bool top = plane.pi_c.n.dot(top_c.n) > 0.98 &&
                       std::abs(SignedDistance(top_c, plane.centroid_c)) < 0.01;
      if (!top) continue;
      for (const Vertex& v : plane.vertices_c) {
        Eigen::Vector3d error = v.p_c - T_cw * corners_w[0];
        for (const Eigen::Vector3d& corner_w : corners_w) {
          const Eigen::Vector3d other = v.p_c - T_cw * corner_w;
          if (other.norm() < error.norm()) error = other;
        }
        sums[v.extrapolated ? 1 : 0].Add(error, v.covariance_c, top_c.n);
      }
    }
  }
  Camera camera = CroppedCamera();
  closed_form::World world;
  std::vector<Eigen::Vector3d> corners_w;
  std::size_t hidden = 0;
  Pose T_cw;
  Frame frame;
};

TEST(VertexCovariance, ExplainsTheErrorsOfCornersNearAndFarSeenAndHidden) {
  // Fixed draws. Mean normalised squared errors within a factor of two of the degrees of
  // freedom: of 120 corners their own standard error is a tenth of that, of 40 a sixth.
  // The noise drawn is shared by 9 pixels, where the model that extraction uses counts 16.
  const double drawn_share = 9.0 / DepthNoise{}.correlated_px;
  for (const double distance_m : {0.7, 1.2}) {
    std::array<Consistency, 2> sums;
    for (std::uint64_t draw = 0; draw < 40; ++draw)
      HalfHiddenBook(distance_m, draw).AddTo(sums);
    EXPECT_GE(sums[0].corners, 108) << "of 120 seen at " << distance_m << " m";
    EXPECT_GE(sums[1].corners, 36) << "of 40 hidden";
    for (const Consistency& c : sums) {
      const double in_plane = c.in_plane / c.corners;
      const double across = c.across / c.corners / drawn_share;
      EXPECT_GT(in_plane, 1.0) << c.corners << " corners at " << distance_m << " m";
      EXPECT_LT(in_plane, 4.0) << c.corners << " corners at " << distance_m << " m";
      EXPECT_GT(across, 0.5) << c.corners << " corners at " << distance_m << " m";
      EXPECT_LT(across, 2.0) << c.corners << " corners at " << distance_m << " m";
    }
  }
}

TEST(VertexCovariance, IsThatOfTheLinesInMetresWherePixelsAreNotSquare) {
  Camera camera;
  camera.fx = 400, camera.fy = 600;
  constexpr double kWall_z_m = 2.0;  // seen frontally, and known exactly
  FramePlane plane;
  plane.pi_c = {-Eigen::Vector3d::UnitZ(), kWall_z_m};
  const Eigen::Vector2d u(500, 100);
  const LineError row{u, Eigen::Vector2d::UnitX(), 0.25},
      column{u, Eigen::Vector2d::UnitY(), 0.09};
  // 0.3 px across a column are 1.5 mm, 0.5 px across a row 1.67 mm.
  const Eigen::Vector3d sigma_m(0.3 * kWall_z_m / 400, 0.5 * kWall_z_m / 600, 0.0);
  const Eigen::Matrix3d expected = sigma_m.cwiseAbs2().asDiagonal();
  const Eigen::Vector3d corner_c = camera.Backproject(u, kWall_z_m);
  const Eigen::Matrix3d covariance = VertexCovariance(plane, row, column, corner_c, camera);
  EXPECT_LT((covariance - expected).norm(), 1e-12) << covariance;
}

/// Points two pixels apart along x, `across` of the k-th by the function.
template <typename Across>
std::vector<Eigen::Vector2d> Along(int n, Across across) {
  std::vector<Eigen::Vector2d> points;
  for (int k = 0; k < n; ++k) points.emplace_back(2.0 * k - (n - 1), across(k));
  return points;
}

TEST(LineErrors, OfASideInOneRowAreThoseOfRoundingHoweverManyPixelsAgree) {
  for (const int n : {10, 1000}) {
    const auto points = Along(n, [](int) { return 0.0; });
    const LineError e = MeasureLineError(points, {0, 0}, {1, 0});
    EXPECT_NEAR(e.Variance(points.front()), 1.0 / 12.0, 1e-12);
    EXPECT_LT(e.Variance({0, 0}), 1.0 / 12.0);
  }
}

TEST(LineErrors, CountNeighboursThatMoveTogetherOnce) {
  // White noise of 0.5 px, and the same shared by five neighbours each.
  double of_white = 0.0, of_shared = 0.0;
  constexpr int kLines = 40;
  for (int line = 0; line < kLines; ++line) {
    const auto white = [&](int k) {
      Random random({static_cast<std::uint64_t>(k), static_cast<std::uint64_t>(line)});
      return 0.5 * BoundedNormal(random);
    };
    const LineError alone = MeasureLineError(Along(1000, white), {0, 0}, {1, 0});
    const LineError shared =
        MeasureLineError(Along(1000, [&](int k) { return white(k / 5); }), {0, 0}, {1, 0});
    EXPECT_NEAR(alone.angle_rad2, 12.0 * alone.offset_px2 / (2000.0 * 2000.0),
                0.01 * alone.angle_rad2);
    of_white += alone.offset_px2 / kLines, of_shared += shared.offset_px2 / kLines;
  }
  EXPECT_NEAR(of_white * 1000 / 0.25, 1.0, 0.2);
  EXPECT_NEAR(of_shared * 200 / 0.25, 1.0, 0.2);
}

TEST(LineErrors, OfTheShortestLinesAreThoseThatTheirFitsMake) {
  // The mean over all signs of an error is that over an error that is drawn. 10 px, so that
  // rounding does not count, in lines so long that they hardly turn.
  constexpr double kError_px = 10.0, kStep_px = 1000.0;
  for (const int n : {4, 5}) {
    double told_middle = 0.0, told_end = 0.0, made_middle = 0.0, made_end = 0.0;
    for (int signs = 0; signs < 1 << n; ++signs) {
      std::vector<Eigen::Vector2d> points;
      for (int k = 0; k < n; ++k) {
        const double across = (signs >> k) % 2 == 0 ? kError_px : -kError_px;
        points.emplace_back(kStep_px * (k - 0.5 * (n - 1)), across);
      }
      double height = 0.0, moment = 0.0, inertia = 0.0;
      for (const Eigen::Vector2d& u : points)
        height += u.y() / n, moment += u.x() * u.y(), inertia += u.x() * u.x();
      const double slope = moment / inertia, end_px = points.back().x();
      const LineError error =
          MeasureLineError(points, {0, height}, Eigen::Vector2d(1, slope).normalized());
      told_middle += error.Variance({0, height});
      told_end += error.Variance({end_px, height + slope * end_px});
      made_middle += std::pow(height, 2);
      made_end += std::pow(height + slope * end_px, 2);
    }
    EXPECT_NEAR(told_middle / made_middle, 1.0, 0.01) << n << " points";
    EXPECT_NEAR(told_end / made_end, 1.0, 0.01) << n << " points";
  }
}

}  // namespace
}  // namespace slam
