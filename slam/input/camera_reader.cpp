#include "slam/input/camera_reader.h"

#include <algorithm>

#include "io/folder_kind.h"
#include "io/input_error.h"
#include "io/path_type.h"
#include "slam/input/bag_camera.h"
#include "slam/input/camera_keys.h"

namespace slam {
namespace {

bool HasAny(const io::YamlMap& map, std::initializer_list<const char*> keys) {
  return std::any_of(keys.begin(), keys.end(), [&](const char* key) { return map.Has(key); });
}

/// ORB-SLAM2 has all under `Camera.`, ORB-SLAM3 the lens under `Camera1.`.
CameraKeys KeysOfOrbSlam(const io::YamlMap& map) {
  const bool third = HasAny(map, {"Camera1.fx", "Camera1.fy", "Camera1.cx", "Camera1.cy"});
  const std::string size = "Camera.", lens = third ? "Camera1." : "Camera.";
  const bool grouped = map.Has("RGBD.DepthMapFactor") || (third && !map.Has("DepthMapFactor"));
  return {size + "width", size + "height",
          lens + "fx",    lens + "fy",
          lens + "cx",    lens + "cy",
          size + "fps",   grouped ? "RGBD.DepthMapFactor" : "DepthMapFactor",
          lens + "k1",    lens + "k2",
          lens + "p1",    lens + "p2",
          lens + "k3"};
}

Camera CameraOfOrbSlam(const io::YamlMap& map) {
  if (map.Has("Camera.type")) map.At("Camera.type").OneOf({"PinHole", "Rectified"});
  for (const char* key :
       {"Camera.k4", "Camera.k5", "Camera.k6", "Camera1.k4", "Camera1.k5", "Camera1.k6"}) {
    if (map.Has(key) && map.At(key).Number(io::Interval("(-inf, inf)")) != 0) {
      map.At(key).Fail("expected a lens of k1 k2 p1 p2 k3; other models cannot be used");
    }
  }
  return CameraUnder(map, KeysOfOrbSlam(map));
}

CameraFile CameraOfSequence(const io::YamlValue& root, const std::string& name) {
  const io::YamlMap map(root, {"model", "width", "height", "fx", "fy", "cx", "cy", "fps",
                               "depth_factor", "k1", "k2", "p1", "p2", "k3"});
  CameraFile file;
  if (map.Has("model")) {
    map.At("model").OneOf({"pinhole"});
  } else {
    file.warnings.push_back(name + ": key `model` is missing; `pinhole` is taken for it");
  }
  file.camera = CameraUnder(map);
  if (!map.Has("fps")) {
    file.warnings.push_back(name +
                            ": key `fps` is missing; 30 frames a second are taken for it");
  }
  return file;
}

}  // namespace

CameraFile ReadCamera(const std::filesystem::path& file) {
  const io::YamlValue root = io::ReadYaml(file, "expected a camera.yaml");
  const io::YamlMap map(root);
  if (HasAny(map, {"Camera.fx", "Camera.fy", "Camera.cx", "Camera.cy", "Camera.width",
                   "Camera.height", "Camera.type", "Camera1.fx", "Camera1.fy"})) {
    return {CameraOfOrbSlam(map), {}};
  }
  if (HasAny(map, {"camera_matrix", "distortion_coefficients", "image_width", "K", "k"})) {
    return {CameraOfMatrices(map), {}};
  }
  return CameraOfSequence(root, file.filename().string());
}

CameraFile ChooseCamera(const std::string& choice, const std::filesystem::path& sequence) {
  if (choice.empty()) {
    if (io::IsBagFile(sequence)) return {CameraOfBag(sequence), {}};
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
    return {TumCamera(choice.c_str()), {}};
  throw io::InputError("--camera " + choice,
                       std::string(type == Type::directory ? "is a folder" : "no such file") +
                           "; expected tum1, tum2, tum3, a camera.yaml, or settings of "
                           "ORB-SLAM or OpenCV");
}

}  // namespace slam
