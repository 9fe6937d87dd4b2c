#include "slam/input/camera_reader.h"

#include <cmath>

#include "slam/input/yaml_map.h"

namespace slam {
namespace {

/// The lens must be invertible over the whole image: a pixel that does not come back from its
/// ray means that the coefficients are wrong (or of another model).
void RequireInvertible(const Camera& c, YamlMap& map) {
  constexpr double kTolerance_px = 0.5;
  for (int i = 0; i <= 8; ++i) {
    for (int j = 0; j <= 8; ++j) {
      const Eigen::Vector2d u((c.width - 1) * i / 8.0, (c.height - 1) * j / 8.0);
      const Eigen::Vector2d ideal = c.Undistort(u);
      const Eigen::Vector2d back = c.ProjectDistorted(c.Backproject(ideal, 1.0));
      if (!((back - u).norm() < kTolerance_px))
        map.Fail("k1", "the distortion k1 k2 p1 p2 k3 cannot be inverted over a " +
                           std::to_string(c.width) + " x " + std::to_string(c.height) +
                           " image; check the coefficients and their order");
    }
  }
}

}  // namespace

Camera ReadCamera(const std::filesystem::path& file) {
  YamlMap map = YamlMap::Load(file);
  const Interval size = ParseInterval("[16, 8192]"), focal = ParseInterval("[1, 100000]");
  const Interval lens = ParseInterval("[-100, 100]");
  map.Choice("model", {"pinhole"}, "pinhole");
  Camera c;
  c.width = static_cast<int>(map.Integer("width", size));
  c.height = static_cast<int>(map.Integer("height", size));
  c.fx = map.Number("fx", focal);
  c.fy = map.Number("fy", focal);
  c.cx = map.Number("cx", ParseInterval("[-8192, 16384]"));
  c.cy = map.Number("cy", ParseInterval("[-8192, 16384]"));
  c.fps = map.Number("fps", ParseInterval("(0, 10000]"), c.fps);
  c.depth_factor = map.Number("depth_factor", ParseInterval("[1, 1000000]"), c.depth_factor);
  c.k1 = map.Number("k1", lens, 0.0);
  c.k2 = map.Number("k2", lens, 0.0);
  c.p1 = map.Number("p1", lens, 0.0);
  c.p2 = map.Number("p2", lens, 0.0);
  c.k3 = map.Number("k3", lens, 0.0);
  map.Finish();
  if (!c.ImageBox().Contains({c.cx, c.cy}, 0.5))
    map.Fail(c.cx < -0.5 || c.cx > c.width - 0.5 ? "cx" : "cy",
             "the principal point (cx, cy) must lie inside the image");
  RequireInvertible(c, map);
  return c;
}

Camera ChooseCamera(const std::string& choice, const std::filesystem::path& sequence) {
  std::error_code ignored;
  if (choice.empty()) {
    const auto file = sequence / "camera.yaml";
    if (!std::filesystem::exists(file, ignored))
      throw InputError(
          file.string(),
          "no camera.yaml in the sequence; pass --camera tum1, tum2, tum3 or a file");
    return ReadCamera(file);
  }
  if (std::filesystem::is_regular_file(choice, ignored)) return ReadCamera(choice);
  if (choice == "tum1" || choice == "tum2" || choice == "tum3")
    return TumCamera(choice.c_str());
  throw InputError("--camera " + choice,
                   "no such file; expected tum1, tum2, tum3 or a camera.yaml");
}

}  // namespace slam
