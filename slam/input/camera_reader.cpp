#include "slam/input/camera_reader.h"

#include "io/input_error.h"
#include "io/path_type.h"
#include "io/yaml_value.h"

namespace slam {
namespace {

/// The lens must be invertible over the whole image: a pixel that does not come back from its
/// ray means that the coefficients are wrong (or of another model).
void RequireInvertible(const Camera& c, const io::YamlMap& map) {
  constexpr double kTolerance_px = 0.5;  // then it is another pixel
  constexpr int kSteps = 8;              // a lens is smooth: a coarse grid shows where it folds
  for (int i = 0; i <= kSteps; ++i) {
    for (int j = 0; j <= kSteps; ++j) {
      const Eigen::Vector2d u(static_cast<double>((c.width - 1) * i) / kSteps,
                              static_cast<double>((c.height - 1) * j) / kSteps);
      const Eigen::Vector2d ideal = c.Undistort(u);
      const Eigen::Vector2d back = c.ProjectDistorted(c.Backproject(ideal, 1.0));
      if (!((back - u).norm() < kTolerance_px))
        map.At("k1").Fail("the distortion k1 k2 p1 p2 k3 cannot be inverted over a " +
                          std::to_string(c.width) + " x " + std::to_string(c.height) +
                          " image; check the coefficients and their order");
    }
  }
}

}  // namespace

Camera ReadCamera(const std::filesystem::path& file) {
  const io::YamlMap map(io::ReadYaml(file, "expected a camera.yaml"),
                        {"model", "width", "height", "fx", "fy", "cx", "cy", "fps",
                         "depth_factor", "k1", "k2", "p1", "p2", "k3"});
  const io::Interval size(16, 8192), focal(1, 100000), centre(-8192, 16384), lens(-100, 100);
  if (map.Has("model")) map.At("model").OneOf({"pinhole"});
  Camera c;
  c.width = map.At("width").Whole(size);
  c.height = map.At("height").Whole(size);
  c.fx = map.At("fx").Number(focal);
  c.fy = map.At("fy").Number(focal);
  c.cx = map.At("cx").Number(centre);
  c.cy = map.At("cy").Number(centre);
  const auto optional = [&](const char* key, const io::Interval& domain, double& value) {
    if (map.Has(key)) value = map.At(key).Number(domain);
  };
  optional("fps", io::Interval("(0, 10000]"), c.fps);
  optional("depth_factor", {1, 1000000}, c.depth_factor);
  optional("k1", lens, c.k1);
  optional("k2", lens, c.k2);
  optional("p1", lens, c.p1);
  optional("p2", lens, c.p2);
  optional("k3", lens, c.k3);
  if (!c.ImageBox().Contains({c.cx, c.cy}, 0.5)) {
    map.At(c.cx < -0.5 || c.cx > c.width - 0.5 ? "cx" : "cy")
        .Fail("the principal point (cx, cy) must lie inside the image");
  }
  RequireInvertible(c, map);
  return c;
}

Camera ChooseCamera(const std::string& choice, const std::filesystem::path& sequence) {
  if (choice.empty()) {
    const auto file = sequence / "camera.yaml";
    if (!io::Exists(file))
      throw io::InputError(
          file.string(),
          "no camera.yaml in the sequence; pass --camera tum1, tum2, tum3 or a file");
    return ReadCamera(file);
  }
  using Type = std::filesystem::file_type;
  const Type type = io::TypeAt(choice);
  if (type != Type::not_found && type != Type::directory) return ReadCamera(choice);
  if (choice == "tum1" || choice == "tum2" || choice == "tum3")
    return TumCamera(choice.c_str());
  throw io::InputError("--camera " + choice,
                       "no such file; expected tum1, tum2, tum3 or a camera.yaml");
}

}  // namespace slam
