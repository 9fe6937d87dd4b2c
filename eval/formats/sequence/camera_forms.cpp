#include "eval/formats/sequence/camera_forms.h"

#include <array>
#include <string>
#include <vector>

namespace eval {
namespace {

double Positive(const io::YamlMap& map, const std::string& key) {
  return map.At(key).Number(io::Interval("(0, 1e9)"));
}

/// Coefficients beyond Brown's five belong to other models.
void RefuseOtherLens(const io::YamlValue& coefficient) {
  if (coefficient.Number(io::Interval("(-inf, inf)")) != 0)
    coefficient.Fail("expected a lens of k1 k2 p1 p2 k3; other models cannot be used");
}

/// ORB-SLAM2 has all under `Camera.`, ORB-SLAM3 the lens under `Camera1.`.
Camera CameraOfOrbSlam(const io::YamlMap& map) {
  const io::Interval size("(0, 100000)"), any("(-1e9, 1e9)");
  const std::string lens = map.Has("Camera1.fx") ? "Camera1." : "Camera.";
  if (map.Has("Camera.type")) map.At("Camera.type").OneOf({"PinHole", "Rectified"});
  for (const char* key :
       {"Camera.k4", "Camera.k5", "Camera.k6", "Camera1.k4", "Camera1.k5", "Camera1.k6"}) {
    if (map.Has(key)) RefuseOtherLens(map.At(key));
  }
  Camera camera;
  camera.width = map.At("Camera.width").Whole(size);
  camera.height = map.At("Camera.height").Whole(size);
  camera.fx = Positive(map, lens + "fx"), camera.fy = Positive(map, lens + "fy");
  camera.cx = map.At(lens + "cx").Number(any), camera.cy = map.At(lens + "cy").Number(any);
  camera.fps = map.Has("Camera.fps") ? Positive(map, "Camera.fps") : kUsualRate_Hz;
  camera.depth_factor =
      Positive(map, map.Has("RGBD.DepthMapFactor") ? "RGBD.DepthMapFactor" : "DepthMapFactor");
  constexpr std::array kLens{"k1", "k2", "p1", "p2", "k3"};
  for (std::size_t i = 0; i < kLens.size(); ++i) {
    if (map.Has(lens + kLens[i])) camera.distortion[i] = map.At(lens + kLens[i]).Number(any);
  }
  return camera;
}

std::vector<double> NumbersOf(const io::YamlValue& list) {
  std::vector<double> numbers;
  for (const io::YamlValue& number : list.List())
    numbers.push_back(number.Number(io::Interval("(-1e9, 1e9)")));
  return numbers;
}

/// Matrices are lists: under `data` in files of OpenCV and ROS, by themselves in a CameraInfo message
/// as text, whose names ROS 2 writes small.
Camera CameraOfMatrices(const io::YamlMap& map) {
  const bool small = map.Has("k"), message = small || map.Has("K");
  const io::Interval size("(0, 100000)");
  const auto list = [&](const char* of_file, const char* of_ros, const char* of_ros2) {
    const io::YamlValue value = map.At(!message ? of_file : small ? of_ros2 : of_ros);
    return message ? value : io::YamlMap(value).At("data");
  };
  if (map.Has("distortion_model")) {
    map.At("distortion_model").OneOf({"plumb_bob", "rational_polynomial"});
  }
  Camera camera;
  camera.width = map.At(message ? "width" : "image_width").Whole(size);
  camera.height = map.At(message ? "height" : "image_height").Whole(size);
  const std::vector<double> matrix = NumbersOf(list("camera_matrix", "K", "k"));
  if (matrix.size() != 9 || !(matrix[0] > 0) || !(matrix[4] > 0)) {
    map.At(!message ? "camera_matrix"
           : small  ? "k"
                    : "K")
        .Fail("expected [fx, 0, cx, 0, fy, cy, 0, 0, 1] in pixels");
  }
  camera.fx = matrix[0], camera.cx = matrix[2], camera.fy = matrix[4], camera.cy = matrix[5];
  camera.depth_factor =
      Positive(map, map.Has("DepthMapFactor") ? "DepthMapFactor" : "depth_factor");
  camera.fps = map.Has("fps") ? Positive(map, "fps") : kUsualRate_Hz;
  const std::vector<io::YamlValue> lens = list("distortion_coefficients", "D", "d").List();
  for (std::size_t i = 0; i < lens.size(); ++i) {
    if (i < camera.distortion.size()) {
      camera.distortion[i] = lens[i].Number(io::Interval("(-1e9, 1e9)"));
    } else {
      RefuseOtherLens(lens[i]);
    }
  }
  return camera;
}

}  // namespace

std::optional<Camera> CameraOfOtherForm(const io::YamlMap& map) {
  for (const char* key : {"Camera.fx", "Camera1.fx"}) {
    if (map.Has(key)) return CameraOfOrbSlam(map);
  }
  for (const char* key : {"camera_matrix", "K", "k"}) {
    if (map.Has(key)) return CameraOfMatrices(map);
  }
  return std::nullopt;
}

}  // namespace eval
