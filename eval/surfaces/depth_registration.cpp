#include "eval/surfaces/depth_registration.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "io/yaml_value.h"

namespace eval {
namespace {

constexpr double kMaxApart_m = 1.0;  // two cameras of one device are some centimetres apart

Camera ReadIntrinsics(const io::YamlValue& value, bool with_lens) {
  std::vector<std::string> keys{"width", "height", "fx", "fy", "cx", "cy"};
  const std::vector<std::string> lens{"k1", "k2", "p1", "p2", "k3"};
  if (with_lens) keys.insert(keys.end(), lens.begin(), lens.end());
  const io::YamlMap map(value, keys);
  const io::Interval size("(0, 100000)"), positive("(0, inf)"), any("(-inf, inf)");
  Camera camera;
  camera.width = map.At("width").Whole(size);
  camera.height = map.At("height").Whole(size);
  camera.fx = map.At("fx").Number(positive, "pixels");
  camera.fy = map.At("fy").Number(positive, "pixels");
  camera.cx = map.At("cx").Number(any, "pixels");
  camera.cy = map.At("cy").Number(any, "pixels");
  for (std::size_t i = 0; i < lens.size(); ++i) {
    if (map.Has(lens[i])) camera.distortion[i] = map.At(lens[i]).Number(any, "as OpenCV's");
  }
  return camera;
}

/// The distance from the axis, at depth 1, from which on the lens's model goes back inwards.
double FoldOf(const Camera& camera) {
  const auto& k = camera.distortion;
  constexpr double kStep = 1e-3;
  constexpr int kSteps = 10000;  // 84 degrees from the axis
  for (int i = 0; i < kSteps; ++i) {
    const double r2 = std::pow(kStep * i, 2);
    if (!(1 + r2 * (3 * k[0] + r2 * (5 * k[1] + r2 * 7 * k[4])) > 0)) return kStep * i;
  }
  return std::numeric_limits<double>::infinity();
}

/// Writes a depth to the pixels that its own pixel covers in the colour image.
void Splat(cv::Mat1f& laid_m, const Eigen::Vector2d& centre_px, const Eigen::Vector2d& half_px,
           float depth_m) {
  const int u0 = std::max(0, int(std::ceil(centre_px.x() - half_px.x())));
  const int v0 = std::max(0, int(std::ceil(centre_px.y() - half_px.y())));
  const int u1 = std::min(laid_m.cols - 1, int(std::floor(centre_px.x() + half_px.x())));
  const int v1 = std::min(laid_m.rows - 1, int(std::floor(centre_px.y() + half_px.y())));
  for (int v = v0; v <= v1; ++v) {
    for (int u = u0; u <= u1; ++u) {
      float& there_m = laid_m(v, u);
      if (!(there_m > 0) || depth_m < there_m) there_m = depth_m;
    }
  }
}

}  // namespace

DepthRegistration ReadDepthRegistration(const std::filesystem::path& file) {
  const io::YamlMap map(io::ReadYaml(file, "expected a file with depth, colour, translation"),
                        {"depth", "colour", "translation", "rotation"});
  DepthRegistration registration;
  registration.depth = ReadIntrinsics(map.At("depth"), false);
  registration.colour = ReadIntrinsics(map.At("colour"), true);
  registration.T_colour_depth.t =
      map.At("translation").Numbers(3, io::Interval(-kMaxApart_m, kMaxApart_m), "metres");
  if (map.Has("rotation")) {
    const Eigen::Vector4d q = map.At("rotation").Numbers(4, io::Interval(-1, 1));
    constexpr double kUnit = 1e-3;  // as four written decimals may be off
    if (!(std::abs(q.norm() - 1) <= kUnit)) {
      map.At("rotation").Fail("expected a unit quaternion [x, y, z, w]; normalise it");
    }
    registration.T_colour_depth.R = RotationOf(q[0], q[1], q[2], q[3]);
  }
  return registration;
}

cv::Mat1f LayOnColour(const cv::Mat1f& depth_m, const DepthRegistration& registration) {
  const Camera& from = registration.depth;
  const Camera& to = registration.colour;
  cv::Mat1f laid_m(to.height, to.width, 0.0F);
  // A pixel of depth is as wide on colour as the focal lengths say, and a little more, so that
  // rounding leaves no holes.
  constexpr double kHalfPixel = 0.51;
  const Eigen::Vector2d half_px(kHalfPixel * std::max(1.0, to.fx / from.fx),
                                kHalfPixel * std::max(1.0, to.fy / from.fy));
  const double fold = FoldOf(to);
  for (int v = 0; v < depth_m.rows; ++v) {
    for (int u = 0; u < depth_m.cols; ++u) {
      const double z = depth_m(v, u);
      if (!(z > 0)) continue;
      const Eigen::Vector3d x_depth(z * (u - from.cx) / from.fx, z * (v - from.cy) / from.fy,
                                    z);
      const Eigen::Vector3d x_colour = registration.T_colour_depth * x_depth;
      if (!(x_colour.z() > 0) || !(x_colour.head<2>().norm() < fold * x_colour.z())) continue;
      Splat(laid_m, PixelOf(to, x_colour), half_px, float(x_colour.z()));
    }
  }
  return laid_m;
}

}  // namespace eval
