// A mesh that is uneven within what is called flat: its planes are fitted, and their corners lie
// beside its own.
#include "sim/truth/mesh_corner.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <numbers>

#include "sim/scene/read_scene.h"
#include "sim/truth/frame_truth.h"
#include "tests/sim/support/sim_worlds.h"
#include "tests/support/temporary_folder.h"

namespace sim {
namespace {

using Eigen::Vector3d;

constexpr double kHalf_m = 0.1;

/// A cube about (0, 0, 1), its faces of two triangles each, its corners shifted along z by
/// `uneven_m` up and down in turn.
Scene UnevenCube(const std::filesystem::path& folder, double uneven_m) {
  std::ofstream file(folder / "it.obj");
  for (int i = 0; i < 8; ++i) {
    const int corner = i % 4;
    const bool right = corner == 1 || corner == 2, back = corner >= 2, high = i >= 4;
    const double sign = i % 2 == 0 ? 1 : -1;
    file << "v " << (right ? kHalf_m : -kHalf_m) << " " << (back ? kHalf_m : -kHalf_m) << " "
         << (high ? kHalf_m : -kHalf_m) + sign * uneven_m << "\n";
  }
  file << "f 1 4 3\nf 1 3 2\nf 5 6 7\nf 5 7 8\nf 1 2 6\nf 1 6 5\nf 2 3 7\nf 2 7 6\n"
          "f 3 4 8\nf 3 8 7\nf 4 1 5\nf 4 5 8\n";
  file.close();
  const std::string text =
      "format: pas-scene/1\nname: uneven\nobjects:\n"
      "  - {id: 1, name: cube, class: box, role: regular, mesh: it.obj, "
      "center_m: [0, 0, 1], flatness_mm: 10}\n";
  return ParseScene(text, (folder / "scene.yaml").string());
}

/// Eyes all round at 1 m, each more than 1 cm beside the planes of the faces.
std::vector<Vector3d> EyesAround() {
  std::vector<Vector3d> eyes_w;
  for (const double pitch : {-1.0, -0.5, 0.5, 1.0}) {
    for (int k = 0; k < 12; ++k) {
      const double yaw = 0.15 + k * std::numbers::pi / 6;
      eyes_w.push_back(Vector3d(0, 0, 1) + Vector3d(std::cos(pitch) * std::cos(yaw),
                                                    std::cos(pitch) * std::sin(yaw),
                                                    std::sin(pitch)));
    }
  }
  return eyes_w;
}

/// Whether one of the three faces of the cube that meet in a corner looks at the eye.
bool InPlainView(const Vector3d& x_w, const Vector3d& eye_w) {
  const Vector3d middle_w(0, 0, 1);
  for (int axis = 0; axis < 3; ++axis) {
    const double side = x_w[axis] > middle_w[axis] ? 1 : -1;
    if (side * (eye_w[axis] - middle_w[axis]) > kHalf_m) return true;
  }
  return false;
}

class UnevenMesh : public testing::TestWithParam<double> {
 protected:
  test_support::TemporaryFolder folder_;
  const Scene scene_ = UnevenCube(folder_.path(), GetParam());
};

TEST_P(UnevenMesh, HidesACornerOnlyWhereNoFaceOfItIsSeen) {
  const Camera camera;
  const FrameRenderer renderer(scene_, camera);
  const TruthMaker maker(renderer);
  ASSERT_EQ(renderer.standing().planes.size(), 6u);
  std::map<VertexState, int> count;
  int behind = 0;  // the fitted plane's corner behind the mesh's own triangles
  for (const Vector3d& eye_w : EyesAround()) {
    const Pose T_wc = LookAt(eye_w, {0, 0, 1});
    const FrameTruth truth = maker.Describe(renderer.Render(T_wc), T_wc);
    for (const PlaneInFrame& plane : truth.planes) {
      for (const VertexInFrame& vertex : plane.vertices) {
        ++count[vertex.state];
        EXPECT_EQ(vertex.state, VertexState::kVisible)
            << "plane " << plane.id << " from " << eye_w.transpose();
        EXPECT_TRUE(InPlainView(vertex.x_w, eye_w));
        behind += renderer.Sees(T_wc, vertex.x_w) ? 0 : 1;
      }
    }
    // Of faces that look away too.
    for (const auto& corners : MeshCorners(renderer.standing())) {
      for (const MeshCorner& corner : corners) {
        EXPECT_EQ(renderer.Sees(T_wc, corner.x_w, 0, corner.planes),
                  InPlainView(corner.x_w, eye_w))
            << corner.x_w.transpose() << " from " << eye_w.transpose();
      }
    }
  }
  EXPECT_GT(count[VertexState::kVisible], 300);
  EXPECT_EQ(behind > 0, GetParam() > 0);
}

TEST_P(UnevenMesh, HasThreePlanesInEachOfItsOwnCorners) {
  const SceneMesh mesh = BuildMesh(scene_);
  const auto corners = MeshCorners(mesh);
  ASSERT_EQ(corners.size(), 6u);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    ASSERT_EQ(corners[i].size(), mesh.planes[i].vertices_w.size());
    for (std::size_t k = 0; k < corners[i].size(); ++k) {
      EXPECT_EQ(corners[i][k].planes.size(), 3u);
      EXPECT_LT((corners[i][k].x_w - mesh.planes[i].vertices_w[k]).norm(),
                4 * GetParam() / 3 + 1e-6);
    }
  }
}

// Flat, the default's unevenness, and more.
INSTANTIATE_TEST_SUITE_P(MeshCorner, UnevenMesh, testing::Values(0.0, 0.0002, 0.0015));

TEST(MeshCorner, OfABoxIsThatOfItsFaceAndOwnedByNone) {
  const SceneMesh mesh = BuildMesh(SmallDesk());
  const auto corners = MeshCorners(mesh);
  ASSERT_EQ(corners.size(), mesh.planes.size());
  for (std::size_t i = 0; i < corners.size(); ++i) {
    ASSERT_EQ(corners[i].size(), 4u);
    for (std::size_t k = 0; k < corners[i].size(); ++k) {
      EXPECT_EQ(corners[i][k].x_w, mesh.planes[i].vertices_w[k]);
      EXPECT_TRUE(corners[i][k].planes.empty());
    }
  }
}

}  // namespace
}  // namespace sim
