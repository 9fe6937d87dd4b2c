#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <opencv2/core.hpp>

#include "property_tests/sim/render_worlds.h"
#include "sim/trace/frame_renderer.h"

namespace sim {
namespace {

using Outline = std::vector<Eigen::Vector2d>;

/// Cuts a polygon at ab . x <= c.
Outline Cut(const Outline& polygon, const Eigen::Vector2d& ab, double c) {
  Outline kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector2d &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    const double dp = ab.dot(p) - c, dq = ab.dot(q) - c;
    if (dp <= 0) kept.push_back(p);
    if ((dp < 0 && dq > 0) || (dp > 0 && dq < 0))
      kept.push_back(p + (q - p) * (dp / (dp - dq)));
  }
  return kept;
}

/// Area and length of what of the polygon lies in the image.
struct Extent {
  double area_px = 0, outline_px = 0;
};
Extent ExtentInImage(Outline polygon, const Camera& camera) {
  polygon = Cut(polygon, {1, 0}, camera.width - 0.5);
  polygon = Cut(polygon, {-1, 0}, 0.5);
  polygon = Cut(polygon, {0, 1}, camera.height - 0.5);
  polygon = Cut(polygon, {0, -1}, 0.5);
  Extent extent;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector2d &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    extent.area_px += 0.5 * (p.x() * q.y() - p.y() * q.x());
    extent.outline_px += (q - p).norm();
  }
  extent.area_px = std::abs(extent.area_px);
  return extent;
}

/// A board before the camera of LookAlongY, and its face (-y) in the image.
struct Board {
  Scene scene;
  Outline Face(const Camera& camera) const {
    const Object& board = scene.objects[0];
    Outline corners;
    for (const auto& [x, z] : {std::pair{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}}) {
      const Eigen::Vector3d x_o = Eigen::Vector3d(x, -0.5, z).cwiseProduct(board.size);
      corners.push_back(
          camera.Project(Inverse(LookAlongY()) * (board.center_w + board.q_wo * x_o)));
    }
    return corners;
  }
  /// Between the face's normal and the way to the camera, at its middle.
  double Incidence() const {
    const Object& board = scene.objects[0];
    const Eigen::Vector3d n_w = board.q_wo * -Eigen::Vector3d::UnitY();
    const Eigen::Vector3d x_w = board.center_w + 0.5 * board.size.y() * n_w;
    return std::acos(-n_w.dot(x_w) / x_w.norm());
  }
};

Board MakeBoard(const Eigen::Vector3d& center_w, const Eigen::Vector3d& size,
                const Eigen::Quaterniond& q_wo) {
  Board board;
  board.scene.objects = {BoxObject(1, "book", Role::kRegular, center_w, size)};
  board.scene.objects[0].q_wo = q_wo;
  return board;
}

constexpr int kFrontPlane = 3;  // -x, +x, -y
constexpr double kSteepest_rad = 84 * M_PI / 180;

/// The least angle between an edge of the polygon and the pixel grid.
double LeastAngleToGrid(const Outline& polygon) {
  double least = M_PI;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector2d edge = (polygon[(i + 1) % polygon.size()] - polygon[i]).cwiseAbs();
    least = std::min(least, std::atan2(edge.minCoeff(), edge.maxCoeff()));
  }
  return least;
}

// A pixel centre lies inside or not: along an edge that crosses many rows the errors cancel.
// One along the grid can lose or win half a pixel all along; those are the next law's business.
RC_GTEST_PROP(RenderedMask, HasTheAreaOfTheProjectedPolygon, ()) {
  const Camera camera = SmallCamera();
  const Eigen::Vector3d center(Real(-0.5, 0.5), Real(1.2, 3), Real(-0.4, 0.4));
  const Eigen::Vector3d size(Real(0.2, 0.9), 0.02, Real(0.2, 0.9));
  const double turn = Real(-1.4, 1.4), roll = Real(-M_PI, M_PI);
  const Board board = MakeBoard(
      center, size,
      Eigen::Quaterniond(
          Eigen::AngleAxisd(turn, Eigen::Vector3d(std::cos(roll), 0, std::sin(roll))) *
          Eigen::AngleAxisd(Real(-M_PI, M_PI), Eigen::Vector3d::UnitY())));
  if (board.Incidence() > kSteepest_rad) RC_DISCARD("seen too flat");
  const Outline face = board.Face(camera);
  if (LeastAngleToGrid(face) < 0.04) RC_DISCARD("along the pixel grid");
  const Extent extent = ExtentInImage(face, camera);
  const Rendering r =
      FrameRenderer(board.scene, camera).Render(LookAlongY(), {.colour = false});
  const int pixels = cv::countNonZero(r.plane_id == kFrontPlane);
  RC_ASSERT(std::abs(pixels - extent.area_px) <= 0.1 * extent.outline_px + 4);
}

class MaskOfABoard : public testing::TestWithParam<std::pair<double, double>> {};

// 16 x 16 shifts of the image by sixteenths of a pixel; the board stays inside. Wholly square
// boards (turn 0) are the hardest: their edges lie along the grid.
TEST_P(MaskOfABoard, HasTheRightAreaInTheMeanOverSubpixelShifts) {
  const auto& [turn, roll] = GetParam();
  const Board board =
      MakeBoard({0.05, 1.5, 0.03}, {0.61, 0.02, 0.43},
                Eigen::Quaterniond(Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitZ()) *
                                   Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitY())));
  ASSERT_LT(board.Incidence(), kSteepest_rad);
  const Extent extent = ExtentInImage(board.Face(SmallCamera()), SmallCamera());
  constexpr int kSide = 16;
  constexpr double kCount = kSide * kSide;
  double sum = 0, squares = 0;
  for (int k = 0; k < kSide * kSide; ++k) {
    Camera shifted = SmallCamera();
    shifted.cx += (k % kSide + 0.5) / kSide;
    shifted.cy += (k / kSide + 0.5) / kSide;
    const Rendering r =
        FrameRenderer(board.scene, shifted).Render(LookAlongY(), {.colour = false});
    const double error = cv::countNonZero(r.plane_id == kFrontPlane) - extent.area_px;
    sum += error;
    squares += error * error;
  }
  const double mean = sum / kCount;
  const double standard_error = std::sqrt((squares / kCount - mean * mean) / kCount);
  EXPECT_LE(std::abs(mean), 5 * standard_error + 1e-9);
  EXPECT_LT(standard_error, 0.02 * extent.outline_px);  // or the bound above says nothing
}

INSTANTIATE_TEST_SUITE_P(TurnAndRoll, MaskOfABoard,
                         testing::Values(std::pair{0.0, 0.0}, std::pair{0.5, 0.3},
                                         std::pair{1.2, 1.0}, std::pair{-1.4, 2.5}));

}  // namespace
}  // namespace sim
