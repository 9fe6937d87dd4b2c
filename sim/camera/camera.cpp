#include "sim/camera/camera.h"

#include <charconv>
#include <stdexcept>

namespace sim {
namespace {

/// Shortest text that reads back as the same number.
std::string Number(double value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value).ptr;
  return std::string(text, end);
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

std::string CameraYaml(const Camera& camera) {
  return "model: pinhole\nwidth: " + std::to_string(camera.width) +
         "\nheight: " + std::to_string(camera.height) + "\nfx: " + Number(camera.fx) +
         "\nfy: " + Number(camera.fy) + "\ncx: " + Number(camera.cx) +
         "\ncy: " + Number(camera.cy) + "\nfps: " + Number(camera.fps) +
         "\ndepth_factor: " + Number(camera.depth_factor) + "\n";
}

}  // namespace sim
