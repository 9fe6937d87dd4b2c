#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "property_tests/sim/render_worlds.h"
#include "sim/truth/frame_truth.h"

namespace sim {
namespace {

/// Faces of the box that meet in a corner and show their front, told by their normals alone;
/// -1 when one is seen nearly edge-on.
int FacesSeenAt(const Object& box, const Eigen::Vector3d& corner_w, const Pose& T_wc) {
  int seen = 0;
  const Eigen::Vector3d corner = box.q_wo.conjugate() * (corner_w - box.center_w);
  const Eigen::Vector3d eye = box.q_wo.conjugate() * (T_wc.t - box.center_w);
  for (int axis = 0; axis < 3; ++axis) {
    const double side = corner[axis] > 0 ? 1 : -1;
    const double before = side * eye[axis] - 0.5 * box.size[axis];
    if (std::abs(before) < 0.01) return -1;
    seen += before > 0 ? 1 : 0;
  }
  return seen;
}

// On a floor a box's lower corners are creases; an upper one is a crease where all three of its
// faces are seen, else depth breaks off beside it.
RC_GTEST_PROP(CornersOfABoxOnAFloor, LieAtASurfaceEdgeAsTheFacesThatAreSeenTell, ()) {
  Scene scene;
  const double height = Real(0.005, 0.4);
  scene.objects = {
      BoxObject(1, "floor", Role::kStructure, {0, 0, -0.05}, {20, 20, 0.1}),
      BoxObject(2, "box", Role::kRegular, {Real(-0.1, 0.1), Real(-0.1, 0.1), height / 2},
                {Real(0.05, 0.5), Real(0.05, 0.5), height})};
  const Object& box = scene.objects[1];
  scene.objects[1].q_wo =
      Eigen::Quaterniond(Eigen::AngleAxisd(Real(-M_PI, M_PI), Eigen::Vector3d::UnitZ()));
  const double azimuth = Real(-M_PI, M_PI), up = Real(0.3, 1.4), away = Real(0.8, 2.5);
  const Pose T_wc = LookAt({away * std::cos(azimuth) * std::cos(up),
                            away * std::sin(azimuth) * std::cos(up), away * std::sin(up)},
                           {0, 0, 0});
  const FrameRenderer renderer(scene, SmallCamera());
  const FrameTruth truth =
      TruthMaker(renderer).Describe(renderer.Render(T_wc, {.colour = false}), T_wc);
  int judged = 0;
  for (const PlaneInFrame& plane : truth.planes) {
    if (plane.id <= 6) continue;  // the floor's
    for (const VertexInFrame& vertex : plane.vertices) {
      if (vertex.state != VertexState::kVisible) {
        RC_ASSERT(!vertex.surface_ends);
        continue;
      }
      const int seen = FacesSeenAt(box, vertex.x_w, T_wc);
      if (seen < 0) continue;
      const bool lower = vertex.x_w.z() < height / 2;
      RC_ASSERT(vertex.surface_ends == (!lower && seen < 3));
      ++judged;
    }
  }
  RC_PRE(judged > 0);
}

}  // namespace
}  // namespace sim
