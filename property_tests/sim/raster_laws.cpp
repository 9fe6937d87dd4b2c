// The ray tracer against a renderer of another kind that shares no code with it: OpenGL.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <sstream>

#include "property_tests/sim/render_worlds.h"
#include "sim/trace/frame_renderer.h"
#include "tests/support/gl_raster.h"

namespace sim {
namespace {

constexpr double kNear_m = 0.1, kFar_m = 20;

/// Two triangles a face, from the numbers of the scene alone; ids as formats.md counts planes.
std::vector<gl_raster::IdTriangle> TrianglesOf(const Scene& scene, const Pose& T_wc) {
  std::vector<gl_raster::IdTriangle> triangles;
  int id = 0;
  for (const Object& object : scene.objects) {
    for (int axis = 0; axis < 3; ++axis) {
      for (const double side : {-0.5, 0.5}) {
        ++id;
        std::array<Eigen::Vector3d, 4> corners_c;
        for (std::size_t k = 0; k < 4; ++k) {
          Eigen::Vector3d x;
          x[axis] = side;
          x[(axis + 1) % 3] = k == 0 || k == 3 ? -0.5 : 0.5;
          x[(axis + 2) % 3] = k < 2 ? -0.5 : 0.5;
          const Eigen::Vector3d x_w =
              object.center_w + object.q_wo.toRotationMatrix() * x.cwiseProduct(object.size);
          corners_c[k] = T_wc.R.transpose() * (x_w - T_wc.t);
        }
        triangles.push_back({{corners_c[0], corners_c[1], corners_c[2]}, id});
        triangles.push_back({{corners_c[0], corners_c[2], corners_c[3]}, id});
      }
    }
  }
  return triangles;
}

gl_raster::Raster DrawByGl(const Scene& scene, const Camera& camera, const Pose& T_wc) {
  gl_raster::GlRaster gl(camera.width, camera.height);
  return gl.Draw(TrianglesOf(scene, T_wc),
                 {camera.width, camera.height, camera.fx, camera.fy, camera.cx, camera.cy},
                 kNear_m, kFar_m);
}

/// Up to here a face's depth must agree; flatter ones run away within GL's 1/256 px.
const double kSteepestCosine = std::cos(84 * M_PI / 180);

/// Of a depth on a plane. GL interpolates in single precision over whole triangles; those of a
/// room are 14 m long and reach behind the camera, which costs three times as much.
double Tolerance(const Scene& scene, int plane, double z) {
  const bool of_room =
      plane > 0 && scene.objects[static_cast<std::size_t>(plane - 1) / 6].class_name == "wall";
  return gl_raster::DepthTolerance(z, kNear_m, kFar_m) + (of_room ? 3e-5 : 1e-5) * z;
}

/// Pixels in which ids or depths disagree where no edge is within a hundredth of a pixel; tells
/// of the first.
struct Comparison {
  int disagreements = 0;
  std::string first;
};
Comparison Compare(const Scene& scene, const Camera& camera, const Pose& T_wc,
                   const Rendering& traced, const gl_raster::Raster& raster) {
  Comparison result;
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      const double z = traced.depth_m(v, u), dz = raster.depth_m(v, u) - z;
      const double cosine = static_cast<double>(traced.incidence_cos(v, u));
      const double tolerance = Tolerance(scene, traced.plane_id(v, u), z);
      const bool same_depth = std::abs(dz) <= tolerance || cosine < kSteepestCosine;
      if (raster.id(v, u) == traced.plane_id(v, u) && same_depth) continue;
      if (!FarFromEdges(scene, camera, T_wc, u, v)) continue;
      if (++result.disagreements > 1) continue;
      std::ostringstream text;
      text << "pixel " << u << ' ' << v << ": plane " << traced.plane_id(v, u) << " and "
           << raster.id(v, u) << ", z " << z << " and " << dz << " more, allowed " << tolerance
           << ", cosine " << cosine;
      result.first = text.str();
    }
  }
  return result;
}

RC_GTEST_PROP(RenderedFrame, AgreesWithASoftwareGlRaster, ()) {
  const Scene scene = AnyScene();
  const Camera camera = AnyCamera();
  const Pose T_wc = AnyView();
  const Rendering traced = FrameRenderer(scene, camera).Render(T_wc, {.colour = false});
  const Comparison compared =
      Compare(scene, camera, T_wc, traced, DrawByGl(scene, camera, T_wc));
  RC_LOG() << compared.first;
  RC_ASSERT(compared.disagreements == 0);
}

TEST(SoftwareGlRaster, SeesAPrincipalPointHalfAPixelOff) {
  Scene boxes = SmallDesk();
  const Pose T_wc = SmallArc(1)[0].T_wc;
  boxes.objects.pop_back();  // the toy has no faces
  const Camera camera = SmallCamera();
  Camera wrong = camera;
  wrong.cx += 0.5;
  const Rendering traced = FrameRenderer(boxes, camera).Render(T_wc, {.colour = false});
  const auto disagreements = [&](const Camera& drawn) {
    return Compare(boxes, camera, T_wc, traced, DrawByGl(boxes, drawn, T_wc)).disagreements;
  };
  EXPECT_EQ(disagreements(camera), 0);
  EXPECT_GT(disagreements(wrong), 1000);
}

}  // namespace
}  // namespace sim
