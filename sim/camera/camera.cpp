#include "sim/camera/camera.h"

#include <algorithm>
#include <array>
#include <limits>
#include <stdexcept>

#include "io/input_error.h"
#include "io/number_text.h"

namespace sim {
namespace {

/// Nothing when there is no distortion.
std::string LensYaml(const Lens& lens) {
  if (lens.IsNone()) return "";
  return "k1: " + io::NumberText(lens.k1) + "\nk2: " + io::NumberText(lens.k2) +
         "\np1: " + io::NumberText(lens.p1) + "\np2: " + io::NumberText(lens.p2) +
         "\nk3: " + io::NumberText(lens.k3) + "\n";
}

}  // namespace

Camera Resize(const Camera& camera, int width, int height) {
  if (width < 16 || height < 16 || width > 8192 || height > 8192) {
    throw std::invalid_argument("image size " + std::to_string(width) + "x" +
                                std::to_string(height) + ": expected 16 to 8192 pixels a side");
  }
  const double sx = static_cast<double>(width) / camera.width;
  const double sy = static_cast<double>(height) / camera.height;
  Camera resized = camera;
  resized.width = width;
  resized.height = height;
  resized.fx = camera.fx * sx;
  resized.fy = camera.fy * sy;
  resized.cx = (camera.cx + 0.5) * sx - 0.5;
  resized.cy = (camera.cy + 0.5) * sy - 0.5;
  return resized;
}

Camera CameraOf(const Capture& capture) {
  Camera camera;
  camera.width = capture.width;
  camera.height = capture.height;
  camera.fx = capture.fx;
  camera.fy = capture.fy;
  camera.cx = capture.cx;
  camera.cy = capture.cy;
  camera.fps = capture.fps;
  const auto& [k1, k2, p1, p2, k3] = capture.distortion.value_or(std::array<double, 5>{});
  return WithLens(Resize(camera, capture.width, capture.height), {k1, k2, p1, p2, k3});
}

Camera WithLens(const Camera& camera, const Lens& lens) {
  constexpr double kStep = 1e-3, kFarthest = 10.0, kMargin = 1.1, kRim_px = 2.0;
  Camera bent = camera;
  bent.lens = lens;
  bent.lens.reach = std::numeric_limits<double>::infinity();
  if (lens.IsNone()) return bent;

  // The radius up to which the radial part grows.
  double growing = 0;
  for (double r = 0; r < kFarthest; r += kStep) {
    const double r2 = r * r;
    if (!(1 + r2 * (3 * lens.k1 + r2 * (5 * lens.k2 + r2 * 7 * lens.k3)) > 0.02)) break;
    growing = r;
  }
  bent.lens.reach = growing;
  double corner = 0;
  const auto look = [&](double u, double v) {
    const double r = bent.Ray(u, v).head<2>().norm();
    if (!(r <= growing)) {
      throw io::InputError(
          "lens distortion: no single ray belongs to pixel (" + io::NumberText(u) + ", " +
          io::NumberText(v) +
          "); the coefficients k1 k2 p1 p2 k3 are too strong for this field of view");
    }
    corner = std::max(corner, r);
  };
  const double right = camera.width - 1 + kRim_px, low = camera.height - 1 + kRim_px;
  for (double u = -kRim_px; u <= right; u += 1) look(u, -kRim_px), look(u, low);
  for (double v = -kRim_px; v <= low; v += 1) look(-kRim_px, v), look(right, v);
  bent.lens.reach = std::min(growing, kMargin * corner);
  return bent;
}

std::string CameraYaml(const Camera& camera) {
  return "model: pinhole\nwidth: " + std::to_string(camera.width) +
         "\nheight: " + std::to_string(camera.height) + "\nfx: " + io::NumberText(camera.fx) +
         "\nfy: " + io::NumberText(camera.fy) + "\ncx: " + io::NumberText(camera.cx) +
         "\ncy: " + io::NumberText(camera.cy) + "\nfps: " + io::NumberText(camera.fps) +
         "\ndepth_factor: " + io::NumberText(camera.depth_factor) + "\n" +
         LensYaml(camera.lens);
}

}  // namespace sim
