#include "tests/support/gl_raster.h"

#include <GL/gl.h>
#include <GL/osmesa.h>

#include <cmath>
#include <cstdint>
#include <stdexcept>

namespace gl_raster {

struct GlRaster::Context {
  OSMesaContext handle = nullptr;
  std::vector<std::uint8_t> pixels;
  int width = 0, height = 0;
};

double DepthTolerance(double z_m, double near_m, double far_m) {
  return 1.5 * z_m * z_m * (far_m - near_m) / (far_m * near_m) * std::ldexp(1.0, -24);
}

GlRaster::GlRaster(int width, int height) : context_(std::make_unique<Context>()) {
  context_->width = width;
  context_->height = height;
  context_->pixels.resize(4 * static_cast<std::size_t>(width) *
                          static_cast<std::size_t>(height));
  context_->handle = OSMesaCreateContextExt(OSMESA_RGBA, 24, 0, 0, nullptr);
  if (context_->handle == nullptr ||
      OSMesaMakeCurrent(context_->handle, context_->pixels.data(), GL_UNSIGNED_BYTE, width,
                        height) == GL_FALSE) {
    throw std::runtime_error("OSMesa gives no context");
  }
}

GlRaster::~GlRaster() { OSMesaDestroyContext(context_->handle); }

namespace {

/// Clip coordinates from the camera frame: pixel (u, v) fills the square of half a pixel about
/// it, so u from -0.5 to width - 0.5 becomes -1 to 1, and v runs down while GL's y runs up.
void LoadProjection(const PinholeCamera& c, double near_m, double far_m) {
  const double depth = far_m - near_m;
  const std::array<double, 16> columns{2 * c.fx / c.width,
                                       0,
                                       0,
                                       0,  //
                                       0,
                                       -2 * c.fy / c.height,
                                       0,
                                       0,  //
                                       (2 * c.cx + 1) / c.width - 1,
                                       1 - (2 * c.cy + 1) / c.height,  //
                                       (far_m + near_m) / depth,
                                       1,
                                       0,
                                       0,
                                       -2 * far_m * near_m / depth,
                                       0};
  glMatrixMode(GL_PROJECTION);
  glLoadMatrixd(columns.data());
  glMatrixMode(GL_MODELVIEW);
  glLoadIdentity();
}

Raster ReadBack(int width, int height, double near_m, double far_m) {
  cv::Mat4b colours(height, width);
  cv::Mat1i depths(height, width);  // 32 bits without a sign, read as they are
  glPixelStorei(GL_PACK_ALIGNMENT, 4);
  glReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, colours.data);
  glReadPixels(0, 0, width, height, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT, depths.data);
  Raster raster{cv::Mat1d(height, width, 0.0), cv::Mat1i(height, width, 0)};
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      const cv::Vec4b& colour = colours(height - 1 - v, u);
      const int id = colour[0] | colour[1] << 8 | colour[2] << 16;
      if (id == 0) continue;
      const double share =
          static_cast<double>(static_cast<std::uint32_t>(depths(height - 1 - v, u))) /
          4294967295.0;
      raster.id(v, u) = id;
      raster.depth_m(v, u) = near_m * far_m / (far_m - share * (far_m - near_m));
    }
  }
  return raster;
}

}  // namespace

Raster GlRaster::Draw(const std::vector<IdTriangle>& triangles, const PinholeCamera& camera,
                      double near_m, double far_m) {
  OSMesaMakeCurrent(context_->handle, context_->pixels.data(), GL_UNSIGNED_BYTE,
                    context_->width, context_->height);
  glViewport(0, 0, camera.width, camera.height);
  glDisable(GL_DITHER);
  glDisable(GL_CULL_FACE);
  glEnable(GL_DEPTH_TEST);
  glShadeModel(GL_FLAT);
  glClearColor(0, 0, 0, 0);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  LoadProjection(camera, near_m, far_m);
  glBegin(GL_TRIANGLES);
  for (const IdTriangle& triangle : triangles) {
    const auto byte = [&](int shift) {
      return static_cast<GLubyte>(triangle.id >> shift & 0xff);
    };
    glColor4ub(byte(0), byte(8), byte(16), 255);
    for (const Eigen::Vector3d& x : triangle.corners_c) glVertex3d(x.x(), x.y(), x.z());
  }
  glEnd();
  glFinish();
  return ReadBack(camera.width, camera.height, near_m, far_m);
}

}  // namespace gl_raster
