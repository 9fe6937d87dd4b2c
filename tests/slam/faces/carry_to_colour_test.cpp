#include "slam/faces/carry_to_colour.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "tests/support/closed_form_depth.h"
#include "tests/support/slam_matchers.h"

namespace slam {
namespace {

using Eigen::Vector3d;

/// A motion between the two images by which T_dc becomes `moved`.
void TakeDepthFrom(const Pose& moved, Frame& frame) {
  frame.depth_late_s = 0.02;
  frame.speed.mean = Log(moved) / frame.depth_late_s;
}

/// Boxes on a desk as a camera elsewhere sees them, with a label for each face.
struct Seen {
  cv::Mat1f depth_m;
  cv::Mat1b labels;
};
Seen SeeDesk(const Camera& camera, const Pose& T_xw) {
  closed_form::World world = closed_form::Desk();
  closed_form::PutOnDesk(world, 0.1, 0.05, {0.2, 0.15, 0.08}, 0.4, "");
  closed_form::PutOnDesk(world, -0.2, -0.1, {0.25, 0.2, 0.2}, -0.3, "");
  const closed_form::View view = closed_form::Render(world, camera, T_xw);
  cv::Mat1b labels;
  view.face.convertTo(labels, CV_8U);
  return {view.depth_m, labels};
}

/// Share of the pixels with another label than colour shows there, but for those beside another
/// label, as what is carried by whole pixels may be off by one, and those at the image's border,
/// which the depth camera may not have seen.
double ShareWrong(const cv::Mat1b& labels, const cv::Mat1b& truth) {
  cv::Mat1b lowest, highest;
  cv::erode(truth, lowest, cv::Mat());
  cv::dilate(truth, highest, cv::Mat());
  const cv::Mat wrong = (labels != truth) & (lowest == highest);
  const cv::Rect seen(8, 8, truth.cols - 16, truth.rows - 16);
  return cv::countNonZero(wrong(seen)) / static_cast<double>(seen.area());
}

/// The images that come out of a depth camera at T_dc, and those that they should be.
void ExpectCarried(const Pose& T_dc, const Eigen::Matrix3d& R_dc) {
  Camera camera;
  camera.k1 = 0.1, camera.k2 = -0.05;
  const Pose T_cw = closed_form::LookAt({0.3, -0.9, 0.7}, {0, 0, 0});
  const Seen colour = SeeDesk(camera, T_cw);
  Frame frame;
  frame.R_dc = R_dc;
  TakeDepthFrom(T_dc, frame);
  const Seen depth = SeeDesk(camera, frame.T_dc() * T_cw);
  frame.depth_m = depth.depth_m, frame.plane_labels = depth.labels;
  CarryToColour(camera, PixelRays(camera), frame);
  EXPECT_GT(ShareWrong(depth.labels, colour.labels), 0.005);
  EXPECT_LT(ShareWrong(frame.plane_labels, colour.labels), 0.0005);

  // Depth is what the colour camera would have measured, where both see one face.
  const cv::Mat inside = (frame.plane_labels == colour.labels) & (colour.labels > 0);
  double sum2 = 0.0;
  int count = 0;
  for (int v = 0; v < inside.rows; ++v) {
    for (int u = 0; u < inside.cols; ++u) {
      if (!inside.at<std::uint8_t>(v, u) || !(frame.depth_m(v, u) > 0)) continue;
      const auto off =
          static_cast<double>(frame.depth_m(v, u)) - static_cast<double>(colour.depth_m(v, u));
      sum2 += off * off, ++count;
    }
  }
  ASSERT_GT(count, 100000);
  EXPECT_LT(std::sqrt(sum2 / count), 0.002);
}

TEST(CarryToColour, ShowsWhatWasSeenFromBeside) {
  ExpectCarried({Eigen::Matrix3d::Identity(), {0.006, -0.004, 0.0}},
                Eigen::Matrix3d::Identity());
}

TEST(CarryToColour, ShowsWhatWasSeenFromFartherOff) {
  ExpectCarried({Eigen::Matrix3d::Identity(), {0.0, 0.0, 0.03}}, Eigen::Matrix3d::Identity());
}

TEST(CarryToColour, ShowsWhatACameraThatTurnedSaw) {
  ExpectCarried({ExpSo3({0.004, -0.009, 0.01}), Vector3d::Zero()}, Eigen::Matrix3d::Identity());
}

TEST(CarryToColour, ShowsWhatACameraThatLooksElsewhereSaw) {
  ExpectCarried({}, ExpSo3({-0.006, 0.005, 0.0}));
}

TEST(CarryToColour, TouchesNothingWhenBothAreOne) {
  Frame frame;
  const Seen seen = SeeDesk({}, closed_form::LookAt({0.3, -0.9, 0.7}, {0, 0, 0}));
  frame.depth_m = seen.depth_m, frame.plane_labels = seen.labels;
  frame.speed.mean << 1, 2, 3, 0.4, 0.5, 0.6;  // no matter: the images are of one time
  CarryToColour({}, PixelRays({}), frame);
  EXPECT_EQ(frame.depth_m.data, seen.depth_m.data);
  EXPECT_EQ(frame.plane_labels.data, seen.labels.data);
}

TEST(CarryToColour, LeavesTheImagesThatItWasGiven) {
  const Seen seen = SeeDesk({}, closed_form::LookAt({0.3, -0.9, 0.7}, {0, 0, 0}));
  const Seen before{seen.depth_m.clone(), seen.labels.clone()};
  Frame frame;
  frame.depth_m = seen.depth_m, frame.plane_labels = seen.labels;
  TakeDepthFrom({ExpSo3({0.01, 0.01, 0.0}), {0.01, 0, 0}}, frame);
  CarryToColour({}, PixelRays({}), frame);
  EXPECT_EQ(cv::countNonZero(seen.depth_m != before.depth_m), 0);
  EXPECT_EQ(cv::countNonZero(seen.labels != before.labels), 0);
}

TEST(CarryToColour, TellsPlanesAsTheColourCameraWouldHaveMeasuredThem) {
  const Pose T_cd{ExpSo3({0.02, -0.01, 0.03}), {0.01, 0.02, -0.015}};
  const Vector3d n = Vector3d(0.2, -0.4, -0.9).normalized(), x(0.1, 0.2, 1.3);
  const Camera camera;
  FramePlane plane;
  plane.pi_c = {n, -n.dot(x)};
  plane.centroid_c = x;
  plane.points_c = {x, x + 0.1 * n.unitOrthogonal()};
  plane.edge_points = {{x, camera.Project(x)}, {plane.points_c[1], {300, 200}}};
  for (const EdgePoint& edge : plane.edge_points) plane.box_px.Include(edge.u_px);
  plane.inverse_depth_covariance = n * n.transpose();
  Frame frame;
  frame.depth_m = cv::Mat1f(480, 640, 1.3f);
  frame.planes = {plane};
  TakeDepthFrom(Inverse(T_cd), frame);
  CarryToColour(camera, PixelRays(camera), frame);
  const FramePlane& there = frame.planes[0];
  for (const Vector3d& p : there.points_c) {
    EXPECT_NEAR(SignedDistance(there.pi_c, p), 0.0, 1e-12);
  }
  for (const Vector3d& p : {there.centroid_c, there.edge_points[0].p_c, there.points_c[0]}) {
    EXPECT_LT((p - T_cd * x).norm(), 1e-12);
  }
  Box box;
  for (const EdgePoint& edge : there.edge_points) {
    EXPECT_LT((edge.u_px - camera.Project(edge.p_c)).norm(), 1e-9);
    box.Include(edge.u_px);
  }
  EXPECT_EQ(there.box_px.min, box.min);
  EXPECT_EQ(there.box_px.max, box.max);
  // Uncertainties turn with what they are of.
  EXPECT_NEAR(there.pi_c.n.dot(there.inverse_depth_covariance * there.pi_c.n), 1.0, 1e-12);
}

TEST(CarryPlanesAgain, TellsLinesAndVerticesToo) {
  const Pose T_oc{ExpSo3({0.02, -0.01, 0.03}), {0.01, 0.02, -0.015}};
  const Vector3d n(0, 0, -1), x(0.1, 0.2, 1.3), along = Vector3d::UnitX();
  FramePlane plane;
  plane.pi_c = {n, -n.dot(x)};
  plane.lines_c = {{x, along}};
  plane.vertices_c = {{.p_c = x, .covariance_c = along * along.transpose()}};
  Frame frame;
  frame.planes = {plane};
  // Carried as if the cameras were one; now it is known better.
  TakeDepthFrom(Inverse(T_oc), frame);
  CarryPlanesAgain({}, Camera{}, frame);
  const FramePlane& there = frame.planes[0];
  // The line lies on the plane as before, and the vertex on the line.
  EXPECT_NEAR(SignedDistance(there.pi_c, there.lines_c[0].P), 0.0, 1e-12);
  EXPECT_NEAR(there.lines_c[0].V.dot(there.pi_c.n), 0.0, 1e-12);
  EXPECT_LT((there.vertices_c[0].p_c - T_oc * x).norm(), 1e-12);
  EXPECT_LT((there.lines_c[0].P - there.vertices_c[0].p_c).norm(), 1e-12);
  // The vertex is uncertain along the line.
  EXPECT_NEAR(there.lines_c[0].V.dot(there.vertices_c[0].covariance_c * there.lines_c[0].V),
              1.0, 1e-12);
  // There and back again.
  const Pose carried = frame.T_dc();
  TakeDepthFrom({}, frame);
  CarryPlanesAgain(carried, Camera{}, frame);
  EXPECT_LT((there.pi_c.n - n).norm() + (there.vertices_c[0].p_c - x).norm(), 1e-12);
}

TEST(CarryToColour, KeepsTheDepthOfAWallWhileTheCameraTurns) {
  const Camera camera;
  for (const double turn_rad : {-0.04, 0.04}) {
    Frame frame;
    frame.depth_m = cv::Mat1f(480, 640, 1.0f);  // a wall across the depth camera's axis
    frame.plane_labels = cv::Mat1b(480, 640, std::uint8_t{1});
    TakeDepthFrom(
        {Eigen::AngleAxisd(turn_rad, Vector3d::UnitY()).toRotationMatrix(), {0, 0, 0}}, frame);
    const Vector3d axis_c = frame.T_dc().R.row(2);
    CarryToColour(camera, PixelRays(camera), frame);
    double sum_m = 0;
    int count = 0;
    for (int v = 100; v < 380; ++v) {
      for (int u = 100; u < 540; ++u) {
        if (!(frame.depth_m(v, u) > 0)) continue;
        const double exact_m = 1 / axis_c.dot(camera.Backproject({u, v}, 1.0));
        sum_m += static_cast<double>(frame.depth_m(v, u)) - exact_m, ++count;
      }
    }
    ASSERT_GT(count, 100000);
    EXPECT_NEAR(sum_m / count, 0, 1e-4) << turn_rad;
  }
}

TEST(CarryToColour, LeavesAPlaneThatTheColourCameraWouldSeeFromBehind) {
  FramePlane plane;
  plane.pi_c = {Vector3d::UnitY(), 0.001};
  plane.centroid_c = {0, -0.001, 1};
  Frame frame;
  frame.depth_m = cv::Mat1f(480, 640, 1.0f);
  frame.planes = {plane};
  TakeDepthFrom(Inverse({Eigen::Matrix3d::Identity(), {0, 0.003, 0}}), frame);
  CarryToColour({}, PixelRays({}), frame);
  EXPECT_EQ(frame.planes[0].pi_c.d, plane.pi_c.d);
  EXPECT_EQ(frame.planes[0].centroid_c, plane.centroid_c);
}

TEST(CarryToColour, RecordsEdgePointsWhereALensThatDistortsShowsThem) {
  const Camera camera = TumCamera("tum1");
  const cv::Mat2d rays = PixelRays(camera);
  const Pose T_dc{ExpSo3({0.004, -0.009, 0.01}), {0.006, -0.004, 0.01}};
  const Vector3d n = Vector3d(0.2, -0.3, -0.9).normalized();
  // Points of a wall in pixels of the colour image, up to its rim, found by the depth camera.
  const std::vector<cv::Point> pixels = {
      {20, 25}, {610, 30}, {330, 240}, {40, 450}, {600, 460}};
  FramePlane plane;
  plane.pi_c = Transform(T_dc, {n, 1.2});
  for (const cv::Point& at : pixels) {
    const Vector3d ray(rays(at)[0], rays(at)[1], 1.0);
    const Vector3d x_d = T_dc * (ray * (-1.2 / n.dot(ray)));
    plane.edge_points.push_back({x_d, camera.ProjectDistorted(x_d)});
  }
  for (const bool again : {false, true}) {
    Frame frame;
    frame.depth_m = cv::Mat1f(480, 640, 1.2f);
    frame.planes = {plane};
    TakeDepthFrom(T_dc, frame);
    if (again) {
      CarryPlanesAgain({}, camera, frame);
    } else {
      CarryToColour(camera, rays, frame);
    }
    const FramePlane& there = frame.planes[0];
    for (std::size_t k = 0; k < pixels.size(); ++k) {
      const Eigen::Vector2d seen(pixels[k].x, pixels[k].y);
      EXPECT_LT((there.edge_points[k].u_px - seen).norm(), 0.01) << pixels[k];
    }
    EXPECT_LT((there.box_px.min - Eigen::Vector2d(20, 25)).norm(), 0.01);
    EXPECT_LT((there.box_px.max - Eigen::Vector2d(610, 460)).norm(), 0.01);
  }
}

}  // namespace
}  // namespace slam
