#include "slam/geometry/camera.h"

#include <gtest/gtest.h>

#include "io/input_error.h"
#include "slam/geometry/plane.h"
#include "tests/support/slam_matchers.h"

namespace slam {
namespace {

using Vector5d = Eigen::Vector<double, 5>;

TEST(Camera, UndistortUndoesTheDistortionOverTheWholePicture) {
  const Camera camera = TumCamera("tum1");
  for (int v = 0; v < camera.height; v += 40) {
    for (int u = 0; u < camera.width; u += 40) {
      const Eigen::Vector2d recorded(u, v);
      const Eigen::Vector2d ideal = camera.Undistort(recorded);
      // The fixed-point iteration stops at 1e-12 of the normalised plane: 5e-10 px.
      EXPECT_THAT(camera.ProjectDistorted(camera.Backproject(ideal, 2.0)),
                  VectorNear(recorded, 1e-8));
    }
  }
}

// Of pixels that are not square, so that neither focal length stands for the other.
TEST(PixelRays, LeadBackToTheirPixelsThroughTheLens) {
  Camera lens = TumCamera("tum1");
  lens.width = 48, lens.height = 36, lens.cx = 25.3, lens.cy = 16.8;
  lens.fx = 45.0, lens.fy = 38.0;
  Camera pinhole = lens;
  pinhole.k1 = pinhole.k2 = pinhole.p1 = pinhole.p2 = pinhole.k3 = 0.0;
  for (const Camera& camera : {lens, pinhole}) {
    const cv::Mat2d rays = PixelRays(camera);
    ASSERT_EQ(rays.size(), cv::Size(camera.width, camera.height));
    for (int v = 0; v < camera.height; v += 5) {
      for (int u = 0; u < camera.width; u += 5) {
        const Eigen::Vector3d x_c = 1.7 * Eigen::Vector3d(rays(v, u)[0], rays(v, u)[1], 1.0);
        EXPECT_THAT(camera.ProjectDistorted(x_c), VectorNear(Eigen::Vector2d(u, v), 1e-8));
      }
    }
  }
}

TEST(Camera, HasTheDerivativeOfItsProjection) {
  // With tangential terms as large as the radial ones, which no published calibration has.
  Camera strong = TumCamera("tum1");
  strong.p1 = 0.05, strong.p2 = -0.08;
  for (const Camera& camera : {Camera{}, TumCamera("tum1"), strong}) {
    for (const Eigen::Vector3d& x_c :
         {Eigen::Vector3d(0.3, -0.2, 1.5), Eigen::Vector3d(-0.7, 0.5, 1.2)}) {
      const Eigen::Matrix<double, 2, 3> J = camera.ProjectDistortedJacobian(x_c);
      for (int i = 0; i < 3; ++i) {
        constexpr double kStep_m = 1e-6;
        const Eigen::Vector3d step = kStep_m * Eigen::Vector3d::Unit(i);
        const Eigen::Vector2d moved =
            camera.ProjectDistorted(x_c + step) - camera.ProjectDistorted(x_c - step);
        EXPECT_THAT(Eigen::Vector2d(J.col(i)),
                    VectorNear(Eigen::Vector2d(moved / (2 * kStep_m)), 1e-5));
      }
    }
  }
}

TEST(Camera, PutsThePrincipalPointOnTheOpticalAxis) {
  const Camera camera;
  EXPECT_THAT(camera.Project({0, 0, 3}),
              VectorNear(Eigen::Vector2d(camera.cx, camera.cy), 0.0));
}

TEST(Camera, HasAnImageFromTheFirstPixelsMiddleToTheLasts) {
  const Camera camera;
  const Box image = camera.ImageBox();
  EXPECT_EQ(image.min, Eigen::Vector2d(0, 0));
  EXPECT_EQ(image.max, Eigen::Vector2d(camera.width - 1, camera.height - 1));
}

// The numbers that the benchmark's page prints (Sturm et al., IROS 2012), to their last digit.
TEST(Camera, KnowsTheCalibrationsOfTheTumBenchmark) {
  struct Printed {
    const char* name;
    double fx, fy, cx, cy, k1, k2, p1, p2, k3;
  };
  for (const Printed& printed :
       {Printed{"tum1", 517.3, 516.5, 318.6, 255.3, 0.2624, -0.9531, -0.0054, 0.0026, 1.1633},
        Printed{"tum2", 520.9, 521.0, 325.1, 249.7, 0.2312, -0.7849, -0.0033, -0.0001, 0.9172},
        Printed{"tum3", 535.4, 539.2, 320.1, 247.6, 0, 0, 0, 0, 0}}) {
    SCOPED_TRACE(printed.name);
    const Camera c = TumCamera(printed.name);
    const Eigen::Vector4d pixels(c.fx, c.fy, c.cx, c.cy);
    EXPECT_THAT(
        pixels,
        VectorNear(Eigen::Vector4d(printed.fx, printed.fy, printed.cx, printed.cy), 0.08));
    const Vector5d lens(c.k1, c.k2, c.p1, c.p2, c.k3);
    EXPECT_THAT(
        lens,
        VectorNear(Vector5d(printed.k1, printed.k2, printed.p1, printed.p2, printed.k3), 1e-4));
  }
}

TEST(Camera, RefusesAnUnknownCalibration) {
  EXPECT_THROW(static_cast<void>(TumCamera("tum4")), io::InputError);
}

TEST(PlaneTransformEq15, ThrowsWhenTheNormalIsNotUnit) {
  EXPECT_THROW(static_cast<void>(Transform(Pose{}, {Eigen::Vector3d(0, 0, 1.1), 1})),
               std::invalid_argument);
}

TEST(PlaneTransformEq15, MovesTheDeskAwayWhenTheCameraRises) {
  const Plane desk_w{Eigen::Vector3d::UnitZ(), 0};
  const Pose T_cw{Eigen::Matrix3d::Identity(), {0, 0, -0.7}};  // the camera is 0.7 m above
  EXPECT_THAT(Transform(T_cw, desk_w),
              PlaneNear((Plane{Eigen::Vector3d::UnitZ(), 0.7}), 0, 1e-15));
}

}  // namespace
}  // namespace slam
