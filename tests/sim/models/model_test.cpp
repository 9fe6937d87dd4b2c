#include "sim/models/model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <Eigen/Geometry>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "io/input_error.h"
#include "io/sha256.h"
#include "sim/scene/read_scene.h"
#include "sim/scene/write_scene.h"
#include "sim/shapes/mesh.h"
#include "sim/shapes/planes.h"
#include "sim/shapes/steps.h"
#include "tests/support/refusal.h"
#include "tests/support/temporary_folder.h"

namespace sim {
namespace {

using Eigen::Vector3d;
using testing::HasSubstr;

/// Files hold decimals, the reader single precision: 1 m to 6e-8.
constexpr double kSingle_m = 1e-7;

/// A cube of side 0.1 from the origin, six quads.
const std::string kCube =
    "v 0 0 0\nv 0.1 0 0\nv 0.1 0.1 0\nv 0 0.1 0\nv 0 0 0.1\nv 0.1 0 0.1\nv 0.1 0.1 0.1\n"
    "v 0 0.1 0.1\nf 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

/// An L of arms 0.2 long and 0.1 wide, 0.05 high, its inner corner at (0.1, 0.1).
std::string LPrism() {
  const double l[6][2] = {{0, 0}, {.2, 0}, {.2, .1}, {.1, .1}, {.1, .2}, {0, .2}};
  std::string text;
  for (const double z : {0.0, 0.05}) {
    for (const auto& p : l) {
      text += "v " + std::to_string(p[0]) + " " + std::to_string(p[1]) + " " +
              std::to_string(z) + "\n";
    }
  }
  text += "f 6 5 4 3 2 1\nf 7 8 9 10 11 12\n";
  for (int i = 0; i < 6; ++i) {
    const int a = i + 1, b = (i + 1) % 6 + 1;
    text += "f " + std::to_string(a) + " " + std::to_string(b) + " " + std::to_string(b + 6) +
            " " + std::to_string(a + 6) + "\n";
  }
  return text;
}

/// A square tube: a frame with an outside of 0.2, a hole of 0.1, 0.04 high.
std::string Frame() {
  std::string text;
  for (const double z : {0.0, 0.04}) {
    for (const double side : {0.2, 0.1}) {
      for (const auto& [x, y] : {std::pair(-1, -1), {1, -1}, {1, 1}, {-1, 1}}) {
        text += "v " + std::to_string(x * side / 2) + " " + std::to_string(y * side / 2) + " " +
                std::to_string(z) + "\n";
      }
    }
  }
  const auto quad = [&](int a, int b, int c, int d) {
    text += "f " + std::to_string(a) + " " + std::to_string(b) + " " + std::to_string(c) + " " +
            std::to_string(d) + "\n";
  };
  for (int i = 0; i < 4; ++i) {
    const int a = i + 1, b = (i + 1) % 4 + 1;  // outer, below; +4 inner, +8 above
    quad(a, b, b + 8, a + 8);                  // outside
    quad(b + 4, a + 4, a + 12, b + 12);        // inside
    quad(a + 8, b + 8, b + 12, a + 12);        // top
    quad(b, a, a + 4, b + 4);                  // bottom
  }
  return text;
}

/// Twelve facets, radius 0.1, height 0.2: something round.
std::string Drum(int corners) {
  std::string text, bottom = "f", top = "f", sides;
  for (int i = 0; i < corners; ++i) {
    const double turn = 2 * M_PI * i / corners;
    for (const double z : {0.0, 0.2}) {
      text += "v " + std::to_string(0.1 * std::cos(turn)) + " " +
              std::to_string(0.1 * std::sin(turn)) + " " + std::to_string(z) + "\n";
    }
    const int a = 2 * i + 1, b = 2 * ((i + 1) % corners) + 1;
    sides += "f " + std::to_string(a) + " " + std::to_string(b) + " " + std::to_string(b + 1) +
             " " + std::to_string(a + 1) + "\n";
    top += " " + std::to_string(2 * i + 2);
    bottom += " " + std::to_string(2 * (corners - 1 - i) + 1);
  }
  return text + sides + top + "\n" + bottom + "\n";
}

/// Every triangle has a plane, in which all its corners lie.
void ExpectTrianglesInTheirPlanes(const Model& model, double within_m) {
  for (std::size_t t = 0; t < model.triangles.size(); ++t) {
    ASSERT_GE(model.plane_of[t], 0) << t;
    const ModelPlane& plane = model.planes.at(static_cast<std::size_t>(model.plane_of[t]));
    for (const int i : model.triangles[t]) {
      const Vector3d& x = model.vertices_o[static_cast<std::size_t>(i)];
      EXPECT_LE(std::abs(plane.n_o.dot(x) + plane.d), within_m) << t;
    }
  }
}

class OwnMesh : public testing::Test {
 protected:
  void Write(const std::string& text, const std::string& name = "it.obj") const {
    std::ofstream(folder_ / name) << text;
  }
  Model Read(const std::string& text, ModelOptions options = {}) const {
    Write(text);
    options.file = "it.obj";
    return ReadModel(options, folder_);
  }
  std::string ErrorOf(const std::string& text, const ModelOptions& options = {}) const {
    return test_support::RefusalOf([&] { Read(text, options); });
  }
  std::string SceneWith(const std::string& lines) const {
    return "format: pas-scene/1\nname: own\nobjects:\n  - {id: 1, name: floor, class: floor, "
           "role: structure, center_m: [0, 0, -0.05], size_m: [4, 4, 0.1]}\n"
           "  - id: 2\n    name: own\n    class: box\n    role: regular\n" +
           lines;
  }
  Scene Parse(const std::string& lines) const {
    return ParseScene(SceneWith(lines), (folder_ / "scene.yaml").string());
  }
  std::string ParseError(const std::string& lines) const {
    return test_support::RefusalOf([&] { Parse(lines); });
  }
  test_support::TemporaryFolder temporary_;
  const std::filesystem::path folder_ = temporary_.path();
};

TEST_F(OwnMesh, GivesACubeItsSixPlanes) {
  const Model cube = Read(kCube);
  ASSERT_EQ(cube.planes.size(), 6u);
  EXPECT_LT((cube.size - Vector3d::Constant(0.1)).norm(), kSingle_m);
  Vector3d sum = Vector3d::Zero();
  for (const ModelPlane& plane : cube.planes) {
    sum += plane.n_o.cwiseAbs();
    EXPECT_NEAR(plane.n_o.cwiseAbs().maxCoeff(), 1, 1e-12);
    EXPECT_NEAR(plane.d, -0.05, kSingle_m) << "the origin is in the middle";
    EXPECT_NEAR(plane.area_m2, 0.01, kSingle_m);
    ASSERT_EQ(plane.outline_o.size(), 4u);
    const Vector3d turn = (plane.outline_o[1] - plane.outline_o[0])
                              .cross(plane.outline_o[2] - plane.outline_o[1]);
    EXPECT_NEAR(turn.dot(plane.n_o), 0.01, kSingle_m);
    EXPECT_TRUE(plane.holes_o.empty());
  }
  EXPECT_LT((sum - Vector3d(2, 2, 2)).norm(), 1e-12);
  EXPECT_EQ(std::count(cube.plane_of.begin(), cube.plane_of.end(), -1), 0);
}

TEST_F(OwnMesh, FollowsTheOutlineOfAnLRoundItsInnerCorner) {
  const Model prism = Read(LPrism());
  ASSERT_EQ(prism.planes.size(), 8u);
  const ModelPlane& l =
      prism.planes[0].outline_o.size() == 6 ? prism.planes[0] : prism.planes[1];
  ASSERT_EQ(l.outline_o.size(), 6u);
  EXPECT_NEAR(l.area_m2, 0.03, kSingle_m);
  int inward = 0;
  for (std::size_t i = 0; i < 6; ++i) {
    const Vector3d a = l.outline_o[(i + 1) % 6] - l.outline_o[i];
    const Vector3d b = l.outline_o[(i + 2) % 6] - l.outline_o[(i + 1) % 6];
    if (!(l.n_o.dot(a.cross(b)) < 0)) continue;
    ++inward;
    EXPECT_LT(l.outline_o[(i + 1) % 6].head<2>().norm(), kSingle_m) << "(0.1, 0.1) of the file";
  }
  EXPECT_EQ(inward, 1);
}

TEST_F(OwnMesh, KeepsTheHoleOfAFrameOutOfItsTop) {
  const Model frame = Read(Frame());
  int with_hole = 0;
  for (const ModelPlane& plane : frame.planes) {
    if (plane.holes_o.empty()) continue;
    ++with_hole;
    EXPECT_NEAR(plane.area_m2, 0.04 - 0.01, kSingle_m);
    ASSERT_EQ(plane.holes_o.size(), 1u);
    EXPECT_EQ(plane.holes_o[0].size(), 4u);
    EXPECT_EQ(plane.outline_o.size(), 4u);
  }
  EXPECT_EQ(with_hole, 2);
  EXPECT_EQ(frame.planes.size(), 10u);
}

TEST_F(OwnMesh, TakesItsHolesAlongWhereItStands) {
  Object object;
  object.shape = ShapeKind::kMesh;
  object.model = std::make_shared<Model>(Read(Frame()));
  object.center_w = {1, 2, 3};
  object.q_wo = Eigen::AngleAxisd(0.7, Vector3d(1, 2, 3).normalized());
  Scene scene;
  scene.objects = {object};
  int holes = 0;
  for (const ScenePlane& plane : ScenePlanes(scene)) {
    for (const auto& hole : plane.holes_w) {
      ++holes;
      Vector3d middle = Vector3d::Zero(), hole_middle = Vector3d::Zero();
      for (const Vector3d& x_w : plane.vertices_w) middle += x_w / 4;
      for (const Vector3d& x_w : hole) {
        EXPECT_NEAR(plane.n_w.dot(x_w) + plane.d, 0.0, kSingle_m);
        hole_middle += x_w / 4;
      }
      EXPECT_LT((middle - hole_middle).norm(), kSingle_m);  // a frame is as wide all round
    }
  }
  EXPECT_EQ(holes, 2);
}

// Pulled up by h, the fourth corner of a quad stands h / 4 or less off the plane that fits
// best.
TEST_F(OwnMesh, TakesANearlyFlatQuadForOnePlaneUpToTheTolerance) {
  const auto pulled = [](double up_m) {
    std::string text = kCube;
    const std::string corner = "v 0.1 0.1 0.1\n";
    text.replace(text.find(corner), corner.size(),
                 "v 0.1 0.1 " + std::to_string(0.1 + up_m) + "\n");
    return text;
  };
  ModelOptions options;
  options.flatness_m = 2e-4;
  const Model flat = Read(pulled(1.5e-4), options);
  EXPECT_EQ(flat.planes.size(), 6u);
  ExpectTrianglesInTheirPlanes(flat, options.flatness_m);
  for (const ModelPlane& plane : flat.planes) {
    for (const Vector3d& x : plane.outline_o) EXPECT_NEAR(plane.n_o.dot(x) + plane.d, 0, 1e-15);
  }
  // 5 mm over 0.1 m: the two halves of the top are planes of their own.
  EXPECT_EQ(Read(pulled(5e-3), options).planes.size(), 7u);
}

TEST_F(OwnMesh, FindsNoPlaneOnWhatIsRound) {
  EXPECT_EQ(Read(Drum(48)).planes.size(), 2u) << "top and bottom";
  EXPECT_EQ(Read(Drum(8)).planes.size(), 10u) << "45 degrees is an edge";
}

TEST_F(OwnMesh, LeavesOutPlanesSmallerThanAsked) {
  ModelOptions options;
  options.min_plane_m2 = 0.006;
  EXPECT_EQ(Read(LPrism(), options).planes.size(), 4u) << "two L, two sides of 0.2 x 0.05";
}

TEST_F(OwnMesh, TakesDeclaredPlanesOnly) {
  ModelOptions options;
  options.declared = {{{0, 0, .1}, {0, .1, .1}, {.1, .1, .1}, {.1, 0, .1}}};  // turns right
  const Model cube = Read(kCube, options);
  ASSERT_EQ(cube.planes.size(), 1u);
  EXPECT_LT((cube.planes[0].n_o - Vector3d::UnitZ()).norm(), 1e-9);
  EXPECT_EQ(std::count(cube.plane_of.begin(), cube.plane_of.end(), 0), 2);
  options.declared[0] = {{0, 0, .3}, {0, .1, .3}, {.1, .1, .3}};
  EXPECT_THAT(ErrorOf(kCube, options), HasSubstr("no triangle in plane 1"));
}

TEST_F(OwnMesh, TakesCornersOfDeclaredPlanesInTheUnitsOfTheFile) {
  ModelOptions options;
  options.scale = 3;
  options.declared = {{{0, 0, .1}, {.1, 0, .1}, {.1, .1, .1}, {0, .1, .1}}};
  const ModelPlane top = Read(kCube, options).planes.at(0);
  EXPECT_LT((top.n_o - Vector3d::UnitZ()).norm(), 1e-9);
  EXPECT_NEAR(top.d, -0.15, 3 * kSingle_m);
  EXPECT_NEAR(top.area_m2, 0.09, 3 * kSingle_m);
}

TEST_F(OwnMesh, SaysWhatIsWrongWithAFile) {
  ModelOptions missing;
  missing.file = "nowhere.obj";
  EXPECT_THROW(ReadModel(missing, folder_), io::InputError);
  EXPECT_THAT(ErrorOf("v 0 0 0\nv 1 0 0\nv 0 1 0\n"), HasSubstr("it.obj"));
  EXPECT_THAT(ErrorOf("no mesh at all"), HasSubstr("it.obj"));
  std::string text = kCube;
  text.replace(text.find("v 0.1 0 0\n"), 10, "v nan 0 0\n");
  EXPECT_THAT(ErrorOf(text), HasSubstr("not finite"));
  (text = kCube).erase(kCube.find("f 2 3 7 6\n"), 10);  // one side is missing
  EXPECT_THAT(ErrorOf(text), HasSubstr("4 have one triangle"));
  ModelOptions options;
  options.scale = 3;
  EXPECT_THAT(ErrorOf(text, options), HasSubstr("the first is at (0.1, 0.1, 0)"))
      << "of the file";
  options.open_edges = 0.3;
  EXPECT_EQ(Read(text, options).planes.size(), 5u);
  options.flip = true;
  EXPECT_THAT(ErrorOf(text, options), HasSubstr("inside out"));
  (text = kCube).replace(kCube.find("f 5 6 7 8"), 9, "f 8 7 6 5");
  EXPECT_THAT(ErrorOf(text), HasSubstr("4 two that disagree"));
  options.open_edges = 0;
  EXPECT_THAT(ErrorOf(kCube, options), HasSubstr("inside out"));
  options.scale = 1000;
  EXPECT_THAT(ErrorOf(kCube, options), HasSubstr("100 m large"));
}

TEST_F(OwnMesh, StandsInASceneAsItSays) {
  Write(LPrism());
  const Scene scene =
      Parse("    mesh: it.obj\n    origin_m: [1, 0, 0]\n    rpy_deg: [0, 0, 90]\n");
  const Object& own = scene.objects.at(1);
  EXPECT_LT((own.center_w - Vector3d(0.9, 0.1, 0.025)).norm(), kSingle_m);
  // The file's x runs along the world's y.
  Eigen::AlignedBox3d box;
  for (const Triangle& t : BuildMesh(scene).triangles) {
    if (t.object != 2) continue;
    for (const Vector3d& x_w : t.corners_w) box.extend(x_w);
    ASSERT_GT(t.plane, 6);
  }
  EXPECT_LT((box.min() - Vector3d(0.8, 0, 0)).norm(), kSingle_m);
  EXPECT_LT((box.max() - Vector3d(1, 0.2, 0.05)).norm(), kSingle_m);
  const auto planes = ScenePlanes(scene);
  EXPECT_EQ(planes.size(), 6u + 8u);
  for (const Triangle& t : BuildMesh(scene).triangles) {
    const ScenePlane& plane = planes.at(static_cast<std::size_t>(t.plane) - 1);
    for (const Vector3d& x_w : t.corners_w) {
      EXPECT_NEAR(plane.n_w.dot(x_w) + plane.d, 0, kSingle_m);
    }
    for (const Vector3d& n_w : t.normals_w) EXPECT_LT((n_w - plane.n_w).norm(), kSingle_m);
  }
  const auto steps = TopSteps(scene, ScenePlanes(scene));
  ASSERT_EQ(steps.size(), 1u);
  EXPECT_NEAR(steps[0].step_mm, 50, 1e-4);
  const std::string text = SceneText(scene);
  EXPECT_EQ(SceneText(ParseScene(text, (folder_ / "scene.yaml").string())), text);
}

TEST_F(OwnMesh, ChangesTheHashOfTheSceneWithItsBytes) {
  Write(kCube);
  const std::string lines = "    mesh: it.obj\n    center_m: [0, 0, 0.06]\n";
  const Scene before = Parse(lines);
  EXPECT_EQ(before.objects[1].model->sha256, io::Sha256OfFile(folder_ / "it.obj"));
  Write(kCube + "# a comment\n");
  EXPECT_NE(SceneHash(Parse(lines)), SceneHash(before));
  EXPECT_THAT(ParseError(lines + "    mesh_sha256: " + before.objects[1].model->sha256 + "\n"),
              HasSubstr("mesh has changed"));
}

TEST_F(OwnMesh, TakesItsColourFromTheFileOrThePrintOfTheScene) {
  Write("newmtl red\nKd 0.8 0.1 0.05\n", "it.mtl");
  Write("mtllib it.mtl\nusemtl red\n" + kCube);
  const std::string lines = "    mesh: it.obj\n    center_m: [0, 0, 0.06]\n";
  const SceneMesh plain = BuildMesh(Parse(lines));
  const Material& red = plain.materials.back();
  EXPECT_NEAR(red.colour[0], 0.8, 1e-6);
  EXPECT_EQ(red.richness, 0);
  const SceneMesh printed =
      BuildMesh(Parse(lines + "    faces: {all: {print: text, seed: 5}}\n"));
  EXPECT_EQ(printed.materials.back().print, Print::kText);
  EXPECT_EQ(printed.materials.size(), 6u + 6u) << "a print for each plane";
  // The print is written with the scene, and is part of what the hash sees.
  const std::string text = lines + "    faces: {all: {print: text, seed: 5}}\n";
  EXPECT_NE(SceneText(Parse(text)).find("print: text"), std::string::npos);
  EXPECT_NE(SceneHash(Parse(text)),
            SceneHash(Parse(lines + "    faces: {all: {print: cover, seed: 5}}\n")));
  // The colours are part of what the hash sees.
  const std::string hash = SceneHash(Parse(lines));
  Write("newmtl red\nKd 0.1 0.1 0.8\n", "it.mtl");
  EXPECT_NE(SceneHash(Parse(lines)), hash);
}

TEST_F(OwnMesh, LeavesOutATriangleThatRepeatsACorner) {
  EXPECT_EQ(Read(kCube + "f 1 2 2\n").triangles.size(), Read(kCube).triangles.size());
}

TEST_F(OwnMesh, LeavesEachTriangleItsColourAndPlaneWhereOneWithoutAreaIsLeftOut) {
  Write("newmtl red\nKd 0.8 0.1 0.05\nnewmtl blue\nKd 0.05 0.1 0.8\n", "it.mtl");
  // A ninth corner in an edge of two faces, of which one knows it: between them no area is left.
  std::string blue = kCube + "v 0.05 0 0\n";
  const std::string side = "f 1 2 6 5\n";
  blue.replace(blue.find(side), side.size(), "f 9 2 6 5 1\n");
  const Model cube = Read("mtllib it.mtl\nusemtl red\nf 1 2 9\nusemtl blue\n" + blue);
  ASSERT_EQ(cube.triangles.size(), 13u);
  for (const int colour : cube.colour_of)
    EXPECT_NEAR(cube.colours[static_cast<std::size_t>(colour)][2], 0.8, 1e-6);
  EXPECT_EQ(cube.planes.size(), 6u);
  ExpectTrianglesInTheirPlanes(cube, kSingle_m);
}

TEST_F(OwnMesh, WaitsForNoPipeThatItNames) {
  ASSERT_EQ(mkfifo((folder_ / "it.mtl").c_str(), 0600), 0);
  Write("mtllib it.mtl\nusemtl red\n" + kCube);
  EXPECT_EQ(Parse("    mesh: it.obj\n    center_m: [0, 0, 0.06]\n").objects.size(), 2u);
}

TEST_F(OwnMesh, NamesTheLineOfAWrongKey) {
  Write(kCube);
  const std::string mesh = "    mesh: it.obj\n";
  EXPECT_THAT(ParseError(mesh), HasSubstr("center_m"));
  EXPECT_THAT(ParseError(mesh + "    center_m: [0, 0, 1]\n    size_m: [1, 1, 1]\n"),
              HasSubstr("scene.yaml:11"));
  EXPECT_THAT(ParseError("    center_m: [0, 0, 1]\n    size_m: [1, 1, 1]\n    scale: 2\n"),
              HasSubstr("name its file"));
  EXPECT_THAT(ParseError("    shape: mesh\n    center_m: [0, 0, 1]\n"), HasSubstr("`mesh`"));
  EXPECT_THAT(ParseError(mesh + "    shape: toy\n    center_m: [0, 0, 1]\n"),
              HasSubstr("leave it out"));
  EXPECT_THAT(ParseError(mesh + "    center_m: [0, 0, 0.02]\n"), HasSubstr("below the floor"));
}

}  // namespace
}  // namespace sim
