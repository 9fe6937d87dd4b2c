#include "sim/scene/read_scene.h"

#include <algorithm>
#include <cmath>

#include "io/yaml_value.h"
#include "sim/base/angle.h"
#include "sim/scene/check.h"
#include "sim/scene/names.h"
#include "sim/scene/read_lights.h"
#include "sim/scene/read_model.h"

namespace sim {
namespace {

constexpr std::size_t kMaxObjects = 1000;
constexpr std::size_t kMaxWaypoints = 10000, kMaxStations = 64;

Material ReadMaterial(const io::YamlValue& value) {
  const io::YamlMap map(value,
                        {"print", "colour", "ink", "richness", "seed", "infrared", "gloss"});
  const auto colour = [&](const char* key, std::array<double, 3> otherwise) {
    if (!map.Has(key)) return otherwise;
    const Eigen::VectorXd rgb = map.At(key).Numbers(3, {0, 1}, "linear RGB");
    return std::array{rgb[0], rgb[1], rgb[2]};
  };
  Material material;
  material.print = static_cast<Print>(map.At("print").OneOf(kPrintNames));
  material.colour = colour("colour", material.colour);
  material.ink = colour("ink", material.ink);
  if (map.Has("richness")) material.richness = map.At("richness").Number({0, 1});
  if (map.Has("seed")) material.seed = map.At("seed").Seed();
  if (map.Has("infrared")) material.infrared = map.At("infrared").Number({0, 1});
  if (map.Has("gloss")) material.gloss = map.At("gloss").Number({0, 1});
  return material;
}

std::array<Material, 6> ReadFaces(const io::YamlValue& value, ShapeKind shape) {
  std::vector<std::string> keys{"all"};
  keys.insert(keys.end(), kFaceNames.begin(), kFaceNames.end());
  const io::YamlMap map(value, keys);
  std::array<Material, 6> faces;
  if (map.Has("all")) faces.fill(ReadMaterial(map.At("all")));
  for (std::size_t i = 0; i < faces.size(); ++i) {
    if (!map.Has(kFaceNames[i])) continue;
    if (shape != ShapeKind::kBox) {
      map.At(kFaceNames[i]).Fail("is a face of a box; this shape has one material, `all`");
    }
    faces[i] = ReadMaterial(map.At(kFaceNames[i]));
  }
  return faces;
}

Eigen::Quaterniond ReadRotation(const io::YamlMap& map) {
  if (map.Has("rpy_deg") && map.Has("q_xyzw")) {
    map.At("q_xyzw").Fail("stands beside rpy_deg; keep one of the two");
  }
  if (map.Has("rpy_deg")) {
    return QuaternionFromRpyDeg(map.At("rpy_deg").Numbers(3, {-360, 360}, "degrees"));
  }
  if (!map.Has("q_xyzw")) return Eigen::Quaterniond::Identity();
  const Eigen::VectorXd q = map.At("q_xyzw").Numbers(4, {-1.001, 1.001});
  Eigen::Quaterniond rotation(q[3], q[0], q[1], q[2]);
  const double excess = std::abs(rotation.squaredNorm() - 1);
  if (!(excess < 1e-5)) map.At("q_xyzw").Fail("expected a unit quaternion x, y, z, w");
  // What was written here is a unit up to rounding and stays as it is, bit for bit.
  if (excess > 1e-12) rotation.normalize();
  return rotation;
}

std::vector<Waypoint> ReadWay(const io::YamlValue& value) {
  std::vector<Waypoint> way;
  for (const io::YamlValue& entry : value.List(kMaxWaypoints)) {
    const io::YamlMap map(entry, {"time_s", "center_m", "yaw_deg"});
    Waypoint point;
    point.time_s = map.At("time_s").Number({0, 1e5}, "seconds");
    point.center_w =
        map.At("center_m").Numbers(3, {-kMaxCoordinate_m, kMaxCoordinate_m}, "metres");
    if (map.Has("yaw_deg"))
      point.yaw_deg = map.At("yaw_deg").Number({-36000, 36000}, "degrees");
    if (!way.empty() && !(point.time_s > way.back().time_s)) {
      map.At("time_s").Fail("is not after the one before; sort the way by time");
    }
    way.push_back(point);
  }
  if (way.size() < 2) value.Fail("expected two points or more; what stands has no `way`");
  return way;
}

/// What only a mesh has cannot stand without one, nor a mesh be another shape.
void CheckShape(const io::YamlMap& map) {
  const bool mesh = map.Has("mesh");
  if (map.Has("shape") && (kShapeNames[map.At("shape").OneOf(kShapeNames)] == "mesh") != mesh) {
    map.At("shape").Fail(mesh ? "is another one than `mesh`; leave it out"
                              : "is mesh: name its file with `mesh`");
  }
  for (const std::string& key : kModelKeys) {
    if (!mesh && map.Has(key)) map.At(key).Fail("is for a mesh; name its file with `mesh`");
  }
}

Object ReadObject(const io::YamlValue& value, const std::filesystem::path& folder) {
  std::vector<std::string> keys{"id",       "name",    "class",  "role",   "shape",
                                "center_m", "rpy_deg", "q_xyzw", "size_m", "detection_group",
                                "way",      "seed",    "faces"};
  keys.insert(keys.end(), kModelKeys.begin(), kModelKeys.end());
  const io::YamlMap map(value, keys);
  CheckShape(map);
  Object object;
  object.id = map.At("id").Whole({1, kMaxId});
  object.name = map.At("name").Word();
  object.class_name = map.At("class").Word();
  object.role = static_cast<Role>(map.At("role").OneOf(kRoleNames));
  if (map.Has("shape")) {
    object.shape = static_cast<ShapeKind>(map.At("shape").OneOf(kShapeNames));
  }
  object.q_wo = ReadRotation(map);
  if (map.Has("way")) object.way = ReadWay(map.At("way"));
  if (!object.way.empty()) {
    if (map.Has("center_m"))
      map.At("center_m").Fail("stands beside `way`, which has it; leave it out");
    object.center_w = object.way.front().center_w;
  } else if (map.Has("center_m") || !map.Has("mesh")) {
    object.center_w =
        map.At("center_m").Numbers(3, {-kMaxCoordinate_m, kMaxCoordinate_m}, "metres");
  }
  if (map.Has("mesh")) {
    ReadObjectModel(map, folder, object);
  } else {
    object.size = map.At("size_m").Numbers(3, {kMinSize_m, kMaxSize_m}, "metres");
  }
  if (map.Has("detection_group")) {
    object.detection_group = map.At("detection_group").Whole({0, kMaxId});
  }
  if (map.Has("seed")) object.seed = map.At("seed").Seed();
  if (map.Has("faces")) object.faces = ReadFaces(map.At("faces"), object.shape);
  return object;
}

Sun ReadSun(const io::YamlValue& value) {
  const io::YamlMap map(value, {"direction", "intensity", "ambient"});
  Sun sun;
  if (map.Has("direction")) {
    sun.direction_w = map.At("direction").Numbers(3, {-100, 100});
    if (!(sun.direction_w.norm() > 1e-6))
      map.At("direction").Fail("expected a direction, not 0");
  }
  if (map.Has("intensity")) sun.intensity = map.At("intensity").Number({0, 10});
  if (map.Has("ambient")) sun.ambient = map.At("ambient").Number({0, 10});
  return sun;
}

/// Reads `low_key` and `high_key` over the defaults; low may not exceed high.
void ReadRange(const io::YamlMap& map, const std::string& low_key, const std::string& high_key,
               double least, double most, const std::string& unit, double& low, double& high) {
  const auto read = [&](const std::string& key, double& into) {
    if (!map.Has(key)) return;
    const double number = map.At(key).Number({least, most}, unit);
    into = unit == "degrees" ? DegToRad(number) : number;
  };
  read(low_key, low);
  read(high_key, high);
  if (low <= high) return;
  map.At(map.Has(low_key) ? low_key : high_key).Fail("exceeds its maximum; swap the two");
}

std::vector<Station> ReadStations(const io::YamlValue& value) {
  std::vector<Station> stations;
  for (const io::YamlValue& entry : value.List(kMaxStations)) {
    const io::YamlMap map(entry, {"camera_m", "gaze_m"});
    const auto point = [&](const char* key) -> Eigen::Vector3d {
      return map.At(key).Numbers(3, {-kMaxCoordinate_m, kMaxCoordinate_m}, "metres");
    };
    stations.push_back({point("camera_m"), point("gaze_m")});
    const Eigen::Vector3d way = stations.back().gaze_w - stations.back().camera_w;
    const double steepest = SinCosDeg(kSteepest_deg).sin;
    if (!(way.head<2>().norm() > 0.05 && std::abs(way.z()) < steepest * way.norm())) {
      map.At("gaze_m").Fail(
          "is straight above or below the camera; move it aside, by 5 cm and 9 cm a metre");
    }
  }
  if (stations.size() < 4) value.Fail("expected 4 stations or more");
  return stations;
}

Capture ReadCapture(const io::YamlValue& value) {
  const io::YamlMap map(value, {"width_px", "height_px", "focal_px", "centre_px", "distortion",
                                "sensor", "fps", "frames"});
  Capture capture;
  const auto whole = [&](const char* key, double low, double high, int& into) {
    if (map.Has(key)) into = map.At(key).Whole({low, high});
  };
  whole("width_px", 16, 8192, capture.width);
  whole("height_px", 16, 8192, capture.height);
  whole("frames", 1, 1000000, capture.frames);
  const auto pair = [&](const char* key, double low, double& x, double& y) {
    if (!map.Has(key)) return;
    const Eigen::VectorXd two = map.At(key).Numbers(2, {low, 20000}, "pixels");
    x = two[0];
    y = two[1];
  };
  pair("focal_px", 1, capture.fx, capture.fy);
  pair("centre_px", 0, capture.cx, capture.cy);
  if (map.Has("distortion")) {
    const Eigen::VectorXd k = map.At("distortion").Numbers(5, {-10, 10});
    capture.distortion = {k[0], k[1], k[2], k[3], k[4]};
  }
  if (map.Has("sensor")) capture.sensor = kSensorNames[map.At("sensor").OneOf(kSensorNames)];
  if (map.Has("fps")) capture.fps = map.At("fps").Number({0.1, 1000}, "frames a second");
  return capture;
}

Motion ReadMotion(const io::YamlValue& value) {
  const io::YamlMap map(
      value, {"preset", "target_m", "target_spread_m", "distance_min_m", "distance_max_m",
              "azimuth_min_deg", "azimuth_max_deg", "pitch_min_deg", "pitch_max_deg",
              "speed_m_s", "turn_deg_s", "stations"});
  Motion motion;
  if (map.Has("preset")) motion.preset = kPresetNames[map.At("preset").OneOf(kPresetNames)];
  if (map.Has("target_m")) {
    motion.target_w =
        map.At("target_m").Numbers(3, {-kMaxCoordinate_m, kMaxCoordinate_m}, "metres");
  }
  if (map.Has("target_spread_m")) {
    motion.target_spread_m = map.At("target_spread_m").Number({0, 10}, "metres");
  }
  ReadRange(map, "distance_min_m", "distance_max_m", 0.2, 20, "metres", motion.distance_min_m,
            motion.distance_max_m);
  ReadRange(map, "azimuth_min_deg", "azimuth_max_deg", -180, 180, "degrees",
            motion.azimuth_min_rad, motion.azimuth_max_rad);
  ReadRange(map, "pitch_min_deg", "pitch_max_deg", -80, 80, "degrees", motion.pitch_min_rad,
            motion.pitch_max_rad);
  if (map.Has("speed_m_s")) motion.speed_m_s = map.At("speed_m_s").Number({0.005, 3}, "m/s");
  if (map.Has("turn_deg_s"))
    motion.turn_deg_s = map.At("turn_deg_s").Number({0.5, 180}, "deg/s");
  if (map.Has("stations")) motion.stations = ReadStations(map.At("stations"));
  return motion;
}

/// `name` is the file's, whose folder is where meshes are looked for.
Scene SceneFrom(const io::YamlValue& file, const std::filesystem::path& name) {
  const io::YamlMap map(file, {"format", "name", "family", "seed", "sun", "lights", "motion",
                               "capture", "objects"});
  map.At("format").OneOf({kSceneFormat});
  Scene scene;
  scene.name = map.At("name").Word();
  if (map.Has("family")) scene.family = map.At("family").Word();
  if (map.Has("seed")) scene.seed = map.At("seed").Seed();
  if (map.Has("sun")) scene.sun = ReadSun(map.At("sun"));
  if (map.Has("lights")) scene.lights = ReadLights(map.At("lights"));
  if (map.Has("motion")) scene.motion = ReadMotion(map.At("motion"));
  if (map.Has("capture")) scene.capture = ReadCapture(map.At("capture"));
  const std::filesystem::path folder = name.parent_path();
  const std::vector<io::YamlValue> objects = map.At("objects").List(kMaxObjects);
  if (objects.empty()) map.At("objects").Fail("expected at least one object");
  for (const io::YamlValue& object : objects)
    scene.objects.push_back(ReadObject(object, folder));
  if (const auto fault = FindFault(scene)) objects[fault->object].Fail(fault->what);
  return scene;
}

}  // namespace

Scene ParseScene(const std::string& text, const std::string& name) {
  return SceneFrom(io::ParseYaml(text, name), name);
}

Scene ReadScene(const std::filesystem::path& path) {
  return SceneFrom(io::ReadYaml(path, "expected a scene file (pas scene make)"), path);
}

}  // namespace sim
