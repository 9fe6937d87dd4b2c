#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <set>
#include <vector>

#include "property_tests/slam/depth_scenes.h"
#include "tests/support/cameras.h"

namespace slam {
namespace {

/// Faces that meet in a tip before the camera, which points at it or away from it.
struct Pyramid {
  std::vector<Plane> faces_c;
  bool points_at_camera = true;
};

Pyramid AnyPyramid(const Camera& camera) {
  constexpr double kLeastDihedral_rad = M_PI / 6;
  Pyramid pyramid;
  const int count = AnyInt(2, 8);
  pyramid.points_at_camera = AnyInt(0, 1) == 1;
  // 1 - cos(neighbours' angle) = sin^2(lean) (1 - cos(2 pi / count)).
  const double step_rad = 2 * M_PI / count;
  const double least_lean_rad =
      std::asin(std::sqrt((1 - std::cos(kLeastDihedral_rad)) / (1 - std::cos(step_rad))));
  const double lean_rad = AnyReal(least_lean_rad + 0.005, 0.87);
  const Eigen::Vector2d tip_px(camera.cx + 0.1 * camera.width * AnyReal(-1, 1),
                               camera.cy + 0.1 * camera.height * AnyReal(-1, 1));
  const Eigen::Vector3d tip_c = camera.Backproject(tip_px, AnyReal(0.8, 1.6));
  const Eigen::Vector3d axis = (ExpSo3(0.1 * AnyPoint(1)) * -tip_c.normalized()).normalized();
  const Eigen::Matrix<double, 3, 2> across = TangentBasis(axis);
  const double turn_rad = AnyReal(0, 2 * M_PI);
  for (int k = 0; k < count; ++k) {
    const double a = turn_rad + k * step_rad;
    const Eigen::Vector3d out = across * Eigen::Vector2d(std::cos(a), std::sin(a));
    const Eigen::Vector3d n =
        (std::cos(lean_rad) * axis + std::sin(lean_rad) * out).normalized();
    pyramid.faces_c.push_back({n, -n.dot(tip_c)});
  }
  return pyramid;
}

/// Depth and, at each pixel, 1 + the face; 0 where nothing is measured: beyond 8 m or 75 degrees.
closed_form::View ViewOfPyramid(const Pyramid& pyramid, const Camera& camera) {
  const cv::Mat2d rays = PixelRays(camera);
  closed_form::View view{cv::Mat1f(rays.size(), 0.0f), cv::Mat1i(rays.size(), 0)};
  for (int v = 0; v < rays.rows; ++v) {
    for (int u = 0; u < rays.cols; ++u) {
      const Eigen::Vector3d ray(rays(v, u)[0], rays(v, u)[1], 1.0);
      // A solid that points at the camera is entered at the last of its faces, a hollow one at
      // the first.
      int face = -1;
      double inverse_z = 0.0;
      for (std::size_t k = 0; k < pyramid.faces_c.size(); ++k) {
        const double q = -pyramid.faces_c[k].n.dot(ray) / pyramid.faces_c[k].d;
        const bool take =
            face < 0 || (pyramid.points_at_camera ? q < inverse_z : q > inverse_z);
        if (take) face = static_cast<int>(k), inverse_z = q;
      }
      const Eigen::Vector3d& n = pyramid.faces_c[static_cast<std::size_t>(face)].n;
      if (!(inverse_z > 1.0 / 8.0) || -n.dot(ray) / ray.norm() < 0.2588) continue;
      view.depth_m(v, u) = static_cast<float>(1.0 / inverse_z);
      view.face(v, u) = face + 1;
    }
  }
  return view;
}

RC_GTEST_PROP(PlaneExtraction, EveryFaceOfAPyramidIsOneSegmentAndThereIsNoOther, ()) {
  constexpr int kLeastFace_px = 40 * 40;
  const Camera camera = HalfCamera();
  const Pyramid pyramid = AnyPyramid(camera);
  const closed_form::View view = ViewOfPyramid(pyramid, camera);
  const auto faces = static_cast<int>(pyramid.faces_c.size());
  for (int face = 1; face <= faces; ++face) {
    if (cv::countNonZero(view.face == face) < kLeastFace_px) RC_DISCARD("a face hardly seen");
  }
  const Frame frame = Extract(view.depth_m, camera);
  RC_ASSERT(frame.planes.size() == pyramid.faces_c.size());

  std::set<int> used;
  for (int face = 1; face <= faces; ++face) {
    const cv::Mat mask = view.face == face;
    int best = 0, most = 0;
    for (int label = 1; label <= faces; ++label) {
      const int both = cv::countNonZero(mask & (frame.plane_labels == label));
      if (both > most) best = label, most = both;
    }
    RC_ASSERT(most >= 0.9 * cv::countNonZero(mask));  // completeness
    RC_ASSERT(!used.contains(best));                  // one to one
    used.insert(best);
    const Plane& truth = pyramid.faces_c[static_cast<std::size_t>(face - 1)];
    RC_ASSERT(Angle(frame.planes[static_cast<std::size_t>(best - 1)].pi_c.n, truth.n) < 0.01);
    // Purity, but for the pixels along a crease, which lie on both faces within the noise.
    int inside = 0, right = 0;
    for (int v = 1; v + 1 < camera.height; ++v) {
      for (int u = 1; u + 1 < camera.width; ++u) {
        const int f = view.face(v, u);
        const bool interior = view.face(v, u - 1) == f && view.face(v, u + 1) == f &&
                              view.face(v - 1, u) == f && view.face(v + 1, u) == f;
        if (frame.plane_labels(v, u) != best || !interior) continue;
        ++inside, right += f == face ? 1 : 0;
      }
    }
    RC_ASSERT(right >= 0.99 * inside);
  }
}

}  // namespace
}  // namespace slam
